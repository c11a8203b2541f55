// Triangle lights by solid angle and by area: uniform in either, right in sum from anywhere, and
// finite where floats end. And lights that share a number with the place on them.

#include <glm/vec2.hpp>

#include "chi2.h"
#include "light_batch.h"

namespace yat {
namespace {

class TriangleLights : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(TriangleLights);

using Vec = glm::dvec3;

Vec corner(const LightRow<Value>& row, int k) {
  const Vec a(row.a_x, row.a_y, row.a_z);
  return k == 0   ? a
         : k == 1 ? a + Vec(row.b_x, row.b_y, row.b_z)
                  : a + Vec(row.c_x, row.c_y, row.c_z);
}

/// Weights of corners 1 and 2 of a point of the triangle's plane.
glm::dvec2 weights_at(const LightRow<Value>& row, const Vec& point) {
  const Vec d = point - corner(row, 0), e1 = corner(row, 1) - corner(row, 0),
            e2 = corner(row, 2) - corner(row, 0), n = glm::cross(e1, e2);
  return {glm::dot(glm::cross(d, e2), n) / glm::dot(n, n),
          glm::dot(glm::cross(e1, d), n) / glm::dot(n, n)};
}

/// Where a direction of the spherical triangle lies in the unit square, uniform directions
/// uniformly: the share of the solid angle on the side of v0 of the great circle through v1, and of
/// 1 - cos along that (Arvo 1995, inverted).
glm::dvec2 place_in_view(const SeenTriangle& seen, const Vec& w) {
  Vec q = glm::normalize(glm::cross(glm::cross(seen.v1, w), glm::cross(seen.v0, seen.v2)));
  if (glm::dot(q, seen.v0 + seen.v2) < 0) q = -q;
  const double volume = glm::dot(seen.v0, glm::cross(q, seen.v1));
  const double opening =
      1 + glm::dot(seen.v0, seen.v1) + glm::dot(seen.v0, q) + glm::dot(seen.v1, q);
  const auto one_minus_cos = [&](const Vec& a) { return glm::dot(a - seen.v1, a - seen.v1) / 2; };
  return {2 * std::atan2(volume, opening) / seen.solid_angle(),
          one_minus_cos(w) / one_minus_cos(q)};
}

// Sizes of a thousandth and a million, slivers, nearly the whole hemisphere, close to an edge.
TEST_P(TriangleLights, NearOnesAreUniformInSolidAngle) {
  struct Case {
    const char* name;
    Vec p0, p1, p2;
  };
  const Case cases[] = {
      {"in front", {1, 0, 2}, {-1, -1, 3}, {0, 1, 2}},
      {"at 1.9 times its size", {1.9, 0, 0}, {1.9, -.5, .7}, {1.9, .8, .6}},
      {"sliver", {-1, 0, 1}, {1, .01, 1}, {1, 0, 1}},
      {"sliver towards the receiver", {.1, 0, .1}, {2, .02, .1}, {2, 0, .1}},
      {"above its middle", {-1, -1, .06}, {-1, 2, .06}, {2, -1, .06}},
      {"above an edge", {-1, 0, .02}, {1, 1, .02}, {1, 0, .02}},
      {"around a corner", {0, 0, .01}, {0, 1, .01}, {1, 0, .01}},
  };
  uint32_t seed = 40;
  int count = 0;
  for (const Case& c : cases)
    for (const double size : {1., 1e-3, 1e6}) {
      LightRow<Value> row = triangle_light(size * c.p0, size * c.p1, size * c.p2);
      const SeenTriangle seen(row, {0, 0, 0});
      ASSERT_TRUE(seen.sampled) << c.name;
      ++count;
      const LightScene scene({row});
      const Batch b = many_samples(kernels(), scene, 0, {0, 0, 0}, seed++);
      SquareHistogram histogram(32);
      double outside = 0;
      for (uint32_t i = 0; i < kMany; ++i) {
        const LightSample<Value> s = b.samples.row(i);
        const glm::dvec2 at = weights_at(row, to_of(s));
        outside = std::max({outside, -at.x, -at.y, at.x + at.y - 1});
        const Vec point = corner(row, 0) + at.x * (corner(row, 1) - corner(row, 0)) +
                          at.y * (corner(row, 2) - corner(row, 0));
        const glm::dvec2 place = place_in_view(seen, glm::normalize(point));
        histogram.add(place.x, place.y);
        if (i % 4096) continue;
        expect_close(double(s.weight_r), seen.solid_angle(), 1e-5, "solid angle", i);
        expect_close(double(s.pdf), 1 / seen.solid_angle(), 1e-5, "pdf", i);
      }
      EXPECT_GE(histogram.p_value(), sidak_level(3 * 21)) << c.name << ", size " << size;
      EXPECT_LE(outside, 2e-5) << c.name << ", size " << size;
    }
  EXPECT_EQ(count, 21);
}

TEST_P(TriangleLights, FarOnesAreUniformInArea) {
  const LightRow<Value> row = triangle_light({1, 0, 20}, {-1, -1, 21}, {0, 1, 20});
  ASSERT_FALSE(SeenTriangle(row, {0, 0, 0}).sampled);
  const LightScene scene({row});
  const Batch b = many_samples(kernels(), scene, 0, {0, 0, 0}, 1);
  SquareHistogram histogram(40);
  for (uint32_t i = 0; i < kMany; ++i) {
    const glm::dvec2 at = weights_at(row, to_of(b.samples.row(i)));
    const double s = at.x + at.y;
    EXPECT_TRUE(at.x >= -1e-5 && at.y >= -1e-5 && s <= 1 + 1e-5);
    histogram.add(s * s, at.y / s);
  }
  EXPECT_GE(histogram.p_value(), sidak_level(3));
}

/// Lambert's formula for a receiver with normal z that has all of the triangle above its horizon.
double irradiance(const LightRow<Value>& row, const Vec& from) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec a = corner(row, k) - from, b = corner(row, (k + 1) % 3) - from, n = glm::cross(a, b);
    sum -= std::atan2(glm::length(n), glm::dot(a, b)) * n.z / glm::length(n);
  }
  return sum / 2;
}

