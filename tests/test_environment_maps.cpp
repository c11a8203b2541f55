// Which way round pictures lie on the sphere, how much light spots, slides and profiles send, and
// daylight against the numbers of its models.

#include <cmath>
#include <numbers>

#include "environment_scenes.h"
#include "kernel_columns.h"
#include "scene/daylight.h"
#include "scene/light_maps.h"
#include "wavefront/reference_parts.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

class LightMaps : public PerIsa {
 protected:
  Scene lit_by(const std::string& light) {
    return compile_text(view_text("0 -3 0", "0 0 0", 50, 8, 8) + matte_text("1 1 1") +
                            "Shape \"mesh\" \"integer triindices\" [0 1 2] \"point P\" [-1 -1 0 1 "
                            "-1 0 0 1 0]\n" +
                            light + "WorldEnd\n",
                        kernels(), ColourMode::kRgb);
  }
  /// What a ray that misses sees in a direction.
  glm::dvec3 seen(const Scene& scene, const glm::dvec3& w) {
    GuardedTable<Ray> rays(1);
    GuardedTable<Hit> hits(1);
    GuardedTable<PathState> paths(1);
    GuardedTable<SampleSum> sums(1);
    rays.set(0, {0, 0, 0, float(w.x), float(w.y), float(w.z), kRayFar});
    Hit<Value> hit{};
    hit.prim = kNone;
    hits.set(0, hit);
    PathState<Value> path{};
    path.throughput_r = path.throughput_g = path.throughput_b = 1;
    paths.set(0, path);
    sums.set(0, {0, 0, 0, 0});
    const uint32_t order[kRowPad] = {};
    DropLog drops;
    kernels().add_environment(scene.view(), order, rays.view(), hits.view(), paths.view(), {},
                              sums.columns(), drops, 1);
    const SampleSum<Value> s = sums.row(0);
    return {s.r, s.g, s.b};
  }
  /// Irradiance times distance^2 of the scene's one light on surfaces that face it from `places`.
  std::vector<double> intensities(const Scene& scene, const std::vector<glm::dvec3>& places,
                                  double distance) {
    const auto n = uint32_t(places.size());
    GuardedTable<Surface> surfaces(n);
    GuardedTable<Randoms> randoms(n);
    GuardedTable<LightSample> samples(n);
    for (uint32_t i = 0; i < n; ++i) {
      Surface<Value> s{};
      s.pos_x = float(places[i].x - scene.center.x);
      s.pos_y = float(places[i].y - scene.center.y);
      s.pos_z = float(places[i].z - scene.center.z);
      surfaces.set(i, s);
      randoms.set(i, {});
    }
    kernels().sample_lights[kAnyLights](scene.view(), surfaces.view(), randoms.view(),
                                        samples.columns(), n);
    std::vector<double> found;
    for (uint32_t i = 0; i < n; ++i) {
      EXPECT_EQ(samples.row(i).pdf, 0) << "no ray finds it";
      found.push_back(double(samples.row(i).weight_g) * distance * distance);
    }
    return found;
  }
  /// Integral over directions of what the light at `position` sends into them.
  double flux(const Scene& scene, const glm::dvec3& position) {
    constexpr uint32_t kRows = 200, kColumns = 400;
    std::vector<glm::dvec3> places;
    for (uint32_t j = 0; j < kRows; ++j)
      for (uint32_t i = 0; i < kColumns; ++i)
        places.push_back(position + 2. * latlong_direction((i + .5) / kColumns, (j + .5) / kRows));
    const std::vector<double> found = intensities(scene, places, 2);
    double sum = 0;
    for (uint32_t j = 0; j < kRows; ++j)
      for (uint32_t i = 0; i < kColumns; ++i)
        sum += found[j * kColumns + i] * std::sin(kPi * (j + .5) / kRows);
    return sum * 2 * kPi * kPi / (kRows * kColumns);
  }
};
YAT_INSTANTIATE_PER_ISA(LightMaps);

/// Texel k of a picture is (k, 255 - k, 100) / 255.
std::string numbered_picture(const std::string& name, uint32_t width, uint32_t height) {
  std::vector<uint8_t> texels;
  for (uint32_t k = 0; k < width * height; ++k)
    texels.insert(texels.end(), {uint8_t(k), uint8_t(255 - k), 100});
  return write_ppm(name, width, height, texels);
}
std::string image_text(const std::string& picture, const std::string& more = "") {
  return "LightSource \"infinite\" \"string mapname\" [\"" + picture + "\"] " + more + "\n";
}

