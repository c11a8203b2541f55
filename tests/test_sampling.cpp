// Random numbers and camera rays.

#include <algorithm>
#include <glm/common.hpp>
#include <set>

#include "chi2.h"
#include "kernel_columns.h"
#include "kernels/rng_scalar.h"

namespace yat {
namespace {

class Draw : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Draw);
class Camera : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Camera);

constexpr SamplerKind kSamplers[] = {SamplerKind::kIndependent,
                                     SamplerKind::kSobol,
                                     SamplerKind::kRegular,
                                     SamplerKind::kJittered,
                                     SamplerKind::kNRooks,
                                     SamplerKind::kMultiJittered,
                                     SamplerKind::kCorrelatedMultiJittered,
                                     SamplerKind::kZSobol};

TEST_P(Draw, GivesTheBitsOfTheScalarCodeAtEveryCount) {
  const KernelTable& k = kernels();
  Random random(1);
  for (const SamplerKind sampler : kSamplers)
    for (const uint32_t n : tail_counts(k.lanes)) {
      GuardedTable<PathState> paths(n);
      for (uint32_t i = 0; i < n; ++i) {
        PathState<Value> p{};
        p.pixel = random.below(0x7fffffff);
        p.sample = i % 3 ? random.below(1 << 20) : 0xffffffffu - i;
        p.depth = random.below(20) | random.below(9) << 16;  // crossings must not matter
        paths.set(i, p);
      }
      const auto view = paths.view();
      for (const bool with_depth : {true, false}) {
        GuardedColumn<float> first(n), second(n);
        k.draw[uint32_t(sampler)](7, Dimension::kLight, view.pixel, view.sample,
                                  with_depth ? view.depth : nullptr, first.data(), second.data(),
                                  n);
        for (uint32_t i = 0; i < n; ++i) {
          const auto [a, b] = random_pair(sampler, 7, Dimension::kLight, view.pixel[i],
                                          view.sample[i], with_depth ? view.depth[i] & 0xffffu : 0);
          EXPECT_EQ(first[i], a);
          EXPECT_EQ(second[i], b);
          EXPECT_TRUE(a >= 0 && a < 1 && b >= 0 && b < 1);
        }
        EXPECT_TRUE(first.untouched() && second.untouched());
        GuardedColumn<float> alone(n);
        k.draw[uint32_t(sampler)](7, Dimension::kLight, view.pixel, view.sample,
                                  with_depth ? view.depth : nullptr, alone.data(), nullptr, n);
        for (uint32_t i = 0; i < n; ++i) EXPECT_EQ(alone[i], first[i]);
      }
    }
}

// Sobol': every aligned run of 2^k samples has one point in every elementary interval of area 2^-k,
// under every key (numerical-stability matrix, A2).
TEST(Sobol, EveryAlignedRunIsAZeroTwoNet) {
  Random random(2);
  for (int trial = 0; trial < 24; ++trial) {
    const uint32_t seed = random.below(1000), pixel = random.below(0x40000000),
                   vertex = random.below(12);
    const auto dimension = Dimension(random.below(uint32_t(Dimension::kCount)));
    const int k = trial % 11;
    const uint32_t n = 1u << k, run = trial % 3 == 2 ? (0xffffffffu >> k) : random.below(5);
    for (int a = 0; a <= k; ++a) {
      std::vector<int> seen(n);
      for (uint32_t i = 0; i < n; ++i) {
        const auto [x, y] =
            random_pair(SamplerKind::kSobol, seed, dimension, pixel, run * n + i, vertex);
        const auto column = uint32_t(x * float(1 << a)), row = uint32_t(y * float(1 << (k - a)));
        ++seen[(column << (k - a)) + row];
      }
      EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), int(n))
          << "2^" << k << " samples, intervals of 2^-" << a << " x 2^-" << k - a;
    }
  }
}

