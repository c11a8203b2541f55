// Shading kernels against scalar double precision at every count: depth, roulette, crossings,
// drops.

#include <cmath>
#include <limits>
#include <map>

#include "kernel_columns.h"
#include "kernels/materials/all.h"
#include "kernels/rng_scalar.h"
#include "surface_vectors.h"

namespace yat {
namespace {

constexpr double kPi = 3.141592653589793;

class ShadeStage : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(ShadeStage);

/// Inputs and outputs of one shade call: random surfaces seen from random sides.
struct ShadeCase {
  uint32_t n;
  GuardedTable<Surface> surfaces;
  GuardedTable<PathState> paths;
  GuardedTable<Randoms> randoms;
  GuardedTable<LightSample> lights;
  GuardedTable<Ray> rays;
  GuardedTable<PathState> next;
  GuardedTable<ShadowRay> shadows;
  GuardedColumn<uint32_t> finished;
  ShadeOutput out;
  DropLog drops;
  TransportOptions options;

  explicit ShadeCase(uint32_t rows, uint32_t seed = 1)
      : n(rows),
        surfaces(n),
        paths(n),
        randoms(n),
        lights(n),
        rays(n + 16),
        next(n + 16),
        shadows(n + 16),
        finished(n + 16) {
    options.roulette_depth = 100;
    Random random(seed + rows);
    for (uint32_t i = 0; i < n; ++i) {
      Surface<Value> s{};
      const glm::dvec3 ng = random.direction();
      glm::dvec3 ns = glm::normalize(ng + random.direction() * (i % 2 ? .4 : 0.));
      const glm::dvec3 wo = random.direction();
      put(random.point(5), s.pos_x, s.pos_y, s.pos_z);
      put(ng, s.ng_x, s.ng_y, s.ng_z);
      put(ns, s.ns_x, s.ns_y, s.ns_z);
      put(wo, s.wo_x, s.wo_y, s.wo_z);
      s.offset = 1e-5f;
      s.distance = random.in(1, 2);
      s.parameter = random.below(3);
      s.light = kNone;
      surfaces.set(i, s);
      PathState<Value> p{};
      p.throughput_r = random.unit(), p.throughput_g = random.unit(), p.throughput_b = 1;
      p.pdf = random.unit();
      p.slot = 1000 + i;
      p.pixel = 5000 + i;
      p.sample = 9000 + i;
      p.depth = (i % 5) | 3u << 16;
      paths.set(i, p);
      randoms.set(i, {random.unit(), random.unit(), random.unit(), random.unit(), random.unit(),
                      random.unit(), random.unit()});
      LightSample<Value> l{};
      const glm::dvec3 wi = random.direction();
      put(wi, l.wi_x, l.wi_y, l.wi_z);
      put(pos_of(s) + wi * 3., l.to_x, l.to_y, l.to_z);
      l.weight_r = i % 6 == 5 ? 0 : random.unit();
      l.weight_g = i % 6 == 5 ? 0 : .5f;
      l.weight_b = 0;
      l.pdf = i % 3 ? random.in(.1f, 2) : 0;
      lights.set(i, l);
    }
    out.rays = rays.columns();
    out.paths = next.columns();
    out.shadow_rays = shadows.columns();
    out.finished = finished.data();
  }
  void run(const KernelTable& k, MaterialKind kind, ParameterView parameters, bool with_lights) {
    ShadeInput in{surfaces.view(), paths.view(), randoms.view(), {}, parameters};
    if (with_lights) in.lights = lights.view();
    k.shade[uint32_t(kind)](in, options, out, drops, n);
    EXPECT_TRUE(rays.untouched() && next.untouched() && shadows.untouched() &&
                finished.untouched());
    EXPECT_LE(out.shadow_count, n);
    EXPECT_EQ(out.path_count + out.finished_count, n) << "each path goes on or ends";
  }
};

/// The frame rule of kernels/material.h: normals on wo's side, ng where ns cannot see wo.
struct Normals {
  glm::dvec3 ng, ns;
  explicit Normals(const Surface<Value>& s) : ng(ng_of(s)), ns(ns_of(s)) {
    if (glm::dot(ng, wo_of(s)) <= 0) ng = -ng, ns = -ns;
    if (glm::dot(ns, wo_of(s)) <= 0) ns = ng;
  }
};

RowTable<MatteParameters> matte_rows() {
  RowTable<MatteParameters> rows(3);
  rows.set(0, {.5f, .5f, .5f});
  rows.set(1, {1, .25f, .75f});
  rows.set(2, {.1f, .9f, 0});
  return rows;
}

TEST_P(ShadeStage, MatteShadingIsWhatDoublePrecisionSays) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  for (const uint32_t n : tail_counts(k.lanes)) {
    ShadeCase c(n);
    c.options.max_depth = 4;
    c.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
    for (const uint64_t count : c.drops.count) EXPECT_EQ(count, 0u);
    uint32_t shadow = 0, next = 0, ended = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const Surface<Value> s = c.surfaces.row(i);
      const PathState<Value> p = c.paths.row(i);
      const LightSample<Value> l = c.lights.row(i);
      const Normals normals(s);
      const MatteParameters<Value> kd = rows.row(s.parameter);
      const glm::dvec3 albedo(kd.kd_r, kd.kd_g, kd.kd_b);
      const glm::dvec3 throughput(p.throughput_r, p.throughput_g, p.throughput_b);
      const bool last = (p.depth & 0xffff) >= 4;
      const glm::dvec3 wi(l.wi_x, l.wi_y, l.wi_z);
      const double cos = glm::dot(normals.ns, wi), geometric = glm::dot(normals.ng, wi);
      if (!last && l.weight_r > 0 && cos > 0 && geometric > 0) {
        ASSERT_LT(shadow, c.out.shadow_count);
        const ShadowRay<Value> ray = c.shadows.row(shadow++);
        const double ratio = l.pdf > 0 ? cos / kPi / double(l.pdf) : 0;
        const glm::dvec3 add = throughput * albedo / kPi * cos *
                               glm::dvec3(l.weight_r, l.weight_g, l.weight_b) / (1 + ratio * ratio);
        EXPECT_EQ(ray.slot, p.slot);
        expect_near({ray.add_r, ray.add_g, ray.add_b}, add, 2e-6, "direct light", i);
        const glm::dvec3 org(ray.org_x, ray.org_y, ray.org_z), dir(ray.dir_x, ray.dir_y, ray.dir_z);
        expect_near(org, pos_of(s) + normals.ng * double(s.offset), 2e-6, "shadow origin", i);
        expect_near(org + dir, {l.to_x, l.to_y, l.to_z}, 3e-6, "shadow end", i);
      }
      // The next ray: below the geometric horizon it ends.
      const bool goes_on = next < c.out.path_count && c.next.row(next).slot == p.slot;
      if (last) {
        EXPECT_FALSE(goes_on);
      }
      if (!goes_on) {
        ASSERT_LT(ended, c.out.finished_count);
        EXPECT_EQ(c.finished[ended++], p.slot);
        if (!last && i % 2 == 0) ADD_FAILURE() << "ns = ng: no direction lies below";
        continue;
      }
      const PathState<Value> q = c.next.row(next);
      const Ray<Value> ray = c.rays.row(next++);
      const glm::dvec3 dir(ray.dir_x, ray.dir_y, ray.dir_z);
      expect_close(glm::length(dir), 1, 1e-6, "|dir|", i);
      EXPECT_GT(glm::dot(dir, normals.ng), 0);
      expect_near({q.throughput_r, q.throughput_g, q.throughput_b}, throughput * albedo, 1e-6,
                  "throughput", i);
      EXPECT_NEAR(q.pdf, glm::dot(dir, normals.ns) / kPi, 1e-6);
      expect_near({ray.org_x, ray.org_y, ray.org_z}, pos_of(s) + normals.ng * double(s.offset),
                  2e-6, "origin", i);
      EXPECT_EQ(ray.t_max, kRayFar);
      EXPECT_EQ(q.passed, 0.f);
      EXPECT_EQ(q.depth, p.depth + 1) << "one vertex more, crossings kept";
      EXPECT_EQ(q.pixel, p.pixel);
      EXPECT_EQ(q.sample, p.sample);
    }
    EXPECT_EQ(shadow, c.out.shadow_count);
    EXPECT_EQ(next, c.out.path_count);
  }
}

