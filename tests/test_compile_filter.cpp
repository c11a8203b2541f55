// Pixel filters as tables: they integrate to one, and have the moments of the formulas.

#include <cmath>
#include <functional>

#include "scene/compile_parts.h"
#include "scene_builder.h"

namespace yat {
namespace {

constexpr uint32_t kN = kFilterBins;

class CompileFilter : public SceneTest {
 protected:
  FilterTables make(std::string type, std::vector<Parameter> parameters = {}) {
    return compile_filter(plugin(std::move(type), std::move(parameters)), diagnostics);
  }
};

/// Expected value of weight * f(x, y) over samples drawn from the tables, as the kernels draw them:
/// uniform within a cell (at 4 x 4 midpoints) or between quantiles (at the middle).
double expect(const FilterTables& t, const std::function<double(double, double)>& f) {
  double sum = 0;
  if (t.kind == FilterKind::kProduct) {
    const auto middle = [](const std::vector<float>& q, uint32_t k) {
      return (double(q[k]) + double(q[k + 1])) / 2;
    };
    for (uint32_t j = 0; j < kFilterQuantiles; ++j)
      for (uint32_t i = 0; i < kFilterQuantiles; ++i)
        sum += f(middle(t.quantile_x, i) * double(t.radius_x),
                 middle(t.quantile_y, j) * double(t.radius_y));
    return sum / (double(kFilterQuantiles) * kFilterQuantiles);
  }
  for (uint32_t j = 0; j < kN; ++j) {
    const double row = double(t.marginal[j + 1]) - double(t.marginal[j]);
    for (uint32_t i = 0; i < kN; ++i) {
      const float* c = &t.conditional[j * (kN + 1) + i];
      const double p = row * (double(c[1]) - double(c[0]));
      double mean = 0;
      for (int b = 0; b < 4; ++b)
        for (int a = 0; a < 4; ++a)
          mean += f((2 * (i + (a + .5) / 4) / kN - 1) * double(t.radius_x),
                    (2 * (j + (b + .5) / 4) / kN - 1) * double(t.radius_y)) /
                  16;
      sum += p * double(t.sign[j * kN + i]) * mean;
    }
  }
  return sum;
}

void check_cdf(const float* cdf) {
  EXPECT_EQ(cdf[0], 0);
  EXPECT_EQ(cdf[kN], 1);
  for (uint32_t i = 0; i < kN; ++i) ASSERT_LE(cdf[i], cdf[i + 1]);
}

TEST_F(CompileFilter, AllIntegrateToOneAndAreCentred) {
  for (const char* type :
       {"triangle", "gaussian", "mitchell", "sinc", "blackmanharris", "catmullrom"}) {
    const FilterTables t = make(type);
    SCOPED_TRACE(type);
    ASSERT_NE(t.kind, FilterKind::kBox);
    if (t.kind == FilterKind::kProduct) {
      for (const std::vector<float>* q : {&t.quantile_x, &t.quantile_y}) {
        ASSERT_EQ(q->size(), kFilterQuantiles + 1);
        EXPECT_EQ(q->back(), 1);
        for (uint32_t k = 0; k < kFilterQuantiles; ++k) ASSERT_LT((*q)[k], (*q)[k + 1]);
        EXPECT_NEAR(q->front(), -1, .001);
      }
    } else {
      check_cdf(t.marginal.data());
      for (uint32_t j = 0; j < kN; ++j) check_cdf(&t.conditional[j * (kN + 1)]);
    }
    EXPECT_NEAR(expect(t, [](double, double) { return 1.; }), 1, 1e-5);
    EXPECT_NEAR(expect(t, [](double x, double) { return x; }), 0, 1e-5);
    EXPECT_NEAR(expect(t, [](double, double y) { return y; }), 0, 1e-5);
  }
  EXPECT_SILENT();
}

/// Second moment in x against a fine sum over the formula.
void check_moment(const FilterTables& t, const std::function<double(double, double)>& f) {
  double sum = 0, moment = 0;
  const int n = 1000;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = (2 * (i + .5) / n - 1) * double(t.radius_x),
                   y = (2 * (j + .5) / n - 1) * double(t.radius_y), v = f(x, y);
      sum += v;
      moment += v * x * x;
    }
  moment /= sum;
  // The filter is constant in cells of 2r/64: their own spread adds (2r/64)^2 / 12 to positive
  // ones.
  const double cell = 2 * double(t.radius_x) / kN;
  EXPECT_NEAR(expect(t, [](double x, double) { return x * x; }), moment, cell * cell);
}

TEST_F(CompileFilter, MomentsOfTheFormulas) {
  check_moment(make("triangle", {number("xwidth", 3), number("ywidth", 1)}),
               [](double x, double y) { return (3 - std::abs(x)) * (1 - std::abs(y)); });
  check_moment(make("gaussian", {number("alpha", 1)}), [](double x, double y) {
    return (std::exp(-x * x) - std::exp(-4.)) * (std::exp(-y * y) - std::exp(-4.));
  });
  const auto mitchell = [](double t) {
    const double b = 1. / 3, c = 1. / 3;
    if (t >= 2) return 0.;
    if (t > 1)
      return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t + 8 * b +
              24 * c) /
             6;
    return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + 6 - 2 * b) / 6;
  };
  check_moment(make("mitchell", {number("xwidth", 2), number("ywidth", 3)}),
               [&](double x, double y) { return mitchell(2 * std::hypot(x / 2, y / 3)); });
  check_moment(make("catmullrom"), [](double x, double y) {
    const auto c = [](double t) {
      t = std::abs(t);
      return t < 1 ? 1.5 * t * t * t - 2.5 * t * t + 1 : -.5 * t * t * t + 2.5 * t * t - 4 * t + 2;
    };
    return c(x) * c(y);
  });
}

