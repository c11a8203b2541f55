// Kernels of the two levels: hits, shadows and surfaces in shared objects against the same scene
// with copies, for maps of every sort.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "instance_scenes.h"
#include "kernel_columns.h"

namespace yat {
namespace {

/// Rays, and what the kernels make of them; scene space is that of `scene`.
struct Traced {
  Table<Ray> rays;
  Table<Hit> hits;
  AlignedArray<uint32_t> instance;
  explicit Traced(uint32_t n) : rays(n), hits(n), instance(n) {}
};

struct GuardedScratch {
  explicit GuardedScratch(size_t bytes) : memory(bytes + 256), size(bytes) {
    std::memset(memory.data() + bytes, 0xcd, 256);
  }
  Scratch view() { return {memory.data(), size}; }
  bool untouched() const {
    for (size_t i = 0; i < 256; ++i)
      if (memory[size + i] != std::byte(0xcd)) return false;
    return true;
  }
  AlignedArray<std::byte> memory;
  size_t size;
};

void intersect(const KernelTable& k, const Scene& scene, Traced& traced, uint32_t n) {
  const SceneView view = scene.view();
  GuardedScratch scratch(std::max(k.traversal_scratch_bytes(view.geometry.tree, n),
                                  k.instance_scratch_bytes(view.instances, n)));
  k.intersect_closest(view.geometry.tree, traced.rays.view(), traced.hits.columns(), n,
                      scratch.view());
  k.intersect_instances(view.instances, traced.rays.view(), traced.hits.columns(),
                        traced.instance.data(), n, scratch.view());
  EXPECT_TRUE(scratch.untouched());
}

Ray<Value> ray_of(const glm::dvec3& org, const glm::dvec3& dir, float t_max = kRayFar) {
  return {float(org.x), float(org.y), float(org.z), float(dir.x),
          float(dir.y), float(dir.z), t_max};
}

/// Triangles of the scene's own, before copies of objects begin.
constexpr uint32_t kFloor = 2;

class InstanceKernels : public PerIsa {
 protected:
  /// Number of the triangle that a hit of the shared scene names in the scene of copies.
  static uint32_t as_copy(const Scene& shared, const Hit<Value>& hit, uint32_t instance) {
    if (hit.prim == kNone || instance == kNone) return hit.prim;
    return kFloor + instance * shared.instances.triangles.size() + hit.prim;
  }
};
YAT_INSTANTIATE_PER_ISA(InstanceKernels);

TEST_P(InstanceKernels, HitsAreThoseOfCopies) {
  for (const double far : {0., 1e6}) {
    const std::string text = crowd_text(12, false, far);
    const Scene shared = compile_instances(text, kernels(), InstanceMode::kShare);
    const Scene copies = compile_instances(text, kernels(), InstanceMode::kCopy);
    ASSERT_EQ(shared.instances.rows.size(), std::size(kMaps));
    ASSERT_TRUE(copies.instances.empty());
    ASSERT_EQ(copies.triangles.size(),
              kFloor + std::size(kMaps) * shared.instances.triangles.size());
    constexpr uint32_t n = 20000;
    Traced a(n), b(n);
    Random random(7);
    for (uint32_t i = 0; i < n; ++i) {
      const glm::dvec3 org = rounded(random.point(9)), to = random.point(4.5f);
      const glm::dvec3 dir = rounded(glm::normalize(to - org));
      const glm::dvec3 at(far, far, 0);
      const float t_max = i % 7 == 0 ? random.in(1, 20) : kRayFar;
      a.rays.set(i, ray_of(org + at - shared.center, dir, t_max));
      b.rays.set(i, ray_of(org + at - copies.center, dir, t_max));
    }
    intersect(kernels(), shared, a, n);
    const SceneView view = copies.view();
    GuardedScratch scratch(kernels().traversal_scratch_bytes(view.geometry.tree, n));
    kernels().intersect_closest(view.geometry.tree, b.rays.view(), b.hits.columns(), n,
                                scratch.view());
    uint32_t in_instances = 0, apart = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const Hit<Value> x = a.hits.row(i), y = b.hits.row(i);
      in_instances += x.prim != kNone && a.instance[i] != kNone;
      // Rounding moves edges: a ray near one may take the neighbour, at about the same distance,
      // or pass an outline.
      if (as_copy(shared, x, a.instance[i]) != y.prim || std::abs(x.t - y.t) > 1e-4f * y.t) ++apart;
      if (x.prim == kNone) {
        EXPECT_EQ(x.t, a.rays.row(i).t_max);
      }
    }
    EXPECT_GT(in_instances, n / 8) << far;
    EXPECT_LE(apart, n / 500) << far;

    // Shadows: towards where the hit is, to before it and to behind it.
    Table<ShadowRay> shadow(n);
    AlignedArray<uint32_t> occluded(n), wanted(n);
    for (uint32_t i = 0; i < n; ++i) {
      const Ray<Value> r = a.rays.row(i);
      const float length = a.hits.row(i).prim == kNone ? 30.f
                           : i % 2                     ? a.hits.row(i).t * .999f
                                                       : a.hits.row(i).t * 1.001f;
      shadow.set(i, {r.org_x, r.org_y, r.org_z, r.dir_x * length, r.dir_y * length,
                     r.dir_z * length, 0, 0, 0, 0});
      // A tenth is stopped by something else already.
      occluded[i] = i % 10 == 0;
      wanted[i] = i % 10 == 0 || (a.hits.row(i).prim != kNone && a.instance[i] != kNone &&
                                  i % 2 == 0 && a.hits.row(i).t * 1.001f <= r.t_max);
    }
    for (uint32_t mask = 0; mask < 2; ++mask) {
      AlignedArray<uint32_t> out(std::span<const uint32_t>(occluded.data(), n));
      GuardedScratch memory(kernels().instance_scratch_bytes(shared.view().instances, n));
      kernels().shadow_instances[mask](shared.view().instances, shadow.view(), out.data(), n,
                                       memory.view());
      EXPECT_TRUE(memory.untouched());
      uint32_t wrong = 0;
      for (uint32_t i = 0; i < n; ++i) {
        // Cut rays: whether something lies beyond their end is not known from the hit.
        if (i % 7 == 0 || (wanted[i] == 0 && a.hits.row(i).prim != kNone && i % 2 == 0)) continue;
        wrong += out[i] != wanted[i];
      }
      EXPECT_LE(wrong, n / 500) << far << " mask " << mask;
    }
  }
}

TEST_P(InstanceKernels, RowsAreIndependent) {
  const Scene scene = compile_instances(crowd_text(8, false), kernels(), InstanceMode::kShare);
  constexpr uint32_t n = 3000;
  Traced all(n);
  Random random(3);
  for (uint32_t i = 0; i < n; ++i) {
    const glm::dvec3 org = random.point(9);
    all.rays.set(i, ray_of(org, glm::normalize(random.point(4) - org)));
  }
  // Rays that cannot hit, among the others.
  Ray<Value> bad = all.rays.row(5);
  bad.dir_x = NAN;
  all.rays.set(5, bad);
  bad = all.rays.row(6);
  bad.org_y = INFINITY;
  all.rays.set(6, bad);
  bad.org_y = 0;
  bad.dir_x = bad.dir_y = bad.dir_z = 0;
  all.rays.set(7, bad);
  intersect(kernels(), scene, all, n);
  for (const uint32_t i : {5u, 6u, 7u}) {
    EXPECT_EQ(all.hits.row(i).prim, kNone);
    EXPECT_EQ(all.instance[i], kNone);
  }
  std::vector<uint32_t> counts = tail_counts(kernels().lanes);
  counts.push_back(500);
  for (const uint32_t count : counts) {
    Traced some(count + 1);
    std::vector<uint32_t> of(count);
    for (uint32_t i = 0; i < count; ++i) {
      of[i] = (i * 1237 + count * 31) % n;
      some.rays.set(i, all.rays.row(of[i]));
    }
    intersect(kernels(), scene, some, count);
    for (uint32_t i = 0; i < count; ++i) {
      const Hit<Value> x = some.hits.row(i), y = all.hits.row(of[i]);
      EXPECT_EQ(std::memcmp(&x, &y, sizeof x), 0) << count << " row " << i;
      EXPECT_EQ(some.instance[i], all.instance[of[i]]) << count << " row " << i;
    }
  }
}

/// Surfaces of the hits of `traced` that are in instances.
struct Surfaces {
  std::vector<uint32_t> order;
  Table<Surface> rows;
  Surfaces(const KernelTable& k, const Scene& scene, const Traced& traced, uint32_t n,
           bool vertex_data)
      : rows(n) {
    for (uint32_t i = 0; i < n; ++i)
      if (traced.hits.row(i).prim != kNone && traced.instance[i] != kNone) order.push_back(i);
    order.resize(padded_rows(uint32_t(order.size())) + kRowPad);
    count = 0;
    for (uint32_t i = 0; i < n; ++i)
      if (traced.hits.row(i).prim != kNone && traced.instance[i] != kNone) order[count++] = i;
    Table<PathState> paths(n), out(n);
    k.make_instance_surfaces[vertex_data](scene.view(), order.data(), traced.rays.view(),
                                          traced.hits.view(), traced.instance.data(), paths.view(),
                                          rows.columns(), out.columns(), count);
  }
  uint32_t count = 0;
};

TEST_P(InstanceKernels, SurfacesAreThoseOfCopies) {
  for (const bool normals : {false, true}) {
    const std::string text = crowd_text(12, normals);
    const Scene shared = compile_instances(text, kernels(), InstanceMode::kShare);
    const Scene copies = compile_instances(text, kernels(), InstanceMode::kCopy);
    constexpr uint32_t n = 4000;
    Traced a(n);
    Random random(11);
    for (uint32_t i = 0; i < n; ++i) {
      const glm::dvec3 org = random.point(9);
      a.rays.set(i, ray_of(org, glm::normalize(random.point(4) - org)));
    }
    intersect(kernels(), shared, a, n);
    const Surfaces here(kernels(), shared, a, n, normals);
    ASSERT_GT(here.count, n / 8);
    // The same hits, named as the copies'.
    Table<Hit> hits(n);
    for (uint32_t i = 0; i < n; ++i) {
      Hit<Value> hit = a.hits.row(i);
      hit.prim = as_copy(shared, hit, a.instance[i]);
      hits.set(i, hit);
    }
    Table<Surface> there(n);
    Table<PathState> paths(n), out(n);
    kernels().make_surfaces[uint32_t(normals ? GeometryKind::kTriangleVertex
                                             : GeometryKind::kTriangleFlat)](
        copies.view(), here.order.data(), a.rays.view(), hits.view(), paths.view(), there.columns(),
        out.columns(), here.count);
    for (uint32_t i = 0; i < here.count; ++i) {
      const Surface<Value> x = here.rows.row(i), y = there.row(i);
      const glm::dvec3 at = glm::dvec3(x.pos_x, x.pos_y, x.pos_z) + shared.center;
      // Corners may be listed the other way round: a mirrored copy swaps two.
      const bool mirrored =
          glm::length(at - glm::dvec3(y.pos_x, y.pos_y, y.pos_z) - copies.center) > 1e-5;
      if (!mirrored)
        expect_near(at, glm::dvec3(y.pos_x, y.pos_y, y.pos_z) + copies.center, 1e-5, "pos", i);
      else
        EXPECT_NE(kMaps[a.instance[here.order[i]]].name.find("mirrored"), std::string_view::npos);
      expect_near({x.ng_x, x.ng_y, x.ng_z}, {y.ng_x, y.ng_y, y.ng_z}, 2e-3, "ng", i);
      EXPECT_GT(x.ns_x * x.ng_x + x.ns_y * x.ng_y + x.ns_z * x.ng_z, -1e-6f);
      // Copies make vertex normals unit before they are interpolated, in the world: the same for
      // similarities only.
      const std::string_view map = kMaps[a.instance[here.order[i]]].name;
      if (!normals || map == "turned" || map == "small")
        expect_near({x.ns_x, x.ns_y, x.ns_z}, {y.ns_x, y.ns_y, y.ns_z}, 2e-3, "ns", i);
      EXPECT_GE(x.offset, 0.f);
      EXPECT_LE(x.offset, 1e-3f);
      EXPECT_EQ(x.parameter, y.parameter);
      EXPECT_EQ(x.light, kNone);
      EXPECT_EQ(shared.bins[shared.instances.shapes.row(0).bin].material, MaterialKind::kMatte);
    }
  }
}

/// A convex object: what leaves it never meets it, what goes in always does.
TEST_P(InstanceKernels, SpawnedRaysLeaveAndStay) {
  for (const NamedMap& map : kMaps)
    // A second one far off makes the instances' places large against their size.
    for (const double apart : {3., 3e3, 3e5}) {
      std::string text = view_text("0 -9 2", "0 0 0", 50, 8, 8) +
                         "LightSource \"point\" \"point from\" [0 -5 5]\n" +
                         "ObjectBegin \"ball\"\nScale .9 .9 .9\n" + ball_text(10, 20, 0, false) +
                         "ObjectEnd\n" + instance_text("ball", "0 0 0", map.text) +
                         instance_text("ball", fmt::format("{0} {0} {0}", apart), map.text) +
                         "WorldEnd\n";
      const Scene scene = compile_instances(text, kernels(), InstanceMode::kShare);
      constexpr uint32_t n = 2000;
      Traced first(n);
      Random random(23);
      for (uint32_t i = 0; i < n; ++i) {
        const glm::dvec3 center = (i % 2 ? glm::dvec3(apart) : glm::dvec3(0.)) - scene.center;
        // From outside, and from inside (where the map is small or flat, mostly outside).
        const glm::dvec3 org = center + random.point(i % 3 ? 4.f : .3f);
        const glm::dvec3 to = center + random.point(map.name == "small" ? .004f : .3f);
        first.rays.set(i, ray_of(org, glm::normalize(to - org)));
      }
      intersect(kernels(), scene, first, n);
      const Surfaces surfaces(kernels(), scene, first, n, false);
      ASSERT_GT(surfaces.count, n / 20) << map.name << ' ' << apart;

      Traced next(2 * surfaces.count);
      for (uint32_t i = 0; i < surfaces.count; ++i) {
        const Surface<Value> s = surfaces.rows.row(i);
        const glm::dvec3 ng(s.ng_x, s.ng_y, s.ng_z);
        glm::dvec3 dir = random.direction();
        if (glm::dot(dir, ng) < 0) dir = -dir;
        if (i % 4 == 0) dir = glm::normalize(dir - .999 * glm::dot(dir, ng) * ng);  // grazing
        for (uint32_t side = 0; side < 2; ++side) {
          const double sign = side ? -1 : 1;
          const auto at = [&](float pos, float normal) {
            return double(pos + float(sign) * s.offset * normal);
          };
          next.rays.set(
              2 * i + side,
              ray_of({at(s.pos_x, s.ng_x), at(s.pos_y, s.ng_y), at(s.pos_z, s.ng_z)}, sign * dir));
        }
      }
      intersect(kernels(), scene, next, 2 * surfaces.count);
      uint32_t back = 0, lost = 0, thick = 0;
      for (uint32_t i = 0; i < surfaces.count; ++i) {
        const uint32_t own = first.instance[surfaces.order[i]];
        back += next.instance[2 * i] == own;
        // Where the offset is not small against the object, a ray may start beyond it.
        const float radius = scene.instances.rows.row(own).radius;
        const bool thin = map.name == "flat" || surfaces.rows.row(i).offset > 1e-3f * radius;
        thick += !thin;
        lost += !thin && next.instance[2 * i + 1] != own;
      }
      EXPECT_EQ(back, 0u) << map.name << ' ' << apart << " of " << surfaces.count;
      EXPECT_EQ(lost, 0u) << map.name << ' ' << apart << " of " << thick;
      if (apart < 10 && map.name != "flat") {
        EXPECT_GT(thick, surfaces.count / 2) << map.name;
      }
    }
}

TEST_P(InstanceKernels, ClassesFollowTheInstance) {
  const std::string glass = "Material \"glass\"\n";
  const std::string text =
      view_text("0 -9 2", "0 0 0", 50, 8, 8) + "LightSource \"point\" \"point from\" [0 -5 5]\n" +
      matte_text(".5 .5 .5") + quad_text("-9 -9 -2", "9 -9 -2", "9 9 -2", "-9 9 -2") +
      "ObjectBegin \"pair\"\n" + matte_text(".2 .3 .4") + ball_text(6, 8, 0, false) +
      "Material \"mirror\"\nTranslate 0 0 2.5\n" + ball_text(6, 8, 0, true) + "ObjectEnd\n" +
      "AttributeBegin\n" + glass + instance_text("pair", "3 0 0", "") + "AttributeEnd\n" +
      instance_text("pair", "-3 0 0", "", matte_text(".9 .1 .1")) + "WorldEnd\n";
  // The second instance has the matte of its own; the first one's glass stands for both shapes.
  const Scene scene = compile_instances(text, kernels(), InstanceMode::kShare);
  ASSERT_EQ(scene.instances.rows.size(), 2u);
  const uint32_t triangles = scene.instances.triangles.size();
  constexpr uint32_t n = 64;
  GuardedTable<Hit> hits(n);
  GuardedColumn<uint32_t> instance(n), depth(n), bin(n);
  for (uint32_t i = 0; i < n; ++i) {
    const bool placed = i % 4 != 0;
    instance[i] = placed ? i % 2 : kNone;
    hits.set(i, {1, 0, 0, i % 8 == 7 ? kNone : placed ? i * 37 % triangles : i / 4 % 2});
    depth[i] = i % 3;
  }
  ASSERT_EQ(scene.first_lasting_bin, scene.bins.size());
  kernels().classify_instance_hits(scene.view().instances, scene.prim_bin.data(),
                                   scene.first_lasting_bin, 2, hits.view(), instance.data(),
                                   depth.data(), bin.data(), n);
  EXPECT_TRUE(bin.untouched());
  for (uint32_t i = 0; i < n; ++i) {
    const Hit<Value> hit = hits.row(i);
    if (hit.prim == kNone || depth[i] >= 2) {
      EXPECT_EQ(bin[i], 0u) << i;
      continue;
    }
    const Bin& found = scene.bins.at(bin[i]);
    EXPECT_EQ(found.instanced, instance[i] != kNone) << i;
    if (instance[i] == kNone) {
      EXPECT_EQ(bin[i], scene.prim_bin[hit.prim]);
      continue;
    }
    const bool second = scene.instances.triangle_shape[hit.prim] == 1;
    EXPECT_EQ(found.geometry, second ? GeometryKind::kTriangleVertex : GeometryKind::kTriangleFlat);
    EXPECT_EQ(found.material, instance[i] == 0 ? MaterialKind::kGlass : MaterialKind::kMatte);
  }
}

}  // namespace
}  // namespace yat
