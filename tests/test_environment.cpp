// Light from far away: drawn directions against their densities, the two sides of multiple
// importance sampling against each other and against the integral, and whole pictures.

#include <cmath>
#include <numbers>

#include "chi2.h"
#include "environment_scenes.h"
#include "kernel_columns.h"
#include "kernels/rng_scalar.h"
#include "many_lights.h"
#include "scene/light_maps.h"
#include "wavefront/reference.h"
#include "wavefront/reference_parts.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

/// One far light over a triangle that is not in the way of anything asked here.
std::string far_light_text(const std::string& light) {
  return view_text("0 -3 0", "0 0 0", 50, 8, 8) + matte_text("1 1 1") +
         "Shape \"mesh\" \"integer triindices\" [0 1 2] \"point P\" [-1 -1 0 1 -1 0 0 1 0]\n" +
         light + "WorldEnd\n";
}

/// Surfaces sample all of its lights, even skies too.
Scene compile_asked(const std::string& text, const KernelTable& kernels) {
  return compile_lamps(text, kernels, LightChoosing::kPower);
}

struct FarLight {
  std::string name, text;
};
std::vector<FarLight> far_lights() {
  const auto image = [](const std::string& picture, const std::string& more) {
    return "LightSource \"infinite\" \"string mapname\" [\"" + picture + "\"] " + more + "\n";
  };
  const std::string uneven = uneven_picture("uneven.ppm", 64, 32);
  const std::string cross = uneven_picture("cross.ppm", 24, 32);
  return {
      {"constant", "LightSource \"infinite\" \"color L\" [.5 .6 .9]\n"},
      {"image", image(uneven, "\"float gamma\" [2.2]")},
      {"turned image", turned_text() + image(uneven, "\"color L\" [1 .5 .2]")},
      {"sheared image",
       "ConcatTransform [1 0 0 0 .6 1.5 0 0 0 .3 -.8 0 4 5 6 1]\n" + image(uneven, "")},
      {"angular image", turned_text() + image(uneven, "\"string mapping\" [\"angular\"]")},
      {"cross image", image(cross, "\"string mapping\" [\"vcross\"]")},
      {"large sun", "LightSource \"sun\" \"vector sundir\" [.3 .4 .8] \"float relsize\" [100]\n"},
      {"sky", "LightSource \"sky\" \"vector sundir\" [.7 .2 .3] \"float turbidity\" [3]\n"},
      {"turned sky", turned_text() + "LightSource \"sky\" \"vector sundir\" [.1 .2 .9]\n"},
      {"sunsky and image",
       "LightSource \"sunsky\" \"vector sundir\" [.3 .4 .8] \"float relsize\" "
       "[100] \"float gain\" [.00001]\n" +
           turned_text() + image(uneven, "\"float gain\" [3]")}};
}

constexpr uint32_t kMany = 1 << 16;

/// Light samples of one place.
struct Drawn {
  GuardedTable<Surface> surfaces{kMany};
  GuardedTable<Randoms> randoms{kMany};
  GuardedTable<LightSample> samples{kMany};
  Drawn(const KernelTable& k, const Scene& scene, uint32_t seed) {
    for (uint32_t i = 0; i < kMany; ++i) {
      Surface<Value> s{};
      s.pos_x = .5f, s.pos_z = -.25f;
      surfaces.set(i, s);
      Randoms<Value> r{};
      const auto [u, v] = random_pair(SamplerKind::kSobol, seed, Dimension::kLight, 0, i, 0);
      r.light_u = u, r.light_v = v;
      r.light_choice =
          random_pair(SamplerKind::kIndependent, seed, Dimension::kChoice, 0, i, 0).first;
      randoms.set(i, r);
    }
    k.sample_lights[kAnyLights](scene.view(), surfaces.view(), randoms.view(), samples.columns(),
                                kMany);
  }
  glm::dvec3 wi(uint32_t i) const {
    const LightSample<Value> s = samples.row(i);
    return {s.wi_x, s.wi_y, s.wi_z};
  }
};