TEST_P(ShadeStage, OutputsAreAppended) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  ShadeCase c(20);
  c.options.max_depth = 3;
  c.out.path_count = 5, c.out.shadow_count = 7, c.out.finished_count = 2;
  ShadeInput in{
      c.surfaces.view(), c.paths.view(), c.randoms.view(), c.lights.view(), {rows.view().words, 3}};
  k.shade[uint32_t(MaterialKind::kMatte)](in, c.options, c.out, c.drops, 20);
  for (uint32_t i = 0; i < 5; ++i) EXPECT_EQ(c.next.row(i).slot, kPattern);
  for (uint32_t i = 0; i < 7; ++i) EXPECT_EQ(c.shadows.row(i).slot, kPattern);
  for (uint32_t i = 0; i < 2; ++i) EXPECT_EQ(c.finished[i], kPattern);
  EXPECT_EQ(c.out.path_count - 5 + c.out.finished_count - 2, 20u);
}

// Invariant 1: a row's result does not depend on where it stands or on what is beside it.
TEST_P(ShadeStage, RowsAreIndependent) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  ShadeCase all(37);
  all.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
  std::map<uint32_t, Ray<Value>> ray_of;
  std::map<uint32_t, float> add_of;
  for (uint32_t i = 0; i < all.out.path_count; ++i) ray_of[all.next.row(i).slot] = all.rays.row(i);
  for (uint32_t i = 0; i < all.out.shadow_count; ++i)
    add_of[all.shadows.row(i).slot] = all.shadows.row(i).add_r;
  for (uint32_t i = 0; i < 37; ++i) {
    ShadeCase one(1);
    one.surfaces.set(0, all.surfaces.row(i));
    one.paths.set(0, all.paths.row(i));
    one.randoms.set(0, all.randoms.row(i));
    one.lights.set(0, all.lights.row(i));
    one.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
    const uint32_t slot = all.paths.row(i).slot;
    ASSERT_EQ(one.out.path_count, ray_of.count(slot));
    ASSERT_EQ(one.out.shadow_count, add_of.count(slot));
    if (one.out.path_count)
      for_each_field([](auto, auto a, auto b) { EXPECT_EQ(a, b); }, one.rays.row(0), ray_of[slot]);
    if (one.out.shadow_count) {
      EXPECT_EQ(one.shadows.row(0).add_r, add_of[slot]);
    }
  }
}