// Each case is one chi-square test over 64 x 64 cells; together at 1 % (Sidak).
TEST(Rng, PairsAreUniformAndIndependent) {
  const double level = sidak_level(27);
  for (const SamplerKind sampler : kSamplers) {
    if (sampler == SamplerKind::kRegular) continue;  // the middles of cells alone
    SquareHistogram one_pair(64), two_dimensions(64), two_vertices(64), two_pixels(64);
    for (uint32_t pixel = 0; pixel < 1u << 18; ++pixel) {
      const uint32_t name = pixel / 512 << 16 | pixel % 512, sample = pixel % 7;
      const auto draw = [&](Dimension d, uint32_t at, uint32_t vertex) {
        return random_pair(sampler, 3, d, at, sample, vertex);
      };
      const auto a = draw(Dimension::kLight, name, 1);
      one_pair.add(double(a.first), double(a.second));
      two_dimensions.add(double(a.first), double(draw(Dimension::kBsdf, name, 1).first));
      two_vertices.add(double(a.second), double(draw(Dimension::kLight, name, 2).second));
      two_pixels.add(double(a.first), double(draw(Dimension::kLight, name + 1, 1).first));
    }
    EXPECT_GE(one_pair.p_value(), level);
    EXPECT_GE(two_dimensions.p_value(), level);
    EXPECT_GE(two_vertices.p_value(), level);
    if (sampler == SamplerKind::kZSobol) continue;  // neighbours are made for each other
    EXPECT_GE(two_pixels.p_value(), level);
  }
}

TEST(Rng, NoNumberRoundsToOne) {
  EXPECT_LT(float(0xffffffffu >> 8) * 0x1p-24f, 1.f);
  EXPECT_EQ(float(0xffffffffu >> 8) * 0x1p-24f, 1.f - 0x1p-24f);
}

// ---- Camera ----------------------------------------------------------------------------------

/// Looks along +y from (1, 2, 3); a 200 x 100 image.
CameraView test_camera() {
  CameraView c{};
  const float origin[3] = {1, 2, 3}, corner[3] = {-1, 1, .5f}, dx[3] = {.01f, 0, 0},
              dy[3] = {0, 0, -.01f}, forward[3] = {0, 1, 0}, lx[3] = {.2f, 0, 0},
              ly[3] = {0, 0, .2f};
  std::copy_n(origin, 3, c.origin);
  std::copy_n(corner, 3, c.corner);
  std::copy_n(dx, 3, c.dx);
  std::copy_n(dy, 3, c.dy);
  std::copy_n(forward, 3, c.forward);
  std::copy_n(lx, 3, c.lens_x);
  std::copy_n(ly, 3, c.lens_y);
  c.focal_distance = 5;
  c.near_depth = .25f;
  c.far_depth = 100;
  return c;
}

TEST_P(Camera, RaysMeetRasterPositionFocusAndNearPlane) {
  const KernelTable& k = kernels();
  SceneView scene{};
  scene.camera = test_camera();
  scene.filter.radius_x = .5f;
  scene.filter.radius_y = 1.5f;
  const glm::dvec3 origin(1, 2, 3);
  Random random(5);
  for (const bool thin : {false, true})
    for (const uint32_t n : tail_counts(k.lanes)) {
      GuardedTable<CameraSample> samples(n);
      GuardedColumn<float> fu(n), fv(n), lu(n), lv(n);
      for (uint32_t i = 0; i < n; ++i) {
        samples.set(i, {random.below(100) << 16 | random.below(200), i * 3, i + 5});
        for (GuardedColumn<float>* u : {&fu, &fv, &lu, &lv}) (*u)[i] = random.unit();
        if (i % 5 == 0) lu[i] = lv[i] = .5f;                     // the lens centre
        if (i % 7 == 0) fu[i] = fv[i] = lu[i] = 1.f - 0x1p-24f;  // the last number
      }
      GuardedTable<Ray> rays(n);
      GuardedTable<PathState> paths(n);
      k.generate_camera_rays[thin](scene, samples.view(), fu.data(), fv.data(),
                                   thin ? lu.data() : nullptr, thin ? lv.data() : nullptr,
                                   rays.columns(), paths.columns(), n);
      EXPECT_TRUE(rays.untouched() && paths.untouched());
      for (uint32_t i = 0; i < n; ++i) {
        const CameraSample<Value> s = samples.row(i);
        const Ray<Value> ray = rays.row(i);
        const PathState<Value> path = paths.row(i);
        const double x = (s.pixel & 0xffff) + .5 + (2 * double(fu[i]) - 1) * .5;
        const double y = (s.pixel >> 16) + .5 + (2 * double(fv[i]) - 1) * 1.5;
        const glm::dvec3 at_one(-1 + .01 * x, 1, .5 - .01 * y);
        const glm::dvec3 org(ray.org_x, ray.org_y, ray.org_z), dir(ray.dir_x, ray.dir_y, ray.dir_z);
        expect_close(glm::length(dir), 1, 3e-7, "|dir|", i);
        EXPECT_NEAR(org.y, 2.25, 1e-6) << "starts on the near plane";
        EXPECT_NEAR((org + dir * double(ray.t_max)).y, 102, 1e-4) << "ends on the far plane";
        // Through the point of the focus plane that the pinhole would see, from inside the lens.
        const double to_focus = (7 - org.y) / dir.y;
        const glm::dvec3 focus = origin + at_one * 5.;
        expect_near(org + dir * to_focus, focus, 2e-5, "focus", i);
        const glm::dvec3 on_lens = org + dir * ((2 - org.y) / dir.y) - origin;
        EXPECT_LE(glm::length(on_lens), thin ? .2 + 1e-5 : 1e-5);
        if (thin && i % 7 == 0 && i % 5) {
          EXPECT_GE(glm::length(on_lens), .199) << "u -> 1 is the rim";
        }
        EXPECT_EQ(path.throughput_r, 1.f);
        EXPECT_EQ(path.throughput_b, 1.f);
        EXPECT_EQ(path.pdf, 0.f);
        EXPECT_EQ(path.passed, 0.f);
        EXPECT_EQ(path.depth, 0u);
        EXPECT_EQ(path.slot, s.slot);
        EXPECT_EQ(path.pixel, s.pixel);
        EXPECT_EQ(path.sample, s.sample);
      }
    }
}