// Row 0 is the zenith, s grows from +x towards +y.
TEST_P(LightMaps, LatLongLiesAsTheFormatSays) {
  const Scene scene = lit_by(image_text(numbered_picture("numbered.ppm", 16, 8)));
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 0; x < 16; ++x) {
      const double theta = (y + .5) / 8 * kPi, phi = (x + .5) / 16 * 2 * kPi;
      const glm::dvec3 w(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
      EXPECT_NEAR(seen(scene, w).x * 255, y * 16 + x, .01) << x << " " << y;
    }
  // Between two texels their mean, also where the picture closes on itself.
  EXPECT_NEAR(seen(scene, {std::cos(0.), 0, 1e-9}).x * 255, (48 + 63 + 64 + 79) / 4., .01);
}

// As that of textures does: LuxRender raises the spectrum of the stored colour.
TEST_P(LightMaps, GammaActsOnBands) {
  const std::string picture = write_ppm("saturated.ppm", 2, 1, {220, 60, 20, 220, 60, 20});
  for (const ColourMode mode : {ColourMode::kBands, ColourMode::kRgb}) {
    const Scene scene =
        compile_text(view_text("0 0 0", "1 0 0", 50, 8, 8) +
                         image_text(picture, "\"float gamma\" [2.2]") + "WorldEnd\n",
                     kernels(), mode);
    const glm::dvec3 bands =
        to_bands(glm::dvec3(220, 60, 20) / 255., colour_model(mode).reflectance);
    const glm::dvec3 found = seen(scene, {1, 0, 0});
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], std::pow(bands[k], 2.2), 1e-6) << k;
  }
}

TEST_P(LightMaps, TheTransformTurnsThePicture) {
  const std::string picture = numbered_picture("numbered.ppm", 16, 8);
  const Scene plain = lit_by(image_text(picture));
  // Light space z to world x.
  const Scene turned = lit_by("Rotate 90 0 1 0\n" + image_text(picture));
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 l = rounded(random.direction());
    EXPECT_NEAR(seen(turned, {l.z, l.y, -l.x}).x, seen(plain, l).x, 1e-4);
  }
  EXPECT_NEAR(seen(turned, {1, 0, 0}).x * 255, 7.5, 8) << "row 0 is around +x";
  // Scale and translation change nothing.
  const Scene scaled = lit_by("Translate 5 6 7\nScale 3 3 3\n" + image_text(picture));
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 l = rounded(random.direction());
    EXPECT_NEAR(seen(scaled, l).x, seen(plain, l).x, 1e-4);
  }
}

// lxs 6.4: r = acos(-x) / 2 pi; the middle of the picture is -x.
// YART shows a picture as it is, whatever L, gain, gamma and the transform say, with its middle
// column where LuxRender's seam is (lxs 12.5).
TEST_P(LightMaps, YartsPictureIsHalfATurnFromLuxRenders) {
  const std::string picture =
      image_text(numbered_picture("numbered.ppm", 16, 8), "\"color L\" [3 2 1] \"float gain\" [5]");
  const std::string turned =
      "Rotate 90 0 1 0\n" +
      image_text(numbered_picture("numbered.ppm", 16, 8),
                 "\"color L\" [3 2 1] \"float gain\" [5] \"float gamma\" [2.2]");
  const auto by_yart = [&](const std::string& light) {
    Diagnostics diagnostics(fail_at_warnings);
    return compile_description(
        parse_scene(view_text("0 -3 0", "0 0 0", 50, 8, 8) + light + "WorldEnd\n", "test.lxs", ".",
                    diagnostics, false, Dialect::kYart),
        kernels(), diagnostics, 0, 0, ColourMode::kRgb);
  };
  const Scene plain = by_yart(picture), rotated = by_yart(turned);
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 0; x < 16; ++x) {
      const glm::dvec3 w = latlong_direction((x + .5) / 16, (y + .5) / 8);
      const double texel = y * 16 + (x + 8) % 16;
      for (const Scene* scene : {&plain, &rotated}) {
        EXPECT_NEAR(seen(*scene, w).x * 255, texel, .01) << x << " " << y;
        EXPECT_NEAR(seen(*scene, w).z * 255, 100, .01) << x << " " << y;
      }
    }
}

