// Light sampling and emission: each kind against double precision, distributions, closed forms, and
// the two densities of multiple importance sampling against each other.

#include <cmath>

#include "chi2.h"
#include "light_batch.h"

namespace yat {
namespace {

constexpr double kPi = 3.141592653589793;

class Lights : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Lights);

/// What a light sample must be, given the point of the light that it went to.
struct Expected {
  double pdf, weight;
};
Expected expected_at(const LightRow<Value>& row, const glm::dvec3& p, const glm::dvec3& point,
                     const glm::dvec3& normal) {
  const double d2 = glm::dot(point - p, point - p);
  const double cos = -glm::dot(normal, glm::normalize(point - p));
  const double r = double(row.extra);
  const glm::dvec3 a(row.a_x, row.a_y, row.a_z);
  switch (LightKind(row.kind)) {
    case LightKind::kTriangle:
      if (const SeenTriangle seen(row, p); seen.sampled)
        return {1 / seen.solid_angle(), seen.solid_angle()};
      return cos > 0 ? Expected{d2 / (cos * r), cos * r / d2} : Expected{0, 0};
    case LightKind::kRectangle:
      if (const SeenRectangle seen(row, p); seen.sampled)
        return {1 / seen.solid_angle, seen.solid_angle};
      return cos > 0 ? Expected{d2 / (cos * r), cos * r / d2} : Expected{0, 0};
    case LightKind::kSphere: {
      const double far2 = glm::dot(a - p, a - p);
      if (row.b_x != 0 ? !(cos > 0) : far2 <= r * r) return {0, 0};
      if (row.b_x == 0) {
        const double s2 = r * r / far2, measure = s2 / (1 + std::sqrt(1 - s2)) * 2 * kPi;
        return {1 / measure, measure};
      }
      return {d2 / (cos * 4 * kPi * r * r), cos * 4 * kPi * r * r / d2};
    }
    case LightKind::kPoint:
      return {0, 1 / d2};
    default:
      return {0, row.extra < 1 ? 2 * kPi * (1 - r) : 1};
  }
}

bool is_flat(const LightRow<Value>& row) {
  return row.kind == uint32_t(LightKind::kTriangle) || row.kind == uint32_t(LightKind::kRectangle);
}

LightRow<Value> random_rectangle(Random& random) {
  const glm::dvec3 b = random.point(2), c = glm::cross(b, random.direction());
  const double longer = 1 + double(random.unit());
  return rectangle_light(random.point(5), b, longer * glm::length(b) / glm::length(c) * c);
}

TEST_P(Lights, EveryKindIsWhatDoublePrecisionSaysAtEveryCount) {
  const KernelTable& k = kernels();
  Random random(1);
  const auto make = [&](LightKind kind) {
    switch (kind) {
      case LightKind::kRectangle:
        return random_rectangle(random);
      case LightKind::kTriangle:
        return triangle_light(random.point(5), random.point(5), random.point(5));
      case LightKind::kSphere:
        return sphere_light(random.point(5), double(random.in(.1f, 4)), random.below(2));
      case LightKind::kPoint:
        return far_light(kind, random.point(5));
      default:
        return far_light(kind, random.direction(), random.below(2) ? 1. : .9);
    }
  };
  // Scenes of one light, of one kind, and of all kinds.
  for (uint32_t kind = 0; kind <= kPlainLights; ++kind)
    for (const uint32_t count : {1u, 5u}) {
      std::vector<LightRow<Value>> lights;
      for (uint32_t i = 0; i < count; ++i)
        lights.push_back(
            make(LightKind(kind < kPlainLights ? kind : (i + count) % kPlainLightKinds)));
      const LightScene scene(lights);
      for (const uint32_t n : tail_counts(k.lanes)) {
        Batch b(n);
        for (uint32_t i = 0; i < n; ++i)
          b.set(i, rounded(random.point(5)), random.unit(), random.unit(), random.unit());
        b.run(k, scene.view, kind);
        EXPECT_TRUE(b.samples.untouched());
        if (kind < kPlainLights) {  // the mixture kernel gives the same bits
          Batch m(n);
          for (uint32_t i = 0; i < n; ++i) {
            m.surfaces.set(i, b.surfaces.row(i));
            m.randoms.set(i, b.randoms.row(i));
          }
          m.run(k, scene.view, kPlainLights);
          for (uint32_t i = 0; i < n; ++i) {
            EXPECT_EQ(m.samples.row(i).pdf, b.samples.row(i).pdf);
            EXPECT_EQ(m.samples.row(i).weight_g, b.samples.row(i).weight_g);
            if (b.samples.row(i).weight_g > 0) {
              EXPECT_EQ(to_of(m.samples.row(i)), to_of(b.samples.row(i)));
            }
          }
        }
        for (uint32_t i = 0; i < n; ++i) {
          const auto chosen = uint32_t(double(b.randoms.row(i).light_choice) * count);
          const LightRow<Value>& row = lights[chosen];
          const LightSample<Value> s = b.samples.row(i);
          const glm::dvec3 p = b.pos(i), to = to_of(s), a(row.a_x, row.a_y, row.a_z);
          glm::dvec3 normal(0), point = to;
          if (is_flat(row)) {
            const glm::dvec3 e1(row.b_x, row.b_y, row.b_z), e2(row.c_x, row.c_y, row.c_z);
            normal = glm::normalize(glm::cross(e1, e2));
            const double above = glm::dot(to - a, normal);
            EXPECT_GT(above, 0) << "off the light";
            EXPECT_LT(above, 1e-4);
            point -= above * normal;
          } else if (row.kind == uint32_t(LightKind::kSphere) && s.weight_r > 0) {
            normal = glm::normalize(to - a) * (row.b_x != 0 ? -1. : 1.);
            point = a + glm::normalize(to - a) * double(row.extra);
            EXPECT_GT(glm::dot(to - point, normal), 0) << "off the light";
            EXPECT_LT(glm::length(to - point), 1e-4);
          }
          const Expected e = expected_at(row, p, point, normal);
          const double share = 1. / count;
          if (e.weight == 0 || e.weight > 1e4) {
            if (e.weight == 0) {
              EXPECT_EQ(s.weight_r, 0.f);
            }
            continue;
          }
          // The point is known to about 1e-6 of its coordinates; the rest is conditioning.
          const double slack = 2e-4 * (1 + 1 / std::sqrt(e.weight));
          expect_close(double(s.weight_r), e.weight / share, slack, "weight", i);
          expect_close(double(s.weight_b), 2 * e.weight / share, slack, "weight", i);
          expect_close(double(s.pdf), e.pdf * share, slack, "pdf", i);
          if (row.kind != uint32_t(LightKind::kDistant)) {
            // wi is exact; the end point has a few roundings of the coordinates.
            const double near = glm::length(point - p);
            expect_near(wi_of(s), (point - p) / near, 2e-6 + 2e-5 / near, "wi", i);
          } else {
            EXPECT_GE(glm::dot(wi_of(s), a), double(row.extra) - 1e-6);
            EXPECT_GT(glm::length(to - p), 1e4 * double(scene.view.radius));
            expect_near(glm::normalize(to - p), wi_of(s), 1e-6, "end of a distant ray", i);
          }
        }
      }
    }
}

// ---- Distributions ---------------------------------------------------------------------------

TEST_P(Lights, SphereConeIsUniformInSolidAngleNearAndFar) {
  for (const double distance : {1.001, 1.5, 10., 1e4}) {
    const glm::dvec3 center = glm::normalize(glm::dvec3(1, 2, -2)) * distance;
    const LightScene scene({sphere_light(rounded(center), 1)});
    const Batch b = many_samples(kernels(), scene, 1, {0, 0, 0}, 2);
    const glm::dvec3 z = glm::normalize(rounded(center));
    const glm::dvec3 x = glm::normalize(glm::cross(z, {0, 0, 1})), y = glm::cross(z, x);
    const double s2 = 1 / glm::dot(rounded(center), rounded(center));
    const double measure = s2 / (1 + std::sqrt(1 - s2));
    SquareHistogram histogram(40);
    double worst = 0;
    for (uint32_t i = 0; i < kMany; ++i) {
      const LightSample<Value> s = b.samples.row(i);
      const glm::dvec3 w = wi_of(s);
      const double lx = glm::dot(w, x), ly = glm::dot(w, y), lz = glm::dot(w, z);
      const double sin2 = lx * lx + ly * ly;
      const double one_minus = lz > .5 ? sin2 / (1 + std::sqrt(1 - sin2)) : 1 - lz;
      double turn = std::atan2(ly, lx) / (2 * kPi);
      if (turn < 0) turn += 1;
      // The outermost cell takes what rounding puts over the rim.
      histogram.add(one_minus / measure, turn);
      worst = std::max(worst, std::abs(glm::length(to_of(s) - rounded(center)) - 1));
    }
    EXPECT_GE(histogram.p_value(), sidak_level(3 * 4)) << "distance " << distance;
    EXPECT_LE(worst, 1e-5 * std::max(distance, 1.)) << "points lie on the sphere";
  }
}

TEST_P(Lights, DistantDiscIsUniform) {
  const glm::dvec3 axis = rounded(glm::normalize(glm::dvec3(-1, 2, 2)));
  const LightScene scene({far_light(LightKind::kDistant, axis, .99)});
  const Batch b = many_samples(kernels(), scene, 3, {1, 1, 1}, 3);
  const glm::dvec3 x = glm::normalize(glm::cross(axis, {0, 0, 1})), y = glm::cross(axis, x);
  SquareHistogram histogram(40);
  for (uint32_t i = 0; i < kMany; ++i) {
    const glm::dvec3 w = wi_of(b.samples.row(i));
    double turn = std::atan2(glm::dot(w, y), glm::dot(w, x)) / (2 * kPi);
    if (turn < 0) turn += 1;
    const double sin2 = std::pow(glm::dot(w, x), 2) + std::pow(glm::dot(w, y), 2);
    histogram.add(sin2 / (1 + std::sqrt(1 - sin2)) / (1 - double(.99f)), turn);
    EXPECT_EQ(b.samples.row(i).pdf, 0.f);
  }
  EXPECT_GE(histogram.p_value(), sidak_level(3));
}

TEST_P(Lights, ChoiceFollowsTheAliasTable) {
  // Probabilities 1/2, 1/4, 1/4, 0 as an alias table.
  std::vector<LightRow<Value>> lights;
  const double wanted[] = {.5, .25, .25, 0};
  for (int i = 0; i < 4; ++i) {
    LightRow<Value> row = far_light(LightKind::kPoint, {i + 1., 0, 0});
    row.probability = float(wanted[i]);
    lights.push_back(row);
  }
  const LightScene scene(lights, {{1, 0}, {1, 1}, {1, 2}, {0, 0}});
  const Batch b = many_samples(kernels(), scene, 2, {0, 0, 0}, 4);
  std::vector<double> seen(4), expected(4);
  for (uint32_t i = 0; i < kMany; ++i) {
    const LightSample<Value> s = b.samples.row(i);
    const auto light = size_t(std::lround(s.to_x)) - 1;
    ++seen[light];
    EXPECT_FLOAT_EQ(s.weight_r * s.to_x * s.to_x, float(1 / wanted[light]));
  }
  for (int i = 0; i < 4; ++i) expected[size_t(i)] = wanted[i] * kMany;
  EXPECT_GE(chi2_p_value(seen, expected), .01);
}

// ---- Closed forms ----------------------------------------------------------------------------

struct ClosedForm {
  const char* name;
  std::vector<LightRow<Value>> lights;
  uint32_t kind;
  double irradiance;
};

std::vector<LightRow<Value>> square_light(double x, double y) {
  // 1 x 1 at z = 1, its lower corner at (x, y), facing down.
  const glm::dvec3 a(x, y, 1), b(x + 1, y, 1), c(x + 1, y + 1, 1), d(x, y + 1, 1);
  return {triangle_light(a, c, b), triangle_light(a, d, c)};
}

// Irradiance on z = 0 at the origin: mean of cos * weight, within 3 standard errors.
TEST_P(Lights, IrradianceOfKnownShapes) {
  const ClosedForm forms[] = {
      {"triangle", {triangle_light({1, 0, 2}, {-1, -1, 3}, {0, 1, 2})}, 0, .258953915},
      {"square above its centre", square_light(-.5, -.5), 0, .752274688},
      {"square above its corner", square_light(0, 0), 0, .435209876},
      {"rectangle", {rectangle_light({0, 0, 1}, {0, 1, 0}, {1, 0, 0})}, 4, .435209876},
      {"sphere", {sphere_light({0, 0, 3}, 1)}, 1, .349065850},
      {"sphere and square",
       {square_light(0, 0)[0], square_light(0, 0)[1], sphere_light({0, 0, 3}, 1)},
       kPlainLights,
       .435209876 + .349065850},
      {"room inside a sphere", {sphere_light({0, 0, .5}, 2, true)}, 1, kPi}};
  uint32_t seed = 20;
  for (const ClosedForm& form : forms) {
    const LightScene scene(form.lights);
    const Batch b = many_samples(kernels(), scene, form.kind, {0, 0, 0}, seed++);
    const auto [mean, error] = mean_irradiance(b);
    EXPECT_LE(std::abs(mean - form.irradiance), 3 * error + 1e-7 * form.irradiance) << form.name;
    EXPECT_LE(error, 1e-2 * form.irradiance) << form.name;
  }
}

// ---- Emission --------------------------------------------------------------------------------

// A path that hits the point which light sampling chose must give the two techniques weights that
// add up to 1: the reverse density is the forward one.
TEST_P(Lights, EmissionWeighsAgainstTheSamplersDensity) {
  const KernelTable& k = kernels();
  Random random(6);
  std::vector<LightRow<Value>> lights;
  for (int i = 0; i < 4; ++i) {
    lights.push_back(triangle_light(random.point(5), random.point(5), random.point(5)));
    lights.push_back(sphere_light(random.point(5), double(random.in(.1f, 4)), i & 1));
    lights.push_back(random_rectangle(random));
  }
  const LightScene scene(lights);
  for (const uint32_t n : tail_counts(k.lanes)) {
    Batch b(n);
    for (uint32_t i = 0; i < n; ++i)
      b.set(i, rounded(random.point(5)), random.unit(), random.unit(), random.unit());
    b.run(k, scene.view, kPlainLights);
    GuardedTable<Surface> hits(n);
    GuardedTable<PathState> paths(n);
    GuardedTable<SampleSum> sums(n);
    for (uint32_t i = 0; i < n; ++i) {
      const LightSample<Value> s = b.samples.row(i);
      const auto chosen = uint32_t(double(b.randoms.row(i).light_choice) * 12);
      const LightRow<Value>& row = lights[chosen];
      const glm::dvec3 a(row.a_x, row.a_y, row.a_z), to = to_of(s);
      const glm::dvec3 ng = is_flat(row)
                                ? glm::normalize(glm::cross(glm::dvec3(row.b_x, row.b_y, row.b_z),
                                                            glm::dvec3(row.c_x, row.c_y, row.c_z)))
                                : glm::normalize(to - a) * (row.b_x != 0 ? -1. : 1.);
      const glm::dvec3 wo = glm::normalize(b.pos(i) - to);
      Surface<Value> h{};
      put(to, h.pos_x, h.pos_y, h.pos_z);
      put(ng, h.ng_x, h.ng_y, h.ng_z);
      put(wo, h.wo_x, h.wo_y, h.wo_z);
      h.distance = float(glm::length(b.pos(i) - to));
      h.light = i % 7 == 3 ? kNone : chosen;
      hits.set(i, h);
      PathState<Value> p{};
      p.throughput_r = .5f, p.throughput_g = 1, p.throughput_b = .25f;
      p.pdf = i % 3 ? s.pdf * random.in(.2f, 3) : 0;
      p.slot = n - 1 - i;
      paths.set(i, p);
      sums.set(i, {1, 2, 3, 77});
    }
    DropLog drops;
    k.add_emission(scene.view, hits.view(), paths.view(), sums.columns(), drops, n);
    EXPECT_TRUE(sums.untouched(n)) << "no slot but those of the paths";
    for (uint32_t i = 0; i < n; ++i) {
      const LightSample<Value> s = b.samples.row(i);
      const PathState<Value> p = paths.row(i);
      const SampleSum<Value> sum = sums.row(n - 1 - i);
      const Surface<Value> h = hits.row(i);
      EXPECT_EQ(sum.pixel, 77u);
      const double front = double(h.ng_x) * double(h.wo_x) + double(h.ng_y) * double(h.wo_y) +
                           double(h.ng_z) * double(h.wo_z);
      if (s.weight_r == 0) continue;
      if (h.light == kNone || front <= 0) {
        EXPECT_EQ(sum.r, 1.f);
        continue;
      }
      const double other = double(s.pdf) / std::max(double(p.pdf), 1e-30);
      const double weight = p.pdf == 0 ? 1 : 1 / (1 + other * other);
      // Radiance is (1, .5, 2).
      const double slack = front > .01 ? 2e-4 : .05;
      EXPECT_NEAR(sum.r - 1, .5 * weight, slack);
      EXPECT_NEAR(sum.g - 2, .5 * weight, slack);
      EXPECT_NEAR(sum.b - 3, .5 * weight, slack);
    }
    for (const uint64_t count : drops.count) EXPECT_EQ(count, 0u);
  }
}

TEST_P(Lights, EmissionIsOneSidedAndBrokenOnesAreCounted) {
  const KernelTable& k = kernels();
  std::vector<LightRow<Value>> lights = {triangle_light({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
  lights.push_back(lights[0]);
  lights[1].radiance_g = std::nanf("");
  const LightScene scene(lights);
  constexpr uint32_t n = 40;
  GuardedTable<Surface> hits(n);
  GuardedTable<PathState> paths(n);
  GuardedTable<SampleSum> sums(n);
  for (uint32_t i = 0; i < n; ++i) {
    Surface<Value> h{};
    h.ng_z = 1;
    h.wo_z = i % 4 == 1 ? -1 : 1;
    h.distance = 2;
    h.light = i == 8 ? 1 : 0;
    hits.set(i, h);
    PathState<Value> p{};
    p.throughput_r = p.throughput_g = p.throughput_b = i == 16 ? INFINITY : 1;
    p.pdf = i == 24 ? std::nanf("") : i == 28 ? -1.f : .1f;
    p.slot = i;
    p.pixel = 100 + i;
    p.sample = 200 + i;
    paths.set(i, p);
    sums.set(i, {0, 0, 0, 0});
  }
  DropLog drops;
  k.add_emission(scene.view, hits.view(), paths.view(), sums.columns(), drops, n);
  EXPECT_EQ(drops.count[uint32_t(DropCause::kLight)], 1u);
  EXPECT_EQ(drops.count[uint32_t(DropCause::kOther)], 1u);
  EXPECT_EQ(drops.count[uint32_t(DropCause::kPdf)], 2u);
  ASSERT_EQ(drops.kept, 4u);
  for (uint32_t e = 0; e < drops.kept; ++e)
    EXPECT_EQ(drops.entry[e].pixel + 100, drops.entry[e].sample);
  for (uint32_t i = 0; i < n; ++i) {
    const bool dark = i % 4 == 1 || i == 8 || i == 16 || i == 24 || i == 28;
    EXPECT_EQ(sums.row(i).r > 0, !dark) << i;
    EXPECT_TRUE(std::isfinite(sums.row(i).g));
  }
}

}  // namespace
}  // namespace yat