// Whatever rule decides, and on both sides of where it changes: the mean is right.
TEST_P(TriangleLights, IrradianceIsLambertsFromEverywhere) {
  const Vec from(0, 0, 0);
  uint32_t seed = 70;
  for (const double height : {.004, .02, .06, .3, 1., 3.8, 4.2})
    for (const double aside : {0., .3, .99, 1.02, 2.5}) {
      const LightRow<Value> row =
          triangle_light({aside - 1, -1, height}, {aside - 1, 1, height}, {aside + 1, -1, height});
      const double wanted = irradiance(row, from);
      // By area a place just below the light hardly ever meets what shines on it.
      if (!SeenTriangle(row, from).sampled && height < 1) continue;
      const LightScene scene({row});
      const Batch b = many_samples(kernels(), scene, 0, from, seed++);
      const auto [mean, error] = mean_irradiance(b);
      EXPECT_LE(std::abs(mean - wanted), 4 * error + 1e-6 * wanted)
          << "height " << height << ", " << aside << " aside";
      EXPECT_LE(error, 2e-3 * wanted) << "height " << height << ", " << aside << " aside";
    }
}

// In its plane, on it, at its corners, an ulp above it, very near and very far: finite, and one
// over the density where there is any light.
TEST_P(TriangleLights, AnyReceiverGetsFiniteNumbers) {
  const KernelTable& k = kernels();
  Random random(9);
  for (const double size : {1e-12, 1e-3, 1., 1e6, 1e9})
    for (const double slender : {1., 1e-3, 1e-7}) {
      const LightRow<Value> row =
          triangle_light({0, 0, 0}, {size, 0, 0}, {size / 3, size * slender, 0});
      const LightScene scene({row});
      std::vector<Vec> places = {{0, 0, 0},
                                 {size, 0, 0},
                                 {size / 2, 0, 0},
                                 {size / 2, size * slender / 4, 0},
                                 {-size, 0, 0},
                                 {size / 2, 0, size * 1e-7},
                                 {0, 0, size * 1e-6},
                                 {size / 2, size * slender / 4, size * 1e-6},
                                 {size / 2, size * slender / 4, size * 1e-30},
                                 {size / 2, -size, size * 1e-7},
                                 {0, 0, 1e6 * size},
                                 {1e6 * size, 0, size},
                                 {size / 2, 0, -size}};
      Batch b = batch_at(places, size, random);
      b.run(k, scene.view, 0);
      SCOPED_TRACE(::testing::Message() << "size " << size << ", slender " << slender);
      for (uint32_t i = 0; i < b.n; ++i) {
        const LightSample<Value> s = b.samples.row(i);
        const Vec p = b.pos(i);
        if (!expect_numbers(b, i, p.z < 0 || (p.z == 0 && p.y == 0))) continue;
        const SeenTriangle seen(row, p);
        if (!seen.sampled || std::abs(seen.volume + seen.opening / 32 - 1. / 64) < 1e-3) continue;
        expect_close(double(s.weight_r), seen.solid_angle(), 1e-3, "solid angle", i);
        const glm::dvec2 at = weights_at(row, to_of(s));
        EXPECT_TRUE(std::min(at.x, at.y) > -1e-4 && at.x + at.y < 1 + 1e-4) << i;
      }
    }
}

// u spreads evenly over all lights: light k gets its share of the interval, stretched.
TEST_P(TriangleLights, OneNumberChoosesLightAndPlace) {
  std::vector<LightRow<Value>> lights;
  const double share[] = {.5, .125, .375};
  for (int k = 0; k < 3; ++k) {
    const double x = 10 * k;
    lights.push_back(triangle_light({x, 0, 90}, {x, 1, 90}, {x + 1, 0, 90}));
    lights.back().probability = float(share[k]);
  }
  // Intervals of a third: light 0; light 1 up to 3/8 of it, then light 2; light 2 up to 1/2, then
  // 0.
  const LightScene scene(lights, {{1, 0}, {.375f, 2}, {.5f, 0}});
  constexpr uint32_t n = 48000;
  Batch b(n);
  for (uint32_t i = 0; i < n; ++i)
    b.set(i, {0, 0, 0}, (float(i) + .5f) / float(n), float(i % 97) / 97, std::nanf(""));
  b.run_by_place(kernels(), scene.view, 0);
  EXPECT_TRUE(b.samples.untouched());
  uint32_t seen[3] = {};
  for (uint32_t i = 0; i < n; ++i) {
    const double place = (i + .5) / n * 3, rest = place - std::floor(place);
    const int interval = int(place);
    const double below = interval == 0 ? 1 : interval == 1 ? .375 : .5;
    const int light = rest < below ? interval : interval == 1 ? 2 : 0;
    const double u = rest < below ? rest / below : (rest - below) / (1 - below);
    const double v = (i % 97) / 97.;
    const LightSample<Value> s = b.samples.row(i);
    const glm::dvec2 at = weights_at(lights[size_t(light)], to_of(s));
    ++seen[light];
    EXPECT_NEAR(at.x, v > u ? u / 2 : u - v / 2, 2e-5) << i;
    EXPECT_NEAR(at.y, v > u ? v - u / 2 : v / 2, 2e-5) << i;
  }
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], share[k] * n, 2);
}

}  // namespace
}  // namespace yat