TEST_P(LightMaps, AngularLiesAsTheFormatSays) {
  const Scene scene = lit_by(
      image_text(numbered_picture("angular.ppm", 15, 15), "\"string mapping\" [\"angular\"]"));
  EXPECT_NEAR(seen(scene, {-1, 0, 0}).x * 255, 7 * 15 + 7, .01);
  const double angle = 4. / 15 * 2 * kPi;  // four texels from the middle
  EXPECT_NEAR(seen(scene, {-std::cos(angle), std::sin(angle), 0}).x * 255, 7 * 15 + 3, .02);
  EXPECT_NEAR(seen(scene, {-std::cos(angle), 0, std::sin(angle)}).x * 255, 3 * 15 + 7, .02);
}

TEST_P(LightMaps, CrossLiesAsTheFormatSays) {
  // Cells of 3 x 3 texels.
  const Scene scene =
      lit_by(image_text(numbered_picture("cross9.ppm", 9, 12), "\"string mapping\" [\"vcross\"]"));
  const auto texel = [](int column, int row, int i, int j) {
    return (row * 3 + j) * 9 + column * 3 + i;
  };
  const struct {
    glm::dvec3 w;
    int column, row;
  } sides[] = {{{0, 0, 1}, 1, 0},  {{0, 1, 0}, 0, 1},  {{-1, 0, 0}, 1, 1},
               {{0, -1, 0}, 2, 1}, {{0, 0, -1}, 1, 2}, {{1, 0, 0}, 1, 3}};
  for (const auto& side : sides)
    EXPECT_NEAR(seen(scene, side.w).x * 255, texel(side.column, side.row, 1, 1), .01)
        << side.column << " " << side.row;
  // Within the side of -x: s grows with -y, t with -z.
  EXPECT_NEAR(seen(scene, glm::normalize(glm::dvec3(-1, -2. / 3, 0))).x * 255, texel(1, 1, 2, 1),
              .01);
  EXPECT_NEAR(seen(scene, glm::normalize(glm::dvec3(-1, 0, -2. / 3))).x * 255, texel(1, 1, 1, 2),
              .01);
}

// ---- Points ----------------------------------------------------------------------------------

TEST_P(LightMaps, SpotFallsOffToItsCone) {
  const std::string place = "\"point from\" [1 2 3] \"point to\" [1 2 0] ";
  const Scene scene = lit_by("LightSource \"spot\" " + place +
                             "\"float coneangle\" [30] \"float conedeltaangle\" [10]\n");
  const glm::dvec3 from(1, 2, 3);
  const auto at = [&](double degrees) {
    const double a = degrees * kPi / 180;
    return intensities(scene, {from + 5. * glm::dvec3(std::sin(a), 0, -std::cos(a))}, 5)[0];
  };
  EXPECT_NEAR(at(0), 1, 1e-5);
  EXPECT_NEAR(at(19.9), 1, 1e-5);
  const double full = std::cos(20 * kPi / 180), rim = std::cos(30 * kPi / 180);
  EXPECT_NEAR(at(25), std::pow((std::cos(25 * kPi / 180) - rim) / (full - rim), 4), 1e-4);
  EXPECT_EQ(at(30.1), 0);
  EXPECT_EQ(at(180), 0);
  // 2 pi times the integral of 1, then of x^4 over the falloff.
  EXPECT_NEAR(flux(scene, from), 2 * kPi * ((1 - full) + (full - rim) / 5), 2e-3);
  // By power: lumens over the solid angle that LuxRender counts.
  const Scene powered =
      lit_by("LightSource \"spot\" " + place + "\"float power\" [10] \"float efficacy\" [20]\n");
  const double counted = 2 * kPi * (1 - (std::cos(30 * kPi / 180) + std::cos(25 * kPi / 180)) / 2);
  EXPECT_NEAR(intensities(powered, {{1, 2, -2}}, 5)[0], 200 / counted, 1e-2);
}