/// What rays into these directions see, by the stage's kernel. pdf: of the path that left.
std::vector<glm::dvec3> see(const KernelTable& k, const Scene& scene,
                            const std::vector<glm::dvec3>& directions,
                            const std::vector<float>& pdf, const TransportOptions& options = {}) {
  const auto n = uint32_t(directions.size());
  GuardedTable<Ray> rays(n);
  GuardedTable<Hit> hits(n);
  GuardedTable<PathState> paths(n);
  GuardedTable<SampleSum> sums(n);
  AlignedArray<uint32_t> order(n);
  for (uint32_t i = 0; i < n; ++i) {
    // Any order, slots in another one.
    order[i] = (i & 1) ? i : (i ^ 2) < n ? i ^ 2 : i;
    rays.set(i, {0, 0, 0, float(directions[i].x), float(directions[i].y), float(directions[i].z),
                 kRayFar});
    Hit<Value> hit{};
    hit.prim = kNone;
    hits.set(i, hit);
    PathState<Value> path{};
    path.throughput_r = path.throughput_g = path.throughput_b = 1;
    path.pdf = pdf[i];
    path.slot = n - 1 - i;
    path.depth = 1;
    paths.set(i, path);
    sums.set(i, {0, 0, 0, 0});
  }
  DropLog drops;
  k.add_environment(scene.view(), order.data(), rays.view(), hits.view(), paths.view(), options,
                    sums.columns(), drops, n);
  for (const uint64_t count : drops.count) EXPECT_EQ(count, 0u);
  std::vector<glm::dvec3> seen;
  for (uint32_t i = 0; i < n; ++i) {
    const SampleSum<Value> s = sums.row(n - 1 - i);
    seen.emplace_back(s.r, s.g, s.b);
  }
  return seen;
}

class Environment : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Environment);

// Both sides use one density: what light sampling reports is what the reference says of the
// direction, and what the directions follow.
TEST_P(Environment, DirectionsFollowTheirDensity) {
  uint32_t seed = 1;
  for (const FarLight& light : far_lights()) {
    SCOPED_TRACE(light.name);
    const Scene scene = compile_asked(far_light_text(light.text), kernels());
    const uint32_t lights = scene.lights.size();
    const Drawn drawn(kernels(), scene, seed++);
    constexpr uint32_t kRows = 8, kColumns = 16, kFine = 40;
    std::vector<double> seen(kRows * kColumns), expected(kRows * kColumns);
    uint32_t agree = 0;
    for (uint32_t i = 0; i < kMany; ++i) {
      const glm::dvec3 w = drawn.wi(i);
      ASSERT_NEAR(glm::length(w), 1, 1e-5);
      double turn = std::atan2(w.y, w.x) / (2 * kPi);
      if (turn < 0) turn += 1;
      const auto column = std::min(uint32_t(turn * kColumns), kColumns - 1);
      const auto row =
          std::min(uint32_t(std::acos(std::clamp(w.z, -1., 1.)) / kPi * kRows), kRows - 1);
      ++seen[row * kColumns + column];
      bool same = false;
      for (uint32_t l = 0; l < lights; ++l) {
        const double pdf = reference::see_environment(scene, l, {}, w).pdf;
        same = same || std::fabs(double(drawn.samples.row(i).pdf) - pdf) <= 2e-3 * pdf;
      }
      agree += same;
    }
    // Directions on the edge of a cell are rounded to the other side.
    EXPECT_GT(agree, kMany * .995);
    double total = 0;
    for (uint32_t j = 0; j < kRows * kFine; ++j)
      for (uint32_t i = 0; i < kColumns * kFine; ++i) {
        const double t = (j + .5) / (kRows * kFine), s = (i + .5) / (kColumns * kFine);
        const glm::dvec3 w = latlong_direction(s, t);
        double pdf = 0;
        for (uint32_t l = 0; l < lights; ++l) {
          const reference::SeenEnvironment at = reference::see_environment(scene, l, {}, w);
          // Outside its disc the sun's density is that of directions that are never drawn.
          if (scene.lights.row(l).kind != uint32_t(LightKind::kSun) || at.radiance.y > 0)
            pdf += at.pdf;
        }
        const double share =
            pdf * 2 * kPi * kPi * std::sin(kPi * t) / (kRows * kFine * kColumns * kFine);
        total += share;
        expected[j / kFine * kColumns + i / kFine] += share * kMany;
      }
    EXPECT_NEAR(total, 1, 4e-3) << "densities are normalised";
    // Five standard deviations, and 2 % for what the grid makes of edges of the density.
    double worst = 0;
    for (size_t b = 0; b < seen.size(); ++b)
      worst = std::max(worst, std::fabs(seen[b] - expected[b]) /
                                  (5 * std::sqrt(expected[b] + 1) + .02 * expected[b]));
    EXPECT_LT(worst, 1);
  }
}

