// Analytic shapes that shine: areas, densities of both sides of MIS, closed forms of irradiance.

#include <bit>
#include <cmath>

#include "kernels/rng_scalar.h"
#include "shape_rows.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi, kWhole = 2 * kPi;

class ShapeLights : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(ShapeLights);

TEST(ShapeAreas, AreTextbookOnes) {
  const glm::dmat3 one(1.);
  const auto paraboloid = [](double r, double h) {  // from its tip
    return kPi * r / (6 * h * h) * (std::pow(r * r + 4 * h * h, 1.5) - r * r * r);
  };
  const struct {
    AnalyticShape shape;
    double area;
  } known[] = {{make_sphere(2, -2, 2, kWhole), 16 * kPi},
               {make_sphere(2, -1, 1.5, 1), 2 * 2.5},
               {make_disk(3, 1, 5, kPi), 4 * kPi},
               {make_cylinder(2, -1, 3, kWhole), 16 * kPi},
               {make_cone(3, 0, 4, kWhole), 15 * kPi},
               {make_cone(4, 1, 4, kWhole), 25 * kPi},
               {make_paraboloid(1.5, 0, 2, kWhole), paraboloid(1.5, 2)},
               // The part below z = 1 of the same paraboloid is one of radius 1.5 / sqrt(2).
               {make_paraboloid(1.5, 1, 2, kPi),
                (paraboloid(1.5, 2) - paraboloid(1.5 / std::sqrt(2.), 1)) / 2},
               // x^2 + y^2 = 1 + z^2, z from -1 to 1: 2 pi times the integral of sqrt(1 + 2 z^2).
               {make_hyperboloid({1, -1, -1}, {1, 1, 1}, kWhole),
                2 * kPi * (std::sqrt(3.) + std::asinh(std::sqrt(2.)) / std::sqrt(2.))},
               {make_torus(3, 1, 0, kWhole, kWhole), 12 * kPi * kPi},
               {make_torus(3, 1, 0, kPi / 2, kPi), kPi * (3 * kPi / 2 + 1)}};
  for (const auto& k : known) EXPECT_NEAR(area_of(k.shape, one) / k.area, 1, 1e-9);
  // A sphere as an ellipsoid of revolution: 2 pi (1 + 2 asin(e) / e) with axes 1, 1, 2.
  const double e = std::sqrt(3.) / 2;
  const glm::dmat3 longer(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 2));
  EXPECT_NEAR(area_of(make_sphere(1, -1, 1, kWhole), longer), 2 * kPi * (1 + 2 * std::asin(e) / e),
              1e-6);
}

/// Scenes of one shape light with radiance 1.
struct ShapeLightScene : ShapeScene {
  RowTable<LightRow> lights;
  RowTable<LightChoice> choice;
  explicit ShapeLightScene(std::vector<ShapeRow<Value>> list)
      : ShapeScene(list), lights(uint32_t(list.size())), choice(uint32_t(list.size())) {
    for (uint32_t i = 0; i < list.size(); ++i) {
      LightRow<Value> light{};
      light.kind = uint32_t(LightKind::kShape);
      light.a_x = std::bit_cast<float>(i);
      light.radiance_r = light.radiance_g = light.radiance_b = 1;
      light.probability = 1.f / float(list.size());
      lights.set(i, light);
      choice.set(i, {1, i});
    }
    view.lights.rows = lights.view();
    view.lights.choice = choice.view();
    view.lights.kinds = 1u << uint32_t(LightKind::kShape);
  }
};

struct Sampled {
  uint32_t n;
  GuardedTable<Surface> surfaces;
  GuardedTable<Randoms> randoms;
  GuardedTable<LightSample> samples;
  explicit Sampled(uint32_t rows) : n(rows), surfaces(n), randoms(n), samples(n) {}
  void set(uint32_t i, const glm::dvec3& pos, uint32_t seed) {
    Surface<Value> s{};
    s.pos_x = float(pos.x), s.pos_y = float(pos.y), s.pos_z = float(pos.z);
    surfaces.set(i, s);
    const auto [u, v] = random_pair(SamplerKind::kSobol, seed, Dimension::kLight, 0, i, 0);
    const auto pick = random_pair(SamplerKind::kIndependent, seed, Dimension::kChoice, 0, i, 0);
    randoms.set(i, {u, v, pick.first, 0, 0, 0, 0});
  }
  void run(const KernelTable& k, const SceneView& scene) {
    k.sample_lights[kAnyLights](scene, surfaces.view(), randoms.view(), samples.columns(), n);
  }
  glm::dvec3 pos(uint32_t i) const {
    const Surface<Value> s = surfaces.row(i);
    return {s.pos_x, s.pos_y, s.pos_z};
  }
};