TEST_P(ShadeStage, GlassAndMirrorGoOnWithoutDensity) {
  const KernelTable& k = kernels();
  RowTable<MirrorParameters> mirror(1);
  mirror.set(0, {.5f, .25f, 1});
  RowTable<GlassParameters> glass(1);
  glass.set(0, {1, 1, 1, 1, 1, 1, 1.5f});
  for (const uint32_t n : tail_counts(k.lanes)) {
    for (const MaterialKind kind : {MaterialKind::kMirror, MaterialKind::kGlass}) {
      ShadeCase c(n);
      c.options.least_depth_after_scatter = 9;  // only for materials that scatter
      c.run(k, kind, {kind == MaterialKind::kMirror ? mirror.view().words : glass.view().words, 1},
            false);
      EXPECT_EQ(c.out.shadow_count, 0u);
      std::map<uint32_t, uint32_t> row_of;
      for (uint32_t i = 0; i < n; ++i) row_of[c.paths.row(i).slot] = i;
      for (uint32_t j = 0; j < c.out.path_count; ++j) {
        const PathState<Value> q = c.next.row(j);
        const Ray<Value> ray = c.rays.row(j);
        const uint32_t i = row_of[q.slot];
        const Surface<Value> s = c.surfaces.row(i);
        const Normals normals(s);
        const glm::dvec3 wo = wo_of(s), dir(ray.dir_x, ray.dir_y, ray.dir_z);
        EXPECT_EQ(q.pdf, 0.f);
        EXPECT_EQ(q.depth, c.paths.row(i).depth + 1);
        const double side = glm::dot(dir, normals.ng) > 0 ? 1 : -1;
        expect_near({ray.org_x, ray.org_y, ray.org_z},
                    pos_of(s) + normals.ng * (double(s.offset) * side), 2e-6, "origin", i);
        const glm::dvec3 reflected = normals.ns * (2 * glm::dot(normals.ns, wo)) - wo;
        if (side > 0) {
          expect_near(dir, reflected, 2e-6, "reflection", i);
        } else {
          const bool outside = glm::dot(ng_of(s), wo) > 0;
          const double eta = outside ? 1 / 1.5 : 1.5;
          const glm::dvec3 tangential = (wo - normals.ns * glm::dot(normals.ns, wo)) * -eta;
          expect_near(dir - normals.ns * glm::dot(normals.ns, dir), tangential, 3e-6, "Snell", i);
        }
      }
    }
  }
}

