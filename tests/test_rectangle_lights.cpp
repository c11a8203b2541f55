// Rectangle lights by solid angle and by area: uniform in either, where the published formulas put
// them, right in sum from anywhere, and finite where floats end.

#include <glm/vec2.hpp>

#include "chi2.h"
#include "light_batch.h"
#include "wavefront/reference_rectangle.h"

namespace yat {
namespace {

class RectangleLights : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(RectangleLights);

using Vec = glm::dvec3;
constexpr uint32_t kKernel = uint32_t(LightKind::kRectangle);

/// Shares of b and c of a point.
glm::dvec2 shares_at(const LightRow<Value>& row, const Vec& point) {
  const Vec d = point - corner_of(row), b(row.b_x, row.b_y, row.b_z), c(row.c_x, row.c_y, row.c_z);
  return {glm::dot(d, b) / glm::dot(b, b), glm::dot(d, c) / glm::dot(c, c)};
}

/// Where shares of b and c lie in the unit square, uniform directions uniformly: the share of the
/// solid angle below the line at x, and that of the sine along it.
glm::dvec2 place_in_view(const LightRow<Value>& row, const Vec& from, const glm::dvec2& shares) {
  LightRow<Value> part = row;
  put(shares.x * Vec(row.b_x, row.b_y, row.b_z), part.b_x, part.b_y, part.b_z);
  const Vec b(row.b_x, row.b_y, row.b_z), c(row.c_x, row.c_y, row.c_z);
  const Vec low = corner_of(row) + shares.x * b - from, high = low + c;
  const auto sine = [&](const Vec& w) { return glm::dot(w, c) / glm::length(w) / glm::length(c); };
  return {SeenRectangle(part, from).solid_angle / SeenRectangle(row, from).solid_angle,
          (sine(low + shares.y * c) - sine(low)) / (sine(high) - sine(low))};
}

struct Case {
  const char* name;
  Vec corner, b, c;
};
/// Seen from the origin.
std::vector<Case> near_cases() {
  return {{"in front", {-.4, -.3, .5}, {0, .7, 0}, {.9, 0, 0}},
          {"aslant", {.5, .2, .3}, {-.2, .3, -.1}, {.8, .6, .2}},
          {"at 1.9 times its size", {-.5, .8, 1.4}, {0, 1, 0}, {1, 0, 0}},
          {"tube", {-.5, .2, .3}, {0, .02, 0}, {1, 0, 0}},
          {"tube towards the receiver", {.1, -.01, .1}, {0, .02, 0}, {1, 0, 0}},
          {"above its middle", {-.5, -.5, .03}, {0, 1, 0}, {1, 0, 0}},
          {"above its longer edge", {-.5, 0, .02}, {0, .5, 0}, {1, 0, 0}},
          {"above its shorter edge", {0, -.3, .02}, {0, .5, 0}, {1, 0, 0}},
          {"above a corner", {0, 0, .02}, {0, 1, 0}, {1, 0, 0}},
          {"beside it, low", {1.2, .7, .02}, {0, .5, 0}, {1, 0, 0}}};
}

TEST_P(RectangleLights, NearOnesAreUniformInSolidAngle) {
  uint32_t seed = 400;
  int count = 0;
  for (const Case& c : near_cases())
    for (const double size : {1., 1e-3, 1e6}) {
      if (size != 1 && ++count > 6) continue;
      const LightRow<Value> row = rectangle_light(size * c.corner, size * c.b, size * c.c);
      const SeenRectangle seen(row, {0, 0, 0});
      ASSERT_TRUE(seen.sampled) << c.name;
      const LightScene scene({row});
      const Batch b = many_samples(kernels(), scene, kKernel, {0, 0, 0}, seed++);
      SquareHistogram histogram(32);
      double outside = 0;
      for (uint32_t i = 0; i < kMany; i += 4) {
        const LightSample<Value> s = b.samples.row(i);
        const glm::dvec2 at = shares_at(row, to_of(s));
        outside = std::max({outside, -at.x, -at.y, at.x - 1, at.y - 1});
        const glm::dvec2 place = place_in_view(row, {0, 0, 0}, at);
        histogram.add(place.x, place.y);
        if (i % 4096) continue;
        expect_close(double(s.weight_r), seen.solid_angle, 1e-5, c.name, i);
        expect_close(double(s.pdf), 1 / seen.solid_angle, 1e-5, c.name, i);
      }
      EXPECT_GE(histogram.p_value(), sidak_level(3 * 16)) << c.name << ", size " << size;
      EXPECT_LE(outside, 2e-5 / (c.name[0] == 't' ? .02 : 1)) << c.name << ", size " << size;
    }
}

// Number by number where Urena, Fajardo and King (2013) put them, in double precision.
TEST_P(RectangleLights, NearOnesAreWhereThePublishedFormulasPutThem) {
  Random random(41);
  const std::vector<Case> cases = near_cases();
  Batch b(1024);
  for (const Case& c : cases) {
    const LightRow<Value> row = rectangle_light(c.corner, c.b, c.c);
    const LightScene scene({row});
    for (uint32_t i = 0; i < b.n; ++i) b.set(i, {0, 0, 0}, random.unit(), random.unit(), 0);
    b.run(kernels(), scene.view, kKernel);
    const reference::SphericalRectangle seen(row, {0, 0, 0});
    ASSERT_TRUE(seen.sampled);
    for (uint32_t i = 0; i < b.n; ++i) {
      const Randoms<Value> r = b.randoms.row(i);
      const LightSample<Value> s = b.samples.row(i);
      const Vec point = seen.point(double(r.light_u), double(r.light_v));
      expect_near(to_of(s), point, 2e-5, c.name, i);
      expect_near(wi_of(s), glm::normalize(point), 2e-5 / glm::length(point), c.name, i);
    }
  }
}

TEST_P(RectangleLights, FarOnesAreUniformInArea) {
  const LightRow<Value> row = rectangle_light({-1, -.5, 20}, {0, 1, 0}, {2, 0, 0});
  ASSERT_FALSE(SeenRectangle(row, {0, 0, 0}).sampled);
  const LightScene scene({row});
  const Batch b = many_samples(kernels(), scene, kKernel, {0, 0, 0}, 1);
  SquareHistogram histogram(40);
  for (uint32_t i = 0; i < kMany; ++i) {
    const glm::dvec2 at = shares_at(row, to_of(b.samples.row(i)));
    EXPECT_TRUE(std::min(at.x, at.y) >= -1e-5 && std::max(at.x, at.y) <= 1 + 1e-5);
    histogram.add(at.x, at.y);
  }
  EXPECT_GE(histogram.p_value(), sidak_level(3));
}

/// Lambert's formula for a receiver with normal z that has all of the rectangle above its horizon.
double irradiance(const LightRow<Value>& row, const Vec& from) {
  const Vec b(row.b_x, row.b_y, row.b_z), c(row.c_x, row.c_y, row.c_z), a = corner_of(row) - from;
  const Vec corners[] = {a, a + b, a + b + c, a + c};
  double sum = 0;
  for (size_t k = 0; k < 4; ++k) {
    const Vec n = glm::cross(corners[k], corners[(k + 1) % 4]);
    sum -= std::atan2(glm::length(n), glm::dot(corners[k], corners[(k + 1) % 4])) * n.z /
           glm::length(n);
  }
  return sum / 2;
}

// Whatever rule decides, and on both sides of where it changes: the mean is right.
TEST_P(RectangleLights, IrradianceIsLambertsFromEverywhere) {
  const Vec from(0, 0, 0);
  uint32_t seed = 700;
  int tried = 0;
  for (const double height : {.004, .0157, .06, 1., 1.9, 2.1})
    for (const double aside : {0., .49, .51, 1.4})
      for (const double width : {1., .1}) {
        const LightRow<Value> row =
            rectangle_light({aside - .5, aside / 3 - width / 2, height}, {0, width, 0}, {1, 0, 0});
        // By area a place just below the light hardly ever meets what shines on it.
        if (!SeenRectangle(row, from).sampled && height < 1) continue;
        ++tried;
        const double wanted = irradiance(row, from);
        const LightScene scene({row});
        const Batch b = many_samples(kernels(), scene, kKernel, from, seed++);
        const auto [mean, error] = mean_irradiance(b);
        EXPECT_LE(std::abs(mean - wanted), 4 * error + 2e-6 * wanted)
            << "height " << height << ", " << aside << " aside, width " << width;
        EXPECT_LE(error, 3e-3 * wanted) << "height " << height << ", " << aside << " aside";
      }
  EXPECT_EQ(tried, 40);
}

// In its plane, on it, at its corners, an ulp above it, very near and very far: finite, and one
// over the density where there is any light.
TEST_P(RectangleLights, AnyReceiverGetsFiniteNumbers) {
  Random random(90);
  uint32_t by_angle = 0;
  for (const double size : {1e-12, 1e-3, 1., 1e6, 1e9})
    for (const double slender : {1., 1e-3, 1e-7}) {
      const double width = slender * size;
      const LightRow<Value> row = rectangle_light({0, 0, 0}, {0, -width, 0}, {size, 0, 0});
      const LightScene scene({row});
      std::vector<Vec> places = {{0, 0, 0},
                                 {size, 0, 0},
                                 {size / 2, 0, 0},
                                 {size / 2, -width / 4, 0},
                                 {-size, 0, 0},
                                 {size / 2, 0, size * 1e-7},
                                 {0, 0, size * 1e-6},
                                 {0, 0, size / 64},
                                 {size / 2, -width / 2, size / 63},
                                 {size / 2, -width / 4, size * 1e-30},
                                 {size / 2, size, size * 1e-7},
                                 {0, 0, 1e6 * size},
                                 {1e6 * size, 0, size},
                                 {size / 2, 0, -size}};
      Batch b = batch_at(places, size, random);
      b.run(kernels(), scene.view, kKernel);
      SCOPED_TRACE(::testing::Message() << "size " << size << ", slender " << slender);
      for (uint32_t i = 0; i < b.n; ++i) {
        const LightSample<Value> s = b.samples.row(i);
        const Vec p = b.pos(i);
        if (!expect_numbers(b, i, p.z < 0)) continue;
        const SeenRectangle seen(row, p);
        if (!seen.sampled || std::abs(p.z * 64 / size - 1) < 1e-5) continue;
        ++by_angle;
        expect_close(double(s.weight_r), seen.solid_angle, 3e-4, "solid angle", i);
        const glm::dvec2 at = shares_at(row, to_of(s));
        EXPECT_TRUE(at.y > -1e-5 && at.y < 1 + 1e-5) << i;
        EXPECT_TRUE(std::abs(at.x - .5) < .5 + 1e-5 / slender) << i;
      }
    }
  EXPECT_GT(by_angle, 500u);
}

}  // namespace
}  // namespace yat