TEST_P(Camera, AFarFocusIsFinite) {
  const KernelTable& k = kernels();
  SceneView scene{};
  scene.camera = test_camera();
  scene.camera.focal_distance = 1e30f;
  scene.camera.far_depth = 1e30f;
  GuardedTable<CameraSample> samples(1);
  samples.set(0, {50 << 16 | 100, 0, 0});
  GuardedColumn<float> u(1);
  u[0] = .75f;
  GuardedTable<Ray> rays(1);
  GuardedTable<PathState> paths(1);
  k.generate_camera_rays[1](scene, samples.view(), u.data(), u.data(), u.data(), u.data(),
                            rays.columns(), paths.columns(), 1);
  const Ray<Value> ray = rays.row(0);
  EXPECT_LE(ray.t_max, kRayFar);
  EXPECT_NEAR(ray.dir_y, 1, 1e-4);
}

// Offsets in the pixel are distributed as the table says, sign included; cells without mass are
// never chosen.
TEST_P(Camera, FilterTablesAreSampledExactly) {
  const KernelTable& k = kernels();
  SceneView scene{};
  scene.camera = test_camera();
  scene.filter.kind = FilterKind::kTable;
  scene.filter.radius_x = 2;
  scene.filter.radius_y = 1;
  constexpr uint32_t B = kFilterBins;
  std::vector<double> mass(B * B);
  AlignedArray<float> marginal(B + 1), conditional(B * (B + 1)), sign(B * B);
  for (uint32_t y = 0; y < B; ++y)
    for (uint32_t x = 0; x < B; ++x) {
      const double fx = (x + .5) / B * 4 - 2, fy = (y + .5) / B * 2 - 1;
      const double f = y % 16 == 3 ? 0 : (std::cos(3 * fx) + .2) * (1.1 - fy * fy);
      mass[y * B + x] = std::abs(f);
      sign[y * B + x] = f < 0 ? -1.25f : 1.25f;
    }
  double total = 0;
  for (const double m : mass) total += m;
  double below = 0;
  for (uint32_t y = 0; y < B; ++y) {
    double row = 0;
    for (uint32_t x = 0; x < B; ++x) row += mass[y * B + x];
    double inside = 0;
    for (uint32_t x = 0; x < B; ++x) {
      inside += mass[y * B + x];
      conditional[y * (B + 1) + x + 1] = row > 0 ? float(inside / row) : float(x + 1) / B;
    }
    conditional[y * (B + 1) + B] = 1;
    below += row;
    marginal[y + 1] = float(below / total);
  }
  marginal[B] = 1;
  scene.filter.marginal = marginal.data();
  scene.filter.conditional = conditional.data();
  scene.filter.sign = sign.data();

  constexpr uint32_t n = 1 << 19;
  Table<CameraSample> samples(n);
  AlignedArray<float> u(n), v(n);
  for (uint32_t i = 0; i < n; ++i) {
    samples.set(i, {50 << 16 | 100, i, 0});
    std::tie(u[i], v[i]) = random_pair(SamplerKind::kIndependent, 10, Dimension::kFilm, 0, i, 0);
  }
  Table<Ray> rays(n);
  Table<PathState> paths(n);
  k.generate_camera_rays[0](scene, samples.view(), u.data(), v.data(), nullptr, nullptr,
                            rays.columns(), paths.columns(), n);
  std::vector<double> seen(B * B), wanted(B * B);
  for (uint32_t i = 0; i < B * B; ++i) wanted[i] = mass[i] / total * n;
  uint32_t wrong_sign = 0, at_a_border = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const Ray<Value> r = rays.row(i);
    const double x = (double(r.dir_x / r.dir_y) + 1) / .01 - 100.5;
    const double y = (.5 - double(r.dir_z / r.dir_y)) / .01 - 50.5;
    const double cx = (x + 2) / 4 * B, cy = (y + 1) / 2 * B;
    const double border = std::min(std::abs(cx - std::round(cx)), std::abs(cy - std::round(cy)));
    const auto cell = [](double c) { return uint32_t(std::clamp(c, 0., double(B - 1))); };
    ++seen[cell(cy) * B + cell(cx)];
    // The place is read back from a direction: only so near to a border is the cell in doubt.
    if (border < 2e-3) {
      ++at_a_border;
      continue;
    }
    wrong_sign += paths.row(i).throughput_g != sign[cell(cy) * B + cell(cx)];
  }
  EXPECT_EQ(wrong_sign, 0u);
  EXPECT_LT(at_a_border, n / 50);
  // Cells without mass may be seen from over the border: give them to the neighbour above.
  for (uint32_t y = 3; y < B; y += 16)
    for (uint32_t x = 0; x < B; ++x) {
      EXPECT_LE(seen[y * B + x], 3);
      seen[y * B + x] = 0;
    }
  EXPECT_GE(chi2_p_value(seen, wanted), .01);
}