TEST_P(ShapeLights, SamplesAreTheReferencesAndEmissionHasTheirDensity) {
  Random random(1);
  for (const NamedShape& named : all_shapes()) {
    ShapeRow<Value> row =
        shape_row(named.shape, random_placement(random, 1, 2), random.below(2), glm::dvec3(0.));
    row.light = 0;
    const ShapeLightScene scene({row});
    constexpr uint32_t n = 403;
    Sampled samples(n);
    const glm::dvec3 center(row.org_x, row.org_y, row.org_z);
    for (uint32_t i = 0; i < n; ++i) {
      const glm::dvec3 pos = center + double(row.radius) * random.point(2);
      samples.set(i, pos, 3);
    }
    samples.run(kernels(), scene.view);
    EXPECT_TRUE(samples.samples.untouched());
    GuardedTable<Surface> seen(n);
    GuardedTable<PathState> paths(n);
    GuardedTable<SampleSum> sums(n);
    uint32_t front = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const LightSample<Value> s = samples.samples.row(i);
      const Randoms<Value> r = samples.randoms.row(i);
      const auto at = reference::sample_shape(row, double(r.light_u), double(r.light_v));
      const glm::dvec3 way = at.position - samples.pos(i), wi = glm::normalize(way);
      const double cos = -glm::dot(wi, at.normal), d2 = glm::dot(way, way);
      Surface<Value> hit{};
      hit.light = kNone;
      PathState<Value> path{};
      path.slot = i;
      paths.set(i, path);
      sums.set(i, {0, 0, 0, 0});
      seen.set(i, hit);
      if (cos < 0) {
        if (cos < -1e-3) {
          EXPECT_EQ(s.weight_r, 0.f) << named.name;
        }
        continue;
      }
      if (cos < .02 || d2 < .01) continue;
      ++front;
      const double measure = at.inverse_density * cos / d2;
      const double slack = named.name == "needle" || named.name == "wire" ? 3e-3 : 3e-4;
      expect_close(double(s.weight_r), measure, slack / cos, named.name.c_str(), i);
      expect_close(double(s.pdf), 1 / measure, slack / cos, named.name.c_str(), i);
      // The shadow ray ends off the light, on its bright side.
      const double above = glm::dot(glm::dvec3(s.to_x, s.to_y, s.to_z) - at.position, at.normal);
      EXPECT_GT(above, 0) << named.name;
      EXPECT_LT(above, 1e-4 * double(row.extent)) << named.name;

      hit.light = 0;
      hit.distance = float(std::sqrt(d2));
      hit.pos_x = float(at.position.x), hit.pos_y = float(at.position.y);
      hit.pos_z = float(at.position.z);
      hit.ng_x = float(at.normal.x), hit.ng_y = float(at.normal.y), hit.ng_z = float(at.normal.z);
      hit.wo_x = float(-wi.x), hit.wo_y = float(-wi.y), hit.wo_z = float(-wi.z);
      seen.set(i, hit);
      path.throughput_r = path.throughput_g = path.throughput_b = 1;
      path.pdf = s.pdf;  // the two densities are equal: half the weight each
      paths.set(i, path);
    }
    DropLog drops;
    kernels().add_emission(scene.view, seen.view(), paths.view(), sums.columns(), drops, n);
    for (uint32_t i = 0; i < n; ++i) {
      if (seen.row(i).light == kNone) {
        EXPECT_EQ(sums.row(i).r, 0.f);
      } else {
        EXPECT_NEAR(sums.row(i).r, .5, 5e-3) << named.name;
      }
    }
    EXPECT_GT(front, n / 10) << named.name;
    for (const uint64_t count : drops.count) EXPECT_EQ(count, 0u) << named.name;
  }
}