TEST_P(LightMaps, MappedPointKeepsItsFlux) {
  const std::string picture = uneven_picture("gonio.ppm", 40, 20);
  const Scene scene = lit_by(
      "Translate 0 0 4\nRotate 30 1 1 0\nLightSource \"goniometric\" "
      "\"string mapname\" [\"" +
      picture + "\"] \"color L\" [2 3 4]\n");
  EXPECT_EQ(scene.lights.row(0).kind, uint32_t(LightKind::kPointMap));
  // Y of L times 4 pi; the map is not grey, so each channel by itself is not kept.
  const Scene grey =
      lit_by("LightSource \"point\" \"string mapname\" [\"" +
             write_ppm("grey.ppm", 2, 2, {9, 9, 9, 200, 200, 200, 50, 50, 50, 90, 90, 90}) +
             "\"] \"point from\" [0 0 4] \"color L\" [2 3 4]\n");
  EXPECT_NEAR(flux(grey, {0, 0, 4}), 4 * kPi * 3, .05);
  // Texel (0, 0) of 2 x 2 lies at theta 45, phi 90.
  const double s = std::sqrt(.5);
  const std::vector<double> two =
      intensities(grey, {glm::dvec3(0, s, 4 + s), glm::dvec3(0, -s, 4 + s)}, 1);
  EXPECT_NEAR(two[0] / two[1], 9. / 200, 1e-3);
}

TEST_P(LightMaps, ProfileShinesAsItsAngles) {
  const std::string path =
      write_for_scenes("lamp.ies",
                       "IESNA:LM-63-1995\n[TEST] none\nTILT=NONE\n1 1000 2 5 2 1 2 0 0 0\n1 1 50\n"
                       "0 30 60 90 180\n0 180\n10 8 4 0 0\n20 16 8 0 0\n");
  const auto lamp = [&](const std::string& more) {
    return lit_by("LightSource \"point\" \"string iesname\" [\"" + path +
                  "\"] \"point from\" [0 0 4] " + more + "\n");
  };
  const Scene scene = lamp("");
  EXPECT_NEAR(flux(scene, {0, 0, 4}), 4 * kPi, .03);
  const auto at = [](double theta, double phi, double side) {
    theta *= kPi / 180, phi *= kPi / 180;
    return glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                      side * std::cos(theta)) +
           glm::dvec3(0, 0, 4);
  };
  const std::vector<double> i = intensities(
      scene,
      {at(45, 0, 1), at(45, 90, 1), at(45, 180, 1), at(45, 270, 1), at(75, 0, 1), at(120, 10, 1)},
      1);
  EXPECT_NEAR(i[1] / i[0], 1.5, .01);
  EXPECT_NEAR(i[2] / i[0], 2, .01);
  EXPECT_NEAR(i[3] / i[0], 1.5, .01) << "given to 180 degrees: the other half is its mirror";
  EXPECT_NEAR(i[4] / i[0], 2. / 6, .01);
  EXPECT_EQ(i[5], 0);
  const std::vector<double> flipped =
      intensities(lamp("\"bool flipz\" [\"true\"]"), {at(45, 0, -1), at(45, 0, 1)}, 1);
  EXPECT_NEAR(flipped[0], i[0], 1e-3 * i[0]);
  EXPECT_EQ(flipped[1], 0);
}

TEST_P(LightMaps, ProjectionShowsItsSlide) {
  // Two texels across: red 200 at -x, 50 at +x.
  const std::string slide = write_ppm("slide.ppm", 2, 1, {200, 200, 200, 50, 50, 50});
  const Scene scene = lit_by("Translate 0 0 5\nLightSource \"projection\" \"string mapname\" [\"" +
                             slide + "\"] \"float fov\" [60] \"color L\" [3 3 3]\n");
  const double side = std::tan(kPi / 6), area = 4 * side * side / 2;
  const std::vector<glm::dvec3> places = {
      {-side, 0, 6}, {side, 0, 6}, {0, 1.01 * side, 6}, {0, 0, 4}, {2.01 * side, 0, 6}};
  std::vector<double> found;
  for (const glm::dvec3& p : places)
    found.push_back(intensities(scene, {p}, glm::length(p - glm::dvec3(0, 0, 5)))[0]);
  const double cos4 = std::pow(1 + side * side, -2);
  EXPECT_NEAR(found[0], 3 * 200 / 255. / area / cos4, 1e-3);
  EXPECT_NEAR(found[1], 3 * 50 / 255. / area / cos4, 1e-3);
  for (const size_t outside : {2u, 3u, 4u}) EXPECT_EQ(found[outside], 0);
  // The flux by which it is chosen is the flux that it has.
  EXPECT_NEAR(flux(scene, {0, 0, 5}), 3 * double(scene.lights.row(0).b_z), .02);
}