// Irradiance by light sampling alone, by directions alone, and by both, weighted.
TEST_P(Environment, BothWaysFindTheSameLight) {
  uint32_t seed = 50;
  for (const FarLight& light : far_lights()) {
    SCOPED_TRACE(light.name);
    const Scene scene = compile_asked(far_light_text(light.text), kernels());
    const glm::dvec3 n = glm::normalize(glm::dvec3(.3, .2, .8));
    const reference::Axes axes(n);
    // The integral, over a fine grid.
    glm::dvec3 integral(0);
    constexpr uint32_t kRows = 360;
    for (uint32_t j = 0; j < kRows; ++j)
      for (uint32_t i = 0; i < 2 * kRows; ++i) {
        const double t = (j + .5) / kRows;
        const glm::dvec3 w = latlong_direction((i + .5) / (2 * kRows), t);
        const double cos = glm::dot(n, w);
        if (cos <= 0) continue;
        glm::dvec3 radiance(0);
        for (uint32_t l = 0; l < scene.lights.size(); ++l)
          radiance += reference::see_environment(scene, l, {}, w).radiance;
        integral += radiance * cos * std::sin(kPi * t) * (kPi * kPi / (kRows * kRows));
      }

    const Drawn drawn(kernels(), scene, seed++);
    std::vector<glm::dvec3> directions;
    std::vector<float> none(kMany, 0.f), pdf;
    for (uint32_t i = 0; i < kMany; ++i) {
      const auto [u, v] = random_pair(SamplerKind::kSobol, seed, Dimension::kBsdf, 0, i, 0);
      const glm::dvec3 local = reference::cosine_hemisphere(double(u), double(v));
      directions.push_back(rounded(glm::normalize(axes.to_scene(local))));
      pdf.push_back(std::max(float(local.z / kPi), 1e-9f));
    }
    const std::vector<glm::dvec3> alone = see(kernels(), scene, directions, none);
    const std::vector<glm::dvec3> weighted = see(kernels(), scene, directions, pdf);
    std::vector<double> by_light, by_direction, by_both;
    for (uint32_t i = 0; i < kMany; ++i) {
      const LightSample<Value> s = drawn.samples.row(i);
      const double cos = std::max(0., glm::dot(n, drawn.wi(i)));
      const double lit = cos * double(s.weight_g);
      by_light.push_back(lit);
      by_direction.push_back(kPi * alone[i].y);
      const double own = double(s.pdf), other = cos / kPi;
      by_both.push_back(lit * own * own / (own * own + other * other) + kPi * weighted[i].y);
    }
    // Independent random numbers would give these errors; low-discrepancy ones less.
    for (const auto& [name, values] :
         {std::pair("light sampling", by_light), std::pair("directions", by_direction),
          std::pair("both", by_both)}) {
      const Estimate e = estimate(values);
      EXPECT_NEAR(e.mean, integral.y, 4 * e.error + 4e-3 * integral.y) << name;
      EXPECT_LT(e.error, .06 * integral.y) << name;
    }
  }
}