TEST_F(CompileFilter, SignsAndSupports) {
  const FilterTables bh = make("blackmanharris", {number("xwidth", 2), number("ywidth", 3)});
  EXPECT_EQ(bh.radius_x, 1) << "support is xwidth / 2 on each side";
  EXPECT_EQ(bh.radius_y, 1.5f);
  EXPECT_EQ(bh.kind, FilterKind::kProduct) << "nowhere negative";
  const FilterTables m = make("mitchell");
  EXPECT_EQ(m.radius_x, 2);
  const float inside = m.sign[(kN / 2) * kN + kN / 2];
  EXPECT_GT(inside, 1);
  bool negative = false;
  for (float s : m.sign) {
    negative = negative || s < 0;
    EXPECT_EQ(std::abs(s), inside);
  }
  EXPECT_TRUE(negative);
  EXPECT_FLOAT_EQ(make("mitchell", {text("supersample", "true", ParameterType::kBool)}).radius_x,
                  10.f / 3);
}

TEST_F(CompileFilter, BoxNeedsNoTable) {
  const FilterTables t = make("box", {number("xwidth", 1)});
  EXPECT_EQ(t.kind, FilterKind::kBox);
  EXPECT_EQ(t.radius_x, 1);
  EXPECT_EQ(t.radius_y, .5f);
  EXPECT_TRUE(t.marginal.empty());
}

TEST_F(CompileFilter, Trouble) {
  EXPECT_EQ(make("gausian").radius_x, 2);
  EXPECT_SAID(
      "scene.lxs:10:1: error: unknown filter \"gausian\" (did you mean \"gaussian\"?): "
      "\"mitchell\" "
      "is used");
  EXPECT_EQ(make("gaussian", {number("xwidth", 0)}).radius_x, 2);
  EXPECT_SAID(
      "scene.lxs:11:2: warning: \"xwidth\" of filter \"gaussian\" is 0, but must be above 0: 2 is "
      "used");
  EXPECT_TRUE(make("gaussian", {number("alpha", 0)}).kind == FilterKind::kBox);
  EXPECT_SAID(
      "scene.lxs:10:1: warning: filter \"gaussian\" does not integrate to anything positive: a box "
      "of "
      "its size is used");
  EXPECT_TRUE(compile_filter(std::nullopt, diagnostics).kind == FilterKind::kTable)
      << "mitchell by default";
}

}  // namespace
}  // namespace yat