// ---- Daylight --------------------------------------------------------------------------------

TEST(Daylight, TheSunIsAsBrightAsItsTableSays) {
  // lxs A.2: turbidity, elevation, Y [1e9], R, G, B of Y = 1, illuminance.
  const double table[][7] = {
      {2, 90, 1.496, 1.125, .976, .872, 101610}, {2, 45, 1.362, 1.150, .974, .822, 92466},
      {2, 5, .1851, 1.771, .851, .201, 12568},   {3, 15, .544, 1.383, .936, .504, 36941},
      {6, 90, 1.008, 1.204, .964, .760, 68454},  {6, 15, .179, 1.631, .881, .322, 12158}};
  for (const auto& row : table) {
    const glm::dvec3 rgb = sun_radiance(std::sin(row[1] * kPi / 180), row[0]);
    const double y = .21264 * rgb.x + .71517 * rgb.y + .07219 * rgb.z;
    EXPECT_NEAR(y / 1e9, row[2], 2e-3 * row[2]);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(rgb[k] / y, row[3 + k], 2e-3);
    EXPECT_NEAR(y * kPi * kSunSine * kSunSine, row[6], 2e-3 * row[6]);
  }
}

TEST_P(LightMaps, TheSunLightsAsItsTableSays) {
  for (const std::string size : {"1", "40"}) {
    const Scene scene =
        lit_by("LightSource \"sun\" \"vector sundir\" [0 0 1] \"float relsize\" [" + size + "]\n");
    GuardedTable<Surface> surfaces(1);
    GuardedTable<Randoms> randoms(1);
    GuardedTable<LightSample> samples(1);
    surfaces.set(0, {});
    Randoms<Value> numbers{};
    // The mean over u of the cosine, 1 - u (1 - cos rim), is its value at 1/2.
    numbers.light_u = .5f;
    randoms.set(0, numbers);
    kernels().sample_lights[kAnyLights](scene.view(), surfaces.view(), randoms.view(),
                                        samples.columns(), 1);
    const LightSample<Value> s = samples.row(0);
    const double y =
        .21264 * double(s.weight_r) + .71517 * double(s.weight_g) + .07219 * double(s.weight_b);
    EXPECT_NEAR(y * double(s.wi_z), 101610, 300) << size;
    // A ray sees the disc out to its rim, and no further.
    const double rim = std::asin(std::stod(size) * kSunSine);
    EXPECT_GT(seen(scene, {std::sin(.999 * rim), 0, std::cos(.999 * rim)}).y, 1e5);
    EXPECT_EQ(seen(scene, {std::sin(1.001 * rim), 0, std::cos(1.001 * rim)}).y, 0);
  }
}

TEST_P(LightMaps, TheSkyHasTheColoursOfItsFormula) {
  const Scene scene = lit_by("LightSource \"sky\" \"vector sundir\" [1 0 1]\n");
  // lxs 6.5: the zenith, and the horizon opposite the sun.
  const glm::dvec3 zenith = seen(scene, {0, 0, 1}), horizon = seen(scene, {-1, 0, 0});
  EXPECT_NEAR(zenith.x, 2738, 5);
  EXPECT_NEAR(zenith.y, 4495, 5);
  EXPECT_NEAR(zenith.z, 9323, 10);
  EXPECT_NEAR(horizon.x, 15927, 20);
  EXPECT_NEAR(horizon.y, 15148, 20);
  EXPECT_NEAR(horizon.z, 18256, 25);
  const glm::dvec3 below = seen(scene, glm::normalize(glm::dvec3(-.2, 0, -1)));
  const glm::dvec3 above = seen(scene, glm::normalize(glm::dvec3(-.2, 0, 1)));
  EXPECT_GT(below.x, 2 * above.x) << "below the horizon its colour";
  EXPECT_GT(seen(scene, glm::normalize(glm::dvec3(1, .1, 1))).x, 2 * zenith.x) << "near the sun";
}

}  // namespace
}  // namespace yat
