// Spheres and planes against double precision, and rays that leave or enter a sphere's surface.

#include "per_isa.h"
#include "traverse_scenes.h"

namespace yat {
namespace {

using namespace testing_traverse;

class Quadrics : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Quadrics);

RowTable<SphereRow> sphere_rows(const std::vector<SphereRow<Value>>& list) {
  RowTable<SphereRow> rows(uint32_t(list.size()));
  for (uint32_t i = 0; i < list.size(); ++i) rows.set(i, list[i]);
  return rows;
}

std::vector<Ray<Value>> random_rays(uint32_t n, uint32_t seed) {
  Rng rng(seed);
  std::vector<Ray<Value>> rays;
  for (uint32_t i = 0; i < n; ++i)
    rays.push_back(make_ray(random_point(rng, 3), random_direction(rng)));
  return rays;
}

/// Nearest distance > 0 in double, or negative.
double sphere_exact(const SphereRow<Value>& s, const Ray<Value>& r) {
  const Vec f = Vec{double(r.org_x), double(r.org_y), double(r.org_z)} -
                Vec{double(s.center_x), double(s.center_y), double(s.center_z)};
  const Vec d{double(r.dir_x), double(r.dir_y), double(r.dir_z)};
  const double a = dot(d, d), b = dot(f, d), c = dot(f, f) - double(s.radius) * double(s.radius);
  const double disc = b * b - a * c;
  if (disc < 0) return -1;
  const double t0 = (-b - std::sqrt(disc)) / a, t1 = (-b + std::sqrt(disc)) / a;
  return t0 > 0 ? t0 : t1;
}

TEST_P(Quadrics, SpheresAgreeWithDouble) {
  std::vector<SphereRow<Value>> list;
  Rng rng(3);
  for (uint32_t i = 0; i < 5; ++i) {
    SphereRow<Value> s{};
    s.center_x = float(uniform(rng, -2, 2));
    s.center_y = float(uniform(rng, -2, 2));
    s.center_z = float(uniform(rng, -2, 2));
    s.radius = float(uniform(rng, 0.2, 1));
    s.light = kNone;
    s.occludes = i != 2;
    list.push_back(s);
  }
  const RowTable<SphereRow> rows = sphere_rows(list);
  std::vector<uint32_t> counts = tail_counts(kernels().lanes);
  counts.push_back(2000);
  for (const uint32_t n : counts) {
    const std::vector<Ray<Value>> rays = random_rays(n, n);
    Table<Hit> hits{n + 1};
    for (uint32_t i = 0; i < n; ++i)
      hits.set(i, {i % 2 ? 1.5f : kRayFar, .3f, .4f, i % 2 ? 1 : kNone});
    Table<ShadowRay> shadow{n + 1};
    AlignedArray<uint32_t> occluded(n + 1);
    for (uint32_t i = 0; i < n; ++i) {
      const auto& r = rays[i];
      shadow.set(i, {r.org_x, r.org_y, r.org_z, 2 * r.dir_x, 2 * r.dir_y, 2 * r.dir_z, 0, 0, 0, 0});
      occluded[i] = i % 5 == 0;
    }
    kernels().intersect_spheres(rows.view(), 100, to_table(rays).view(), hits.columns(), n);
    kernels().shadow_spheres(rows.view(), shadow.view(), occluded.data(), n);
    for (uint32_t i = 0; i < n; ++i) {
      double best = i % 2 ? 1.5 : double(kRayFar), solid = HUGE_VAL;
      uint32_t prim = i % 2 ? 1 : kNone;
      for (uint32_t s = 0; s < list.size(); ++s) {
        const double t = sphere_exact(list[s], rays[i]);
        if (t > 0 && t < best) best = t, prim = 100 + s;
        if (t > 0 && list[s].occludes) solid = std::min(solid, t);
      }
      const Hit<Value> h = hits.row(i);
      ASSERT_EQ(h.prim, prim) << i << " of " << n;
      ASSERT_NEAR(double(h.t) / best, 1, 3e-5);
      if (prim >= 100 && prim != kNone) {
        ASSERT_EQ(h.u, 0.f);
      } else {
        ASSERT_EQ(h.u, .3f);
      }
      if (std::abs(solid - 2) > 1e-4) {
        ASSERT_EQ(occluded[i], uint32_t(i % 5 == 0 || solid < 2)) << i << " of " << n;
      }
    }
  }
}

TEST_P(Quadrics, PlanesAgreeWithDouble) {
  RowTable<PlaneRow> rows(2);
  rows.set(0, {0, 0, 1, -0.5f, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0});
  rows.set(1, {0.6f, 0.8f, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  std::vector<uint32_t> counts = tail_counts(kernels().lanes);
  counts.push_back(1000);
  for (const uint32_t n : counts) {
    std::vector<Ray<Value>> rays = random_rays(n, n + 1);
    for (uint32_t i = 4; i < n; i += 5)
      rays[i] = make_ray({0, 0, double(i)}, {1, 0, 0});  // Parallel.
    Table<Hit> hits{n + 1};
    Table<ShadowRay> shadow{n + 1};
    AlignedArray<uint32_t> occluded(n + 1);
    for (uint32_t i = 0; i < n; ++i) {
      const auto& r = rays[i];
      hits.set(i, {kRayFar, 0, 0, kNone});
      shadow.set(i, {r.org_x, r.org_y, r.org_z, 3 * r.dir_x, 3 * r.dir_y, 3 * r.dir_z, 0, 0, 0, 0});
    }
    kernels().intersect_planes(rows.view(), 7, to_table(rays).view(), hits.columns(), n);
    kernels().shadow_planes(rows.view(), shadow.view(), occluded.data(), n);
    for (uint32_t i = 0; i < n; ++i) {
      const auto& r = rays[i];
      const double t0 = (-0.5 - double(r.org_z)) / double(r.dir_z);
      const double t1 = (2 - double(0.6f) * double(r.org_x) - double(0.8f) * double(r.org_y)) /
                        (double(0.6f) * double(r.dir_x) + double(0.8f) * double(r.dir_y));
      double best = double(kRayFar);
      uint32_t prim = kNone;
      if (t0 > 0 && t0 < best) best = t0, prim = 7;
      if (t1 > 0 && t1 < best) best = t1, prim = 8;
      ASSERT_EQ(hits.row(i).prim, prim) << i << " of " << n;
      ASSERT_NEAR(double(hits.row(i).t) / best, 1, 1e-3);
      ASSERT_EQ(occluded[i], uint32_t(t0 > 0 && t0 < 3)) << i;
    }
  }
}

TEST_P(Quadrics, RaysSpawnedOnASphere) {
  for (const double radius : {1e-3, 1., 1e3})
    for (const double away : {0., 3., 100.}) {
      Rng rng(2);
      const Vec center = random_direction(rng) * (away * radius);
      SphereRow<Value> s{};
      s.center_x = float(center.x), s.center_y = float(center.y), s.center_z = float(center.z);
      s.radius = float(radius);
      s.light = kNone;
      s.occludes = 1;
      const RowTable<SphereRow> rows = sphere_rows({s});
      std::vector<Ray<Value>> rays;
      std::vector<bool> outward;
      const double magnitude =
          double(std::max({std::abs(s.center_x), std::abs(s.center_y), std::abs(s.center_z)})) +
          radius;
      for (uint32_t i = 0; i < 20000; ++i) {
        const Vec n = random_direction(rng);
        Vec d = random_direction(rng);
        if (i % 4 == 0) d = unit(d - n * (dot(d, n) * 0.9999));
        const bool out = dot(d, n) > 0;
        const double offset = magnitude * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) * 32 *
                              0x1p-23 * (out ? 1 : -1);
        const Ray<Value> at = make_ray(
            Vec{double(s.center_x), double(s.center_y), double(s.center_z)} + n * radius, d);
        rays.push_back(
            make_ray(Vec{double(at.org_x), double(at.org_y), double(at.org_z)} + n * offset, d));
        outward.push_back(out);
      }
      Table<Hit> hits{uint32_t(rays.size())};
      for (uint32_t i = 0; i < rays.size(); ++i) hits.set(i, {kRayFar, 0, 0, kNone});
      kernels().intersect_spheres(rows.view(), 0, to_table(rays).view(), hits.columns(),
                                  uint32_t(rays.size()));
      uint32_t self_hits = 0, lost = 0;
      for (uint32_t i = 0; i < rays.size(); ++i) {
        const bool hit = hits.row(i).prim != kNone;
        self_hits += outward[i] && hit;
        lost += !outward[i] && !hit;
        // The far side: the chord of the direction, not the point just left.
        if (!outward[i] && hit) {
          const double exact = sphere_exact(s, rays[i]);
          ASSERT_NEAR(double(hits.row(i).t), exact,
                      1e-2 * exact + 1e-4 * radius + magnitude * 1e-5);
        }
      }
      EXPECT_EQ(self_hits, 0u) << "radius " << radius << " away " << away;
      EXPECT_EQ(lost, 0u) << "radius " << radius << " away " << away;
    }
}

}  // namespace
}  // namespace yat