TEST_P(ShadeStage, NullLetsPathsPassAndCountsCrossings) {
  const KernelTable& k = kernels();
  RowTable<NullParameters> rows(1);
  for (const uint32_t n : tail_counts(k.lanes)) {
    ShadeCase c(n);
    c.options.max_depth = 2;  // does not end a path here: what is behind may still shine
    uint32_t over = 0;
    for (uint32_t i = 3; i < n; i += 5, ++over) {
      PathState<Value> p = c.paths.row(i);
      p.depth = 0xffff0000u | 1;
      c.paths.set(i, p);
    }
    c.run(k, MaterialKind::kNull, {rows.view().words, 1}, false);
    EXPECT_EQ(c.drops.count[uint32_t(DropCause::kCrossings)], over);
    EXPECT_EQ(c.out.finished_count, over);
    uint32_t j = 0;
    for (uint32_t i = 0; i < n; ++i) {
      if (i % 5 == 3) continue;
      const PathState<Value> p = c.paths.row(i), q = c.next.row(j);
      const Surface<Value> s = c.surfaces.row(i);
      const Ray<Value> ray = c.rays.row(j++);
      const glm::dvec3 dir(ray.dir_x, ray.dir_y, ray.dir_z);
      EXPECT_EQ(dir, -wo_of(s));
      EXPECT_EQ(q.depth, p.depth + 0x10000u);
      EXPECT_EQ(q.pdf, p.pdf);
      EXPECT_EQ(q.passed, s.distance);
      EXPECT_EQ(q.throughput_g, p.throughput_g);
      const double side = glm::dot(ng_of(s), dir) > 0 ? 1 : -1;
      expect_near({ray.org_x, ray.org_y, ray.org_z},
                  pos_of(s) + ng_of(s) * (double(s.offset) * side), 2e-6, "origin", i);
    }
    EXPECT_EQ(j, c.out.path_count);
  }
}

TEST_P(ShadeStage, DirectIntegratorEndsAfterScattering) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  ShadeCase c(50);
  c.options.max_depth = 8;
  c.options.least_depth_after_scatter = 8;
  c.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
  ASSERT_GT(c.out.path_count, 0u);
  for (uint32_t i = 0; i < c.out.path_count; ++i) EXPECT_EQ(c.next.row(i).depth, 8u | 3u << 16);
}

// Roulette keeps the expectation: over many rows that differ in the roulette number alone, the mean
// throughput is the one without roulette, and no survivor's grows above a third.
TEST_P(ShadeStage, RouletteIsUnbiased) {
  const KernelTable& k = kernels();
  RowTable<MatteParameters> rows(1);
  rows.set(0, {.5f, .2f, .1f});
  constexpr uint32_t n = 10000;
  for (const float sign : {1.f, -1.f}) {  // negative: a filter's lobe
    ShadeCase c(n);
    for (uint32_t i = 0; i < n; ++i) {
      c.surfaces.set(i, c.surfaces.row(0));
      PathState<Value> p = c.paths.row(0);
      p.throughput_r = p.throughput_g = p.throughput_b = .4f * sign;
      p.depth = 3;
      p.slot = i;
      c.paths.set(i, p);
      Randoms<Value> r = c.randoms.row(0);
      r.bsdf_u = .3f, r.bsdf_v = .6f;
      r.roulette = (float(i) + .5f) / n;
      c.randoms.set(i, r);
    }
    c.options.roulette_depth = 3;
    c.run(k, MaterialKind::kMatte, {rows.view().words, 1}, false);
    glm::dvec3 sum(0);
    for (uint32_t i = 0; i < c.out.path_count; ++i) {
      const PathState<Value> q = c.next.row(i);
      EXPECT_LE(std::abs(q.throughput_r), 1.f / 3 + 1e-6f);
      sum += glm::dvec3(q.throughput_r, q.throughput_g, q.throughput_b) / double(n);
    }
    EXPECT_NEAR(c.out.path_count / double(n), .6, 1e-3);
    expect_near(sum, glm::dvec3(.2, .08, .04) * double(sign), 1e-4, "mean throughput", 0);
    for (uint32_t i = 0; i < n; ++i) {
      PathState<Value> p = c.paths.row(i);
      p.depth = 2;
      c.paths.set(i, p);
    }
    c.out.path_count = c.out.finished_count = 0;
    c.run(k, MaterialKind::kMatte, {rows.view().words, 1}, false);
    EXPECT_EQ(c.out.path_count, n) << "not before its depth";
  }
}