// The mean of 1 / density is the area, however the shape is squeezed.
TEST_P(ShapeLights, DensitiesIntegrateToTheArea) {
  Random random(2);
  for (const NamedShape& named : all_shapes()) {
    const Placement placement = random_placement(random, 1, 1);
    const ShapeLightScene scene({shape_row(named.shape, placement, false, glm::dvec3(0.))});
    constexpr uint32_t n = 1 << 16;
    // From far off along an axis the area seen, front by front, is the projected area; over all
    // directions its mean is a quarter of both sides (Cauchy). So: from many places on a sphere.
    const double far = 1e3;
    Sampled samples(n);
    const ShapeRow<Value> row = scene.rows.row(0);
    for (uint32_t i = 0; i < n; ++i) {
      samples.set(i, glm::dvec3(row.org_x, row.org_y, row.org_z) + far * random.direction(), 4);
      samples.randoms.set(i, {random.unit(), random.unit(), random.unit(), 0, 0, 0, 0});
    }
    samples.run(kernels(), scene.view);
    double sum = 0;
    for (uint32_t i = 0; i < n; ++i) sum += double(samples.samples.row(i).weight_r);
    const double area = 4 * sum / n * far * far;
    EXPECT_NEAR(area / area_of(named.shape, placement.linear), 1, .02) << named.name;
  }
}

// Irradiance at the origin on z = 0 that looks up, by lights of radiance 1.
TEST_P(ShapeLights, IrradianceOfKnownShapes) {
  const auto scaled = [](double x, double y, double z) {
    Diagnostics silent([](Severity, std::string_view) {});
    return *make_placement(glm::scale(Matrix(1.), glm::dvec3(x, y, z)), {}, "", silent);
  };
  const Placement as_is;
  const struct {
    const char* name;
    AnalyticShape shape;
    Placement placement;
    bool reverse;
    double irradiance;
  } forms[] = {// On the axis of a disk: pi r^2 / (r^2 + h^2).
               {"disk", make_disk(1, 0, 2, kWhole), as_is, true, kPi / 5},
               {"ring", make_disk(2, 1, 2, kWhole), as_is, true, kPi * (4. / 8 - 1. / 5)},
               {"quarter of a disk", make_disk(1, 0, 2, kPi / 2), as_is, true, kPi / 20},
               // Walls around leave out what a disk at their upper end covers.
               {"cylinder", make_cylinder(1, 0, 2, kWhole), as_is, true, kPi * (1 - 1. / 5)},
               {"frustum", make_cone(2, 1, 2, kWhole), as_is, true, kPi * (1 - 1. / 5)},
               {"cone", make_cone(1, 0, 3, kWhole), as_is, true, kPi},
               {"half a cone", make_cone(1, 0, 3, kPi), as_is, true, kPi / 2},
               {"hyperboloid", make_hyperboloid({3, -1, 0}, {3, 1, 2}, kWhole), as_is, true,
                kPi * (1 - 10. / 14)},
               // Domes cover everything, of any form.
               {"half a sphere", make_sphere(2, 0, 2, kWhole), as_is, true, kPi},
               {"half an ellipsoid", make_sphere(1, 0, 1, kWhole), scaled(1, 2, 3), true, kPi},
               {"paraboloid", make_paraboloid(1, 0, 1, kWhole), scaled(2, 1, -1), true, -1},
               {"sphere from outside", make_sphere(1, -1, 1, kWhole), as_is, false, -1}};
  uint32_t seed = 30;
  for (const auto& form : forms) {
    Placement placement = form.placement;
    double irradiance = form.irradiance;
    if (std::string(form.name) == "paraboloid") {
      placement.origin = {0, 0, 1};  // its tip above, its rim on the plane
      irradiance = kPi;
    }
    if (std::string(form.name) == "sphere from outside") {
      placement = scaled(1, 1, 1);
      placement.origin = {0, 0, 3};
      irradiance = kPi / 9;  // pi sin^2
    }
    const ShapeLightScene scene({shape_row(form.shape, placement, form.reverse, glm::dvec3(0.))});
    constexpr uint32_t n = 1 << 16;
    Sampled samples(n);
    for (uint32_t i = 0; i < n; ++i) samples.set(i, {0, 0, 0}, seed);
    ++seed;
    samples.run(kernels(), scene.view);
    double sum = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const LightSample<Value> s = samples.samples.row(i);
      sum += double(s.weight_r) * std::max(double(s.wi_z), 0.);
    }
    EXPECT_NEAR(sum / n / irradiance, 1, 2e-3) << form.name;
  }
}

}  // namespace
}  // namespace yat