// What the kernel sees is what the reference sees, with and without weights.
TEST_P(Environment, KernelsSeeWhatTheReferenceSees) {
  Random random(9);
  for (const FarLight& light : far_lights()) {
    SCOPED_TRACE(light.name);
    const Scene scene = compile_text(far_light_text(light.text), kernels());
    for (const uint32_t n : tail_counts(kernels().lanes)) {
      std::vector<glm::dvec3> directions;
      std::vector<float> pdf;
      for (uint32_t i = 0; i < n; ++i) {
        directions.push_back(rounded(random.direction()));
        pdf.push_back(i % 3 ? random.in(.01f, 2) : 0);
      }
      const std::vector<glm::dvec3> seen = see(kernels(), scene, directions, pdf);
      for (uint32_t i = 0; i < n; ++i) {
        glm::dvec3 wanted(0);
        double edge = 1;
        for (uint32_t l = 0; l < scene.lights.size(); ++l) {
          const auto at = reference::see_environment(scene, l, {}, glm::normalize(directions[i]));
          const double ratio = pdf[i] > 0 ? at.pdf / double(pdf[i]) : 0;
          wanted += at.radiance / (1 + ratio * ratio);
          // The density jumps at the edge of a cell.
          const glm::dvec3 beside = glm::normalize(directions[i] + glm::dvec3(2e-6, 1e-6, -2e-6));
          if (std::fabs(reference::see_environment(scene, l, {}, beside).pdf - at.pdf) >
              1e-3 * at.pdf)
            edge = 0;
        }
        if (edge > 0)
          expect_near(seen[i], wanted, 3e-4 * glm::length(wanted) + 1e-6, "radiance", i);
      }
    }
  }
}

// What no surface samples counts in full, whatever density a path came by.
TEST_P(Environment, SkiesLeftToChanceCountInFull) {
  const std::string picture = uneven_picture("left.ppm", 32, 16);
  const Scene scene = compile_text(
      far_light_text("LightSource \"point\"\nLightSource \"infinite\" \"color L\" [.5 .6 .9]\n" +
                     turned_text() + "LightSource \"sky\" \"vector sundir\" [.7 .2 .3]\n" +
                     "LightSource \"infinite\" \"string mapname\" [\"" + picture + "\"]\n"),
      kernels());
  ASSERT_EQ(scene.asked_lights, 1u);
  ASSERT_EQ(scene.lights.size(), 4u);
  std::vector<glm::dvec3> directions;
  for (uint32_t i = 0; i < 1000; ++i) {
    const auto [u, v] = random_pair(SamplerKind::kSobol, 3, Dimension::kBsdf, 0, i, 0);
    directions.push_back(rounded(latlong_direction(double(u), double(v))));
  }
  // The poles of the maps, where a density by their cells is that of no solid angle.
  for (const double z : {-1., 1.}) directions.emplace_back(0, 0, z);
  const std::vector<float> camera(directions.size(), 0.f), some(directions.size(), .3f);
  const std::vector<glm::dvec3> alone = see(kernels(), scene, directions, camera);
  EXPECT_EQ(see(kernels(), scene, directions, some), alone);
  for (uint32_t i = 0; i < directions.size(); ++i) {
    glm::dvec3 wanted(0);
    for (uint32_t l = 1; l < 4; ++l) {
      const auto seen = reference::see_environment(scene, l, {}, directions[i]);
      EXPECT_EQ(seen.pdf, 0);
      wanted += seen.radiance;
    }
    EXPECT_LT(glm::length(alone[i] - wanted), 3e-4 * glm::length(wanted)) << i;
  }
}

TEST_P(Environment, HiddenFromTheCameraAlone) {
  const Scene scene =
      compile_text(far_light_text("LightSource \"infinite\" \"color L\" [1 1 1]\n"), kernels());
  TransportOptions options;
  options.hide_environment = true;
  // These paths have scattered once.
  EXPECT_EQ(see(kernels(), scene, {{0, 0, 1}}, {0}, options)[0].y, 1);

  std::string text = far_light_text("LightSource \"infinite\" \"color L\" [1 1 1]\n");
  text = "SurfaceIntegrator \"path\" \"bool includeenvironment\" [\"false\"]\n" + text;
  const Scene hidden = compile_text(text, kernels());
  const Scene shown =
      compile_text(far_light_text("LightSource \"infinite\" \"color L\" [1 1 1]\n"), kernels());
  const std::vector<float> a =
      render_film(hidden, make_plan(hidden, kernels(), {}), 0, 16).resolve();
  const std::vector<float> b = render_film(shown, make_plan(shown, kernels(), {}), 0, 16).resolve();
  EXPECT_EQ(a[0], 0) << "beside the triangle";
  EXPECT_EQ(b[0], 1);
}