// N1: one poisoned lane among others. It is dropped and counted; the others are as without it.
TEST_P(ShadeStage, PoisonedRowsAreDroppedCountedAndAlone) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = INFINITY;
  struct Poison {
    const char* what;
    DropCause cause;
    uint64_t drops;  ///< direct light and next ray count by themselves
    void (*apply)(ShadeCase&, uint32_t, float);
  };
  const Poison poisons[] = {{"light", DropCause::kLight, 1,
                             [](ShadeCase& c, uint32_t i, float x) {
                               auto l = c.lights.row(i);
                               l.weight_g = x;
                               c.lights.set(i, l);
                             }},
                            {"throughput", DropCause::kOther, 2,
                             [](ShadeCase& c, uint32_t i, float x) {
                               auto p = c.paths.row(i);
                               p.throughput_g = x == -1 ? INFINITY : x;
                               c.paths.set(i, p);
                             }},
                            {"material", DropCause::kBsdf, 2, [](ShadeCase& c, uint32_t i, float) {
                               auto s = c.surfaces.row(i);
                               s.parameter = 3;
                               c.surfaces.set(i, s);
                             }}};
  for (const Poison& poison : poisons)
    for (const float bad : {nan, inf, -1.f}) {
      SCOPED_TRACE(std::string(poison.what) + " " + std::to_string(bad));
      RowTable<MatteParameters> table(4);
      for (uint32_t i = 0; i < 3; ++i) table.set(i, rows.row(i));
      table.set(3, {.5f, bad, .5f});
      ShadeCase clean(53), poisoned(53);
      clean.run(k, MaterialKind::kMatte, {table.view().words, 4}, true);
      // A row that has both a shadow ray and a next ray.
      uint32_t slot = 0;
      for (uint32_t i = 0; i < clean.out.shadow_count; ++i)
        for (uint32_t j = 0; j < clean.out.path_count; ++j)
          if (clean.shadows.row(i).slot == clean.next.row(j).slot) slot = clean.next.row(j).slot;
      ASSERT_NE(slot, 0u);
      poison.apply(poisoned, slot - 1000, bad);
      poisoned.run(k, MaterialKind::kMatte, {table.view().words, 4}, true);
      for (uint32_t cause = 0; cause < kDropCauses; ++cause)
        EXPECT_EQ(poisoned.drops.count[cause], cause == uint32_t(poison.cause) ? poison.drops : 0u);
      ASSERT_EQ(poisoned.drops.kept, poison.drops);
      EXPECT_EQ(poisoned.drops.entry[0].pixel, 5000 + slot - 1000);
      EXPECT_EQ(poisoned.drops.entry[0].sample, 9000 + slot - 1000);
      // All others, bit for bit.
      uint32_t j = 0;
      for (uint32_t i = 0; i < clean.out.shadow_count; ++i) {
        const ShadowRay<Value> ray = clean.shadows.row(i);
        if (ray.slot == slot) continue;
        for_each_field([](auto, auto a, auto b) { EXPECT_EQ(a, b); }, ray,
                       poisoned.shadows.row(j++));
      }
      EXPECT_EQ(j, poisoned.out.shadow_count);
      for (uint32_t i = 0, m = 0; i < clean.out.path_count; ++i) {
        const PathState<Value> path = clean.next.row(i);
        if (path.slot == slot && poison.drops == 2) continue;
        for_each_field([](auto, auto a, auto b) { EXPECT_EQ(a, b); }, path, poisoned.next.row(m++));
      }
    }
}

// Shading normals of every tilt, and unit vectors that are not (B5): nothing but numbers comes out.
TEST_P(ShadeStage, ShadingNormalsBeyondTheHorizonGiveNumbers) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  constexpr uint32_t n = 1000;
  ShadeCase c(n);
  Random random(9);
  for (uint32_t i = 0; i < n; ++i) {
    Surface<Value> s = c.surfaces.row(i);
    const glm::dvec3 ng = ng_of(s);
    glm::dvec3 ns = random.direction();
    if (glm::dot(ns, ng) < 0) ns = -ns;
    glm::dvec3 wo = wo_of(s);
    if (i % 4 == 0) wo = glm::normalize(wo - ng * glm::dot(wo, ng));  // grazing
    if (i % 8 == 1) ns = {0, 0, -1};
    put(ns, s.ns_x, s.ns_y, s.ns_z);
    put(wo, s.wo_x, s.wo_y, s.wo_z);
    c.surfaces.set(i, s);
  }
  c.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
  for (const uint64_t count : c.drops.count) EXPECT_EQ(count, 0u);
  for (uint32_t i = 0; i < c.out.path_count; ++i) {
    EXPECT_TRUE(std::isfinite(c.rays.row(i).dir_x) && c.next.row(i).pdf > 0);
    EXPECT_LE(c.next.row(i).throughput_r, 1.f);
  }
  EXPECT_GT(c.out.path_count, n / 2);
}