// A product filter: offsets are distributed as its quantiles say.
TEST_P(Camera, FilterQuantilesAreSampledExactly) {
  const KernelTable& k = kernels();
  SceneView scene{};
  scene.camera = test_camera();
  scene.filter.kind = FilterKind::kProduct;
  scene.filter.radius_x = 2;
  scene.filter.radius_y = 1;
  AlignedArray<float> qx(kFilterQuantiles + 1), qy(kFilterQuantiles + 1);
  // Density 1 + x/2 over [-1, 1] in x, triangle in y.
  for (uint32_t i = 0; i <= kFilterQuantiles; ++i) {
    const double p = double(i) / kFilterQuantiles;
    qx[i] = float(-2 + std::sqrt(1 + 8 * p));
    qy[i] = float(p < .5 ? -1 + std::sqrt(2 * p) : 1 - std::sqrt(2 * (1 - p)));
  }
  scene.filter.quantile_x = qx.data();
  scene.filter.quantile_y = qy.data();
  constexpr uint32_t n = 1 << 18, B = 32;
  Table<CameraSample> samples(n);
  AlignedArray<float> u(n), v(n);
  for (uint32_t i = 0; i < n; ++i) {
    samples.set(i, {50 << 16 | 100, i, 0});
    std::tie(u[i], v[i]) = random_pair(SamplerKind::kIndependent, 11, Dimension::kFilm, 0, i, 0);
  }
  Table<Ray> rays(n);
  Table<PathState> paths(n);
  k.generate_camera_rays[0](scene, samples.view(), u.data(), v.data(), nullptr, nullptr,
                            rays.columns(), paths.columns(), n);
  std::vector<double> seen(B * B), wanted(B * B);
  const auto below_x = [](double t) { return (t + 1) / 2 + (t * t - 1) / 8 * 1.0; };
  const auto below_y = [](double t) {
    return t < 0 ? (1 + t) * (1 + t) / 2 : 1 - (1 - t) * (1 - t) / 2;
  };
  for (uint32_t y = 0; y < B; ++y)
    for (uint32_t x = 0; x < B; ++x) {
      const double x0 = 2. * x / B - 1, x1 = 2. * (x + 1) / B - 1;
      const double y0 = 2. * y / B - 1, y1 = 2. * (y + 1) / B - 1;
      wanted[y * B + x] = n * (below_x(x1) - below_x(x0)) * (below_y(y1) - below_y(y0));
    }
  for (uint32_t i = 0; i < n; ++i) {
    const Ray<Value> r = rays.row(i);
    const double x = ((double(r.dir_x / r.dir_y) + 1) / .01 - 100.5) / 2;
    const double y = (.5 - double(r.dir_z / r.dir_y)) / .01 - 50.5;
    const auto cell = [](double t) { return uint32_t(std::clamp((t + 1) / 2 * B, 0., B - 1.)); };
    ++seen[cell(y) * B + cell(x)];
    EXPECT_EQ(paths.row(i).throughput_r, 1.f);
  }
  EXPECT_GE(chi2_p_value(seen, wanted), .01);
}

}  // namespace
}  // namespace yat