// A white matte surface under a sky of radiance L has radiance L: irradiance pi L.
TEST_P(Environment, WhiteUnderAConstantSky) {
  const std::string text = view_text("0 0 2", "0 .01 0", 40, 8, 8) + matte_text("1 1 1") +
                           "Shape \"plane\"\n"
                           "LightSource \"infinite\" \"color L\" [.5 .5 .5]\nWorldEnd\n";
  const Scene scene = compile_text(text, kernels());
  PlanOptions options;
  options.max_depth = 1;
  const std::vector<float> rgb =
      render_film(scene, make_plan(scene, kernels(), options), 0, 256).resolve();
  std::vector<double> values;
  for (size_t i = 0; i < rgb.size(); i += 3) values.push_back(double(rgb[i]));
  const Estimate e = estimate(values);
  EXPECT_NEAR(e.mean, .5, 4 * e.error + 1e-5);
  EXPECT_LT(e.error, 2e-3);
}

// Without any shape there is the sky alone.
TEST_P(Environment, ASceneOfSkyAlone) {
  const Scene scene =
      compile_text(view_text("0 0 0", "1 0 0", 50, 8, 8) +
                       "LightSource \"infinite\" \"color L\" [.25 .5 1]\nWorldEnd\n",
                   kernels(), ColourMode::kRgb);
  const std::vector<float> rgb =
      render_film(scene, make_plan(scene, kernels(), {}), 0, 4).resolve();
  for (size_t i = 0; i < rgb.size(); i += 3) {
    EXPECT_EQ(rgb[i], .25f);
    EXPECT_EQ(rgb[i + 2], 1.f);
  }
}

// LuxRender's two lights with an image differ in how they are sampled; yat samples both by the
// image (DirectionsFollowTheirDensity).
TEST_P(Environment, InfiniteSampleIsInfinite) {
  const std::string picture = uneven_picture("infinitesample.ppm", 32, 16);
  const auto film = [&](const std::string& light) {
    const Scene scene = compile_text(
        view_text("0 -3 .6", "0 0 0", 50, 24, 16) + matte_text(".7 .6 .5") +
            quad_text("-2 -2 -.5", "2 -2 -.5", "2 2 -.5", "-2 2 -.5") + sphere_text("0 0 0", .4) +
            "AttributeBegin\n" + turned_text() + "LightSource " + light +
            " \"string mapname\" [\"" + picture + "\"] \"float gain\" [3] \"float gamma\" [2]\n" +
            "AttributeEnd\nWorldEnd\n",
        kernels());
    return render_film(scene, make_plan(scene, kernels(), {}), 0, 4);
  };
  const Film infinite = film("\"infinite\"");
  EXPECT_TRUE(same_bits(infinite, film("\"infinitesample\" \"integer imapmaxresolution\" [64]")));
  double sum = 0;
  for (const float value : infinite.resolve()) sum += double(value);
  EXPECT_GT(sum, 0);
}

TEST_P(Environment, TheSameBitsForAnyThreadsAndBatches) {
  const Scene scene = compile_text(open_air_text(24, 16), kernels());
  const Plan plan = make_plan(scene, kernels(), {});
  EXPECT_TRUE(plan.environment);
  EXPECT_EQ(plan.light_groups[0].kernel, kAnyLights);
  const Film film = render_film(scene, plan, 0, 8);
  EXPECT_TRUE(same_bits(film, render_film(scene, plan, 0, 8, 2, 96, 8)));
  EXPECT_TRUE(same_bits(film, render_film(scene, plan, 0, 8, 1, 160, 16)));
}

}  // namespace
}  // namespace yat