// ---- Shadow rays alone -------------------------------------------------------------------------

TEST_P(ShadeStage, ConnectMakesTheShadowRaysOfShading) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  for (const uint32_t n : tail_counts(k.lanes)) {
    ShadeCase shaded(n), connected(n);
    for (ShadeCase* c : {&shaded, &connected}) c->options.shadow_bound = .05f;
    shaded.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
    const ShadeInput in{connected.surfaces.view(),
                        connected.paths.view(),
                        {},
                        connected.lights.view(),
                        {rows.view().words, 3}};
    ShadeOutput out;
    out.shadow_rays = connected.shadows.columns();
    k.connect[uint32_t(MaterialKind::kMatte)](in, connected.options, out, connected.drops, n);
    EXPECT_TRUE(connected.shadows.untouched());
    EXPECT_EQ(out.path_count + out.finished_count, 0u);
    ASSERT_EQ(out.shadow_count, shaded.out.shadow_count);
    for (uint32_t i = 0; i < out.shadow_count; ++i) {
      const ShadowRay<Value> a = connected.shadows.row(i), b = shaded.shadows.row(i);
      for (const auto field : {&ShadowRay<Value>::org_x, &ShadowRay<Value>::dir_y,
                               &ShadowRay<Value>::add_r, &ShadowRay<Value>::add_b})
        EXPECT_EQ(a.*field, b.*field);
      EXPECT_EQ(a.slot, b.slot);
    }
  }
}

TEST_P(ShadeStage, FaintShadowRaysPlayRoulette) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  constexpr uint32_t kRows = 20000, kLight = 2;
  ShadeCase all(kRows), played(kRows);
  const auto connect = [&](ShadeCase& c, float bound) {
    c.options.seed = 7;
    c.options.shadow_bound = bound;
    const ShadeInput in{.surfaces = c.surfaces.view(),
                        .paths = c.paths.view(),
                        .randoms = {},
                        .lights = c.lights.view(),
                        .parameters = {rows.view().words, 3},
                        .light = kLight};
    ShadeOutput out;
    out.shadow_rays = c.shadows.columns();
    k.connect[uint32_t(MaterialKind::kMatte)](in, c.options, out, c.drops, kRows);
    return out.shadow_count;
  };
  const uint32_t rays = connect(all, 0);
  constexpr float kBound = .03f;
  const uint32_t left = connect(played, kBound);
  uint32_t next = 0, faint = 0, survivors = 0;
  double before = 0, after = 0, variance = 0;
  for (uint32_t i = 0; i < rays; ++i) {
    const ShadowRay<Value> ray = all.shadows.row(i);
    const float most = std::max({ray.add_r, ray.add_g, ray.add_b});
    const PathState<Value> path = all.paths.row(ray.slot - 1000);
    const float chance = most < kBound ? std::max(most / kBound, kLeastShadowChance) : 1.f;
    const float u = random_pair(SamplerKind::kIndependent, 7, of_light(Dimension::kShadow, kLight),
                                path.pixel, path.sample, path.depth)
                        .first;
    faint += most < kBound;
    before += double(most);
    variance += double(most) * double(most) * (1 / double(chance) - 1);
    if (u >= chance) continue;
    ASSERT_LT(next, left);
    const ShadowRay<Value> traced = played.shadows.row(next++);
    survivors += most < kBound;
    EXPECT_EQ(traced.slot, ray.slot);
    EXPECT_EQ(traced.dir_x, ray.dir_x);
    EXPECT_NEAR(traced.add_g, ray.add_g / chance, 1e-6f * ray.add_g / chance);
    after += double(std::max({traced.add_r, traced.add_g, traced.add_b}));
  }
  EXPECT_EQ(next, left);
  EXPECT_GT(faint, kRows / 10);
  EXPECT_GT(survivors, 0u);
  EXPECT_LT(survivors, faint);
  EXPECT_LT(std::fabs(after - before), 4.5 * std::sqrt(variance)) << "false alarm: 7e-6";
}

}  // namespace
}  // namespace yat
