// Rays that leave a surface, through the kernels that make them (surface, sample_lights, shade):
// they miss what they left, and miss nothing behind it.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "kernel_columns.h"
#include "render_scenes.h"

namespace yat {
namespace {

class SpawnedRays : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(SpawnedRays);

std::string point_text(const glm::dvec3& p) {
  return fmt::format("{:.9g} {:.9g} {:.9g}", p.x, p.y, p.z);
}
std::string quad_at(const glm::dvec3& corner, const glm::dvec3& e1, const glm::dvec3& e2) {
  return quad_text(point_text(corner), point_text(corner + e1), point_text(corner + e1 + e2),
                   point_text(corner + e2));
}
/// A camera far from everything, so that the scene's centre is where the test wants it.
std::string world_text(const std::string& body) {
  return view_text("0 0 5", "0 1 0", 40, 4, 4) + body + "WorldEnd\n";
}

/// One batch of hits taken to the next rays by the stages of a bin.
struct Bounce {
  Bounce(const Scene& scene, const KernelTable& table, uint32_t count)
      : view(scene.view()),
        kernels(table),
        n(count),
        rays(padded_rows(count)),
        hits(padded_rows(count)),
        paths(padded_rows(count)),
        surfaces(padded_rows(count)),
        chunk_paths(padded_rows(count)),
        randoms(padded_rows(count)),
        lights(padded_rows(count)),
        next_rays(padded_rows(count)),
        next_paths(padded_rows(count)),
        shadow_rays(padded_rows(count)),
        order(padded_rows(count)),
        finished(padded_rows(count)),
        scratch_memory(table.traversal_scratch_bytes(view.geometry.tree, padded_rows(count))) {
    for (uint32_t i = 0; i < count; ++i) order[i] = i;
    out.rays = next_rays.columns();
    out.paths = next_paths.columns();
    out.shadow_rays = shadow_rays.columns();
    out.finished = finished.data();
  }

  void set_hit(uint32_t i, const glm::dvec3& org, const glm::dvec3& dir, const Hit<Value>& hit) {
    rays.set(i, {float(org.x), float(org.y), float(org.z), float(dir.x), float(dir.y), float(dir.z),
                 kRayFar});
    hits.set(i, hit);
    PathState<Value> path{};
    path.throughput_r = path.throughput_g = path.throughput_b = 1;
    path.slot = i;
    path.pixel = i;
    paths.set(i, path);
  }
  void set_randoms(uint32_t i, float light_u, float light_v, float lobe, float u, float v) {
    randoms.set(i, {light_u, light_v, 0.5f, lobe, u, v, 0.5f});
  }
  void make_surfaces(GeometryKind kind) {
    kernels.make_surfaces[uint32_t(kind)](view, order.data(), rays.view(), hits.view(),
                                          paths.view(), surfaces.columns(), chunk_paths.columns(),
                                          n);
  }
  void shade(MaterialKind material, bool with_lights) {
    LightSample<ConstColumn> light_columns{};
    if (with_lights) {
      kernels.sample_lights[kPlainLights](view, surfaces.view(), randoms.view(), lights.columns(),
                                          n);
      light_columns = lights.view();
    }
    kernels.shade[uint32_t(material)]({surfaces.view(), chunk_paths.view(), randoms.view(),
                                       light_columns, view.parameters[uint32_t(material)]},
                                      {}, out, drops, n);
  }
  std::vector<uint32_t> occluded() {
    AlignedArray<uint32_t> result(padded_rows(n));
    for (uint32_t& o : result) o = 0;
    const uint32_t m = out.shadow_count;
    if (view.geometry.tree.node_count)
      kernels.intersect_shadow[!view.geometry.all_occlude](
          view.geometry.tree, shadow_rays.view(), result.data(), m,
          {scratch_memory.data(), scratch_memory.bytes()});
    if (view.geometry.spheres.count)
      kernels.shadow_spheres(view.geometry.spheres, shadow_rays.view(), result.data(), m);
    return {result.data(), result.data() + m};
  }

