// Warps of kernels/sampling.h and the functions of kernels/math.h, built here for one instruction
// set. Each warp is tested against a parametrisation of its own that maps its target uniformly onto
// the unit square.

#include <gtest/gtest.h>

#include <random>

#include "chi2.h"
#include "kernels/sampling.h"

namespace yat::YAT_ISA {
namespace {

using A = NativeArch;
constexpr int kSamples = 1 << 20;
constexpr double kTau = 6.283185307179586;

float lane0(const Float<A>& v) {
  return v.get(0);
}

struct Numbers {
  std::mt19937 engine{11};
  float operator()() { return float(engine() >> 8) * 0x1p-24f; }
};

double turn_of(double x, double y) {
  const double t = std::atan2(y, x) / kTau;
  return t < 0 ? t + 1 : t;
}

TEST(Math, SinCosAndAngles) {
  double worst = 0, worst_back = 0;
  for (int i = 0; i <= 100000; ++i) {
    const float t = float(i) / 100000;
    const SinCos<A> sc = sin_cos_turns<A>(Float<A>(t));
    worst = std::max({worst, std::abs(double(lane0(sc.sin)) - std::sin(kTau * double(t))),
                      std::abs(double(lane0(sc.cos)) - std::cos(kTau * double(t)))});
    const double back = double(lane0(angle_in_turns<A>(sc.cos, sc.sin)));
    const double off = std::abs(back - double(t));
    worst_back = std::max(worst_back, std::min(off, 1 - off));
    EXPECT_TRUE(back >= 0 && back < 1);
  }
  EXPECT_LE(worst, 1.5e-7);
  EXPECT_LE(worst_back, 1e-7);
  EXPECT_EQ(lane0(angle_in_turns<A>(Float<A>(0.f), Float<A>(0.f))), 0.f);
}

TEST(Math, PowerHeuristicAtItsExtremes) {
  const auto weight = [](float own, float other) {
    return lane0(power_heuristic<A>(Float<A>(own), Float<A>(other)));
  };
  EXPECT_EQ(weight(1, 0), 1.f);
  EXPECT_EQ(weight(1, 1), .5f);
  EXPECT_EQ(weight(1e20f, 1e20f), .5f);
  EXPECT_EQ(weight(3e38f, 1), 1.f);
  EXPECT_EQ(weight(1e-30f, 1e30f), 0.f);
  EXPECT_FLOAT_EQ(weight(3, 4), 9.f / 25.f);
  EXPECT_FLOAT_EQ(weight(3, 4) + weight(4, 3), 1.f);
}

TEST(Frame, IsOrthonormalForEveryNormal) {
  Numbers u;
  for (int i = 0; i < 20000; ++i) {
    Vec3<A> n = square_to_sphere<A>(Float<A>(u()), Float<A>(u()));
    if (i == 0) n = {Float<A>(0.f), Float<A>(0.f), Float<A>(-1.f)};
    if (i == 1) n = {Float<A>(0.f), Float<A>(0.f), Float<A>(1.f)};
    if (i == 2) n = {Float<A>(1e-8f), Float<A>(-1e-8f), Float<A>(-1.f)};
    if (i == 3) n = {Float<A>(1.f), Float<A>(0.f), Float<A>(-0.f)};
    const Frame<A> f = Frame<A>::about(n);
    for (const auto& [a, b, want] :
         {std::tuple{f.x, f.x, 1.}, {f.y, f.y, 1.}, {f.x, f.y, 0.}, {f.x, n, 0.}, {f.y, n, 0.}})
      EXPECT_NEAR(double(lane0(dot(a, b))), want, 1e-6);
    EXPECT_NEAR(double(lane0(dot(cross(f.x, f.y), n))), 1, 1e-6);
  }
}

/// Runs a warp over independent numbers and checks: points where they must be, uniform under
/// `square_of`, and inverted by `invert` up to rounding (`tolerance`, in the square).
template <class Sample, class SquareOf, class Invert>
void check_warp(Sample sample, SquareOf square_of, Invert invert, double tolerance) {
  Numbers u;
  SquareHistogram histogram(50);
  double worst = 0;
  for (int i = 0; i < kSamples; ++i) {
    const float a = u(), b = u();
    const auto point = sample(Float<A>(a), Float<A>(b));
    const auto [s, t] = square_of(point);
    histogram.add(s, t);
    if (i % 16) continue;
    const Point2<A> back = invert(point);
    const double dx = std::abs(double(lane0(back.x)) - double(a));
    const double dy = std::abs(double(lane0(back.y)) - double(b));
    worst = std::max({worst, dx, std::min(dy, 1 - dy)});
  }
  EXPECT_GE(histogram.p_value(), sidak_level(6));
  EXPECT_LE(worst, tolerance);
}

TEST(Warps, Disc) {
  check_warp(
      square_to_disc<A>,
      [](const Point2<A>& p) {
        const double x = double(lane0(p.x)), y = double(lane0(p.y));
        EXPECT_LE(x * x + y * y, 1 + 1e-6);
        return std::pair(x * x + y * y, turn_of(x, y));
      },
      disc_to_square<A>, 1e-6);
}
TEST(Warps, CosineHemisphere) {
  check_warp(
      square_to_cosine_hemisphere<A>,
      [](const Vec3<A>& w) {
        EXPECT_GE(lane0(w.z), 0.f);
        EXPECT_NEAR(double(lane0(dot(w, w))), 1, 1e-6);
        const double z = double(lane0(w.z));
        return std::pair(1 - z * z, turn_of(double(lane0(w.x)), double(lane0(w.y))));
      },
      cosine_hemisphere_to_square<A>, 1e-6);
}
TEST(Warps, Triangle) {
  // The square root map of Turk 1990 is another uniform parametrisation.
  check_warp(
      square_to_triangle<A>,
      [](const Point2<A>& b) {
        const double b1 = double(lane0(b.x)), b2 = double(lane0(b.y)), s = b1 + b2;
        EXPECT_TRUE(b1 >= 0 && b2 >= 0 && s <= 1 + 1e-7);
        return std::pair(s * s, s > 0 ? b2 / s : 0);
      },
      triangle_to_square<A>, 1e-6);
}
TEST(Warps, ConesWideAndNarrow) {
  for (const float measure : {2.f, .3f, 1e-7f}) {
    const Float<A> m(measure);
    const auto sample = [m](const Float<A>& u, const Float<A>& v) {
      return square_to_cone<A>(m, u, v);
    };
    const auto invert = [m](const Vec3<A>& w) { return cone_to_square<A>(m, w); };
    check_warp(
        sample,
        [measure](const Vec3<A>& w) {
          const double x = double(lane0(w.x)), y = double(lane0(w.y)), z = double(lane0(w.z));
          const double s2 = x * x + y * y;
          const double one_minus = z > .9 ? s2 / (1 + std::sqrt(1 - std::min(s2, 1.))) : 1 - z;
          EXPECT_NEAR(x * x + y * y + z * z, 1, 2e-6);
          return std::pair(one_minus / double(measure), turn_of(x, y));
        },
        invert, 1e-5);
    EXPECT_FLOAT_EQ(lane0(cone_pdf<A>(m)), float(1 / (kTau * double(measure))));
  }
}
TEST(Warps, SphereIsTheWidestCone) {
  check_warp(
      square_to_sphere<A>,
      [](const Vec3<A>& w) {
        return std::pair(.5 - .5 * double(lane0(w.z)),
                         turn_of(double(lane0(w.x)), double(lane0(w.y))));
      },
      sphere_to_square<A>, 1e-5);
}

TEST(Warps, CornersOfTheSquareAreFinite) {
  for (const float u : {0.f, .5f, 1 - 0x1p-24f})
    for (const float v : {0.f, .5f, 1 - 0x1p-24f}) {
      const Vec3<A> h = square_to_cosine_hemisphere<A>(Float<A>(u), Float<A>(v));
      const Vec3<A> c = square_to_cone<A>(Float<A>(1e-6f), Float<A>(u), Float<A>(v));
      EXPECT_NEAR(double(lane0(dot(h, h))), 1, 1e-6);
      EXPECT_GE(lane0(h.z), 0.f);
      EXPECT_NEAR(double(lane0(dot(c, c))), 1, 1e-6);
    }
}

TEST(Cone, MeasureKeepsItsAccuracy) {
  for (const double sine : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
    const double exact = sine * sine / (1 + std::sqrt(1 - sine * sine));
    EXPECT_NEAR(double(lane0(one_minus_cos<A>(Float<A>(float(sine * sine))))) / exact, 1, 2e-7);
  }
}

}  // namespace
}  // namespace yat::YAT_ISA