  SceneView view;
  const KernelTable& kernels;
  uint32_t n;
  Table<Ray> rays;
  Table<Hit> hits;
  Table<PathState> paths;
  Table<Surface> surfaces;
  Table<PathState> chunk_paths;
  Table<Randoms> randoms;
  Table<LightSample> lights;
  Table<Ray> next_rays;
  Table<PathState> next_paths;
  Table<ShadowRay> shadow_rays;
  AlignedArray<uint32_t> order, finished;
  AlignedArray<std::byte> scratch_memory;
  ShadeOutput out;
  DropLog drops;
};

/// Numbers of a sampler, its ends included.
float random_or_end(Random& random) {
  const uint32_t which = random.below(8);
  return which == 0 ? 0.f : which == 1 ? 1 - 0x1p-24f : random.unit();
}

// S2. Of two parallel sheets the second is found from the first, down to a gap of two offsets.
TEST_P(SpawnedRays, SheetBehindASheetIsFound) {
  constexpr uint32_t kRays = 512;
  for (const double scale : {1e-3, 1., 1e3})
    for (const uint32_t gap : {2u, 3u, 8u, 64u}) {
      Random random(7 + gap);
      uint32_t lost = 0;
      for (uint32_t trial = 0; trial < 8; ++trial) {
        const glm::dvec3 e1 = random.direction() * scale,
                         normal = glm::normalize(glm::cross(e1, random.direction())),
                         e2 = glm::cross(normal, e1);
        // Like the surface stage: 32 roundings of the largest coordinate, projected on the normal.
        const double offset = 32 * 0x1p-24 * 2 * scale *
                              (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
        const glm::dvec3 corner = -0.5 * (e1 + e2);
        const Scene scene = compile_text(
            world_text(matte_text(".5 .5 .5") + quad_at(corner, e1, e2) +
                       quad_at(corner + normal * (gap * offset), e1, e2) +
                       "LightSource \"point\" \"point from\" [0 0 5] \"color L\" [1 1 1]\n"),
            kernels());
        Bounce bounce(scene, kernels(), kRays);
        for (uint32_t i = 0; i < kRays; ++i) {
          // Hits well inside the first sheet; the way on is within 60 degrees of the normal.
          const float u = random.in(.2f, .4f), v = random.in(.2f, .4f);
          bounce.set_hit(i, {0, 0, 0}, -normal, {1, u, v, random.below(2)});
        }
        bounce.make_surfaces(GeometryKind::kTriangleFlat);
        Table<Ray> rays(kRays);
        Table<Hit> hits(kRays);
        for (uint32_t i = 0; i < kRays; ++i) {
          const Surface<Value> s = bounce.surfaces.row(i);
          const glm::dvec3 ng(s.ng_x, s.ng_y, s.ng_z);
          const double side = glm::dot(ng, normal) > 0 ? 1 : -1;
          glm::dvec3 dir = random.direction();
          dir = glm::normalize(normal + 1.7 * (dir - normal * glm::dot(dir, normal)));
          const auto at = [&](float pos, double n) {
            return pos + float(side) * s.offset * float(n);
          };
          rays.set(i, {at(s.pos_x, ng.x), at(s.pos_y, ng.y), at(s.pos_z, ng.z), float(dir.x),
                       float(dir.y), float(dir.z), kRayFar});
        }
        kernels().intersect_closest(bounce.view.geometry.tree, rays.view(), hits.columns(), kRays,
                                    {bounce.scratch_memory.data(), bounce.scratch_memory.bytes()});
        for (uint32_t i = 0; i < kRays; ++i) {
          const uint32_t prim = hits.row(i).prim;
          lost += prim != 2 && prim != 3;
        }
      }
      EXPECT_EQ(lost, 0u) << "gap of " << gap << " offsets, scale " << scale;
    }
}

// S3. A lamp does not shadow itself, and a sheet right before it shadows all of it.
TEST_P(SpawnedRays, LampsDoNotShadowThemselves) {
  constexpr uint32_t kRays = 2048;
  for (const bool sphere : {false, true})
    for (const double scale : {1e-4, 1., 1e4})
      for (const double away : {0., 10., 1000.})
        for (const bool sheet : {false, true}) {
          Random random(11);
          const glm::dvec3 at(away * scale, -away * scale, 0.5 * away * scale);
          const double s = scale;
          std::string text = matte_text(".5 .5 .5") +
                             quad_at(at + glm::dvec3(-s, -s, 0), {2 * s, 0, 0}, {0, 2 * s, 0});
          // Far from the origin the gap must be seen in floats at all.
          const double gap = s * (1e-3 + 1e-5 * away);
          if (sheet)
            text += quad_at(at + glm::dvec3(-4 * s, -4 * s, s - gap), {0, 8 * s, 0}, {8 * s, 0, 0});
          text += "AttributeBegin\n" + light_text("1 1 1");
          text += sphere ? sphere_text(point_text(at + glm::dvec3(0, 0, 1.3 * s)), 0.3 * s)
                         : quad_at(at + glm::dvec3(-.4 * s, -.4 * s, s), {.1 * s, .8 * s, 0},
                                   {.8 * s, 0, 0});
          text += "AttributeEnd\n";
          const Scene scene = compile_text(world_text(text), kernels());
          Bounce bounce(scene, kernels(), kRays);
          for (uint32_t i = 0; i < kRays; ++i) {
            float u = random_or_end(random), v = random_or_end(random);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            bounce.set_hit(i, {0, 0, 0}, {0, 0, -1}, {1, u, v, random.below(2)});
            bounce.set_randoms(i, random_or_end(random), random_or_end(random), .5f, .5f, .5f);
          }
          bounce.make_surfaces(GeometryKind::kTriangleFlat);
          bounce.shade(MaterialKind::kMatte, true);
          // Every point of the floor sees every lamp from its bright side.
          EXPECT_EQ(bounce.out.shadow_count, kRays);
          uint32_t stopped = 0;
          for (const uint32_t o : bounce.occluded()) stopped += o;
          EXPECT_EQ(stopped, sheet ? kRays : 0)
              << (sphere ? "sphere" : "quad") << ", scale " << scale << ", " << away
              << " scales away" << (sheet ? ", behind a sheet" : "");
        }
}

// S4. A ray refracted into a sphere of radius r finds the one of radius r (1 - 4e-5) within.
TEST_P(SpawnedRays, RefractedRaysFindTheInnerSphere) {
  constexpr uint32_t kRays = 2048;
  for (const double r : {1e-5, 1., 1e5}) {
    Random random(13);
    const Scene scene = compile_text(
        world_text("Material \"glass\" \"color Kr\" [1 1 1] \"color Kt\" [1 1 1] \"float index\" "
                   "[1.5]\n" +
                   fmt::format("Shape \"sphere\" \"float radius\" [{:.9g}]\n", r) +
                   fmt::format("Shape \"sphere\" \"float radius\" [{:.9g}]\n", r * (1 - 4e-5)) +
                   "LightSource \"point\" \"point from\" [0 0 5] \"color L\" [1 1 1]\n"),
        kernels());
    Bounce bounce(scene, kernels(), kRays);
    const glm::dvec3 center(-scene.center);
    for (uint32_t i = 0; i < kRays; ++i) {
      const glm::dvec3 normal = random.direction();
      glm::dvec3 dir = random.direction();
      if (glm::dot(dir, normal) > 0) dir = -dir;
      // From three radii off, so that the hit distance carries its own error.
      bounce.set_hit(i, center + r * normal - 3 * r * dir, dir, {float(3 * r), 0, 0, 0});
      bounce.set_randoms(i, .5f, .5f, 1 - 0x1p-24f, .5f, .5f);
    }
    bounce.make_surfaces(GeometryKind::kSphere);
    bounce.shade(MaterialKind::kGlass, false);
    ASSERT_GT(bounce.out.path_count, kRays / 2);
    const uint32_t m = bounce.out.path_count;
    Table<Hit> hits(padded_rows(m));
    for (uint32_t i = 0; i < m; ++i) hits.set(i, {kRayFar, 0, 0, kNone});
    bounce.kernels.intersect_spheres(bounce.view.geometry.spheres, 0, bounce.next_rays.view(),
                                     hits.columns(), m);
    uint32_t refracted = 0, lost = 0;
    for (uint32_t i = 0; i < m; ++i) {
      const Ray<Value> ray = bounce.next_rays.row(i);
      const glm::dvec3 from = glm::dvec3(ray.org_x, ray.org_y, ray.org_z) - center;
      if (glm::dot(from, glm::dvec3(ray.dir_x, ray.dir_y, ray.dir_z)) > 0) continue;
      ++refracted;
      lost += hits.row(i).prim != 1;
    }
    EXPECT_GT(refracted, kRays / 2);
    EXPECT_EQ(lost, 0u) << "radius " << r;
  }
}

}  // namespace
}  // namespace yat
