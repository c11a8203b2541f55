// Materials that are made of others, and veils: kernels, and renders with closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "kernel_columns.h"
#include "kernels/materials/all.h"
#include "oracle.h"
#include "per_isa.h"

namespace yat {
namespace {

class Split : public PerIsa {
 protected:
  /// Mean of each channel over renders with several seeds, and the error of red.
  struct Seen {
    glm::dvec3 mean{0.0};
    Estimate red;
  };
  Seen see(const std::string& text, uint32_t samples, uint32_t max_depth) {
    const Scene scene = compile_text(text, kernels(), ColourMode::kRgb);
    PlanOptions options;
    options.max_depth = max_depth;
    Seen seen;
    std::vector<double> reds;
    constexpr uint32_t kSeeds = 16;
    for (options.seed = 0; options.seed < kSeeds; ++options.seed) {
      const Film film = render_film(scene, make_plan(scene, kernels(), options), 0, samples);
      const std::vector<float> rgb = film.resolve();
      glm::dvec3 sum(0.0);
      for (size_t i = 0; i < rgb.size(); ++i) sum[int(i % 3)] += double(rgb[i]) * 3;
      sum /= double(rgb.size());
      reds.push_back(sum.x);
      seen.mean += sum / double(kSeeds);
    }
    seen.red = estimate(reds);
    return seen;
  }
  void expect_red(const std::string& text, uint32_t samples, uint32_t max_depth, double exact) {
    const Estimate e = see(text, samples, max_depth).red;
    EXPECT_LE(std::fabs(e.mean - exact), 3.5 * e.error + 5e-6 * exact)
        << e.mean << " +- " << e.error << ", should be " << exact;
    EXPECT_LE(e.error, .02 * exact) << "too noisy to say anything";
  }
};
YAT_INSTANTIATE_PER_ISA(Split);

std::string named(const std::string& name, const std::string& rest) {
  return "MakeNamedMaterial \"" + name + "\" \"string type\" " + rest + "\n";
}
std::string mix(const std::string& name, const std::string& a, const std::string& b,
                double amount) {
  return named(name, "[\"mix\"] \"string namedmaterial1\" [\"" + a +
                         "\"] \"string namedmaterial2\" [\"" + b + "\"] \"float amount\" [" +
                         std::to_string(amount) + "]");
}
std::string double_side(const std::string& name, const std::string& front, const std::string& back,
                        const std::string& more = "") {
  return named(name, "[\"doubleside\"] \"string frontnamedmaterial\" [\"" + front +
                         "\"] \"string backnamedmaterial\" [\"" + back + "\"] " + more);
}
std::string pane(const std::string& name, double index, double kt) {
  const std::string k = std::to_string(kt);
  return named(name, "[\"glass\"] \"bool architectural\" [\"true\"] \"float index\" [" +
                         std::to_string(index) + "] \"color Kt\" [" + k + " " + k + " " + k + "]");
}
std::string coating(const std::string& name, const std::string& base, const std::string& more) {
  return named(name, "[\"glossycoating\"] \"string basematerial\" [\"" + base + "\"] " + more);
}
std::string use(const std::string& name) {
  return "NamedMaterial \"" + name + "\"\n";
}

const std::string kBasics = named("hole", "[\"null\"]") +
                            named("black", "[\"matte\"] \"color Kd\" [0 0 0]") +
                            named("grey", "[\"matte\"] \"color Kd\" [.5 .5 .5]") +
                            named("red", "[\"matte\"] \"color Kd\" [.8 0 0]") +
                            named("green", "[\"matte\"] \"color Kd\" [0 .6 0]") +
                            named("blue", "[\"matte\"] \"color Kd\" [0 0 .4]") +
                            named("mirror", "[\"mirror\"] \"color Kr\" [1 1 1]");

/// A quad of 6 x 6 in the height z; outside upwards.
std::string shelf(const std::string& z) {
  return quad_text("-3 -3 " + z, "3 -3 " + z, "3 3 " + z, "-3 3 " + z);
}

// ---- Kernels -----------------------------------------------------------------------------------

TEST_P(Split, OneNumberChoosesBySharesAgainAndAgain) {
  const KernelTable& k = kernels();
  constexpr uint32_t n = 1 << 16;
  AlignedArray<float> share(n), u(n), left(n), again(n);
  AlignedArray<uint32_t> child(n), second(n);
  for (const double s : {0., 1e-3, .25, .5, .999, 1.}) {
    for (uint32_t i = 0; i < n; ++i) {
      share[i] = float(s);
      u[i] = i + 1 == n ? 1 - 0x1p-24f : (float(i) + .5f) / n;
    }
    k.choose_child(share.data(), u.data(), child.data(), left.data(), n);
    k.choose_child(share.data(), left.data(), second.data(), again.data(), n);
    double chosen = 0, both = 0;
    for (uint32_t i = 0; i < n; ++i) {
      chosen += child[i];
      both += child[i] & second[i];
      ASSERT_TRUE(left[i] >= 0 && left[i] < 1) << u[i];
    }
    EXPECT_NEAR(chosen / n, s, 2. / n);
    EXPECT_NEAR(both / n, s * s, 4. / n);
  }
}

TEST_P(Split, BrighterChildrenAreChosenMoreOften) {
  // Eight times as bright, at every share: what is brought stays, by whichever child.
  const KernelTable& k = kernels();
  const Scene scene = compile_text(view_text("1 -1 .5", "0 0 0", .02, 8, 8) + kBasics +
                                       mix("m", "black", "mirror", .5) + use("m") + shelf("0") +
                                       "LightSource \"point\"\nWorldEnd\n",
                                   k);
  ASSERT_TRUE(scene.splits[scene.bins[1].split].unequal);
  for (const uint32_t n : tail_counts(k.lanes)) {
    Table<Surface> surfaces(n);
    AlignedArray<float> share(n);
    AlignedArray<uint32_t> order(n);
    for (uint32_t i = 0; i < n; ++i) {
      surfaces.columns().parameter[i] = scene.triangles.row(0).parameter;
      share[i] = n == 1 ? 1.f : float(i) / float(n - 1);
      order[i] = n - 1 - i;
    }
    GuardedColumn<float> chance(n);
    k.chances(scene.view().parameters[uint32_t(MaterialKind::kMix)], surfaces.view(), share.data(),
              chance.data(), n);
    EXPECT_TRUE(chance.untouched());
    AlignedArray<float> chances(n);
    for (uint32_t i = 0; i < n; ++i) {
      const double s = double(share[i]);
      EXPECT_NEAR(chance[i], 8 * s / (1 - s + 8 * s), 1e-6);
      chances[i] = chance[i];
    }
    for (uint32_t c = 0; c < 2; ++c) {
      Table<PathState> paths(n);
      for (uint32_t i = 0; i < n; ++i) {
        PathState<Value> p{};
        p.throughput_r = 1, p.throughput_g = 2, p.throughput_b = 3;
        paths.set(i, p);
      }
      k.weigh_child(share.data(), chances.data(), order.data(), c, paths.columns(), n);
      for (uint32_t i = 0; i < n; ++i) {
        const auto of_child = [&](float second) { return double(c ? second : 1 - second); };
        const double taken = of_child(chances[order[i]]);
        if (taken == 0) continue;
        const double whole = of_child(share[order[i]]);
        EXPECT_NEAR(double(paths.row(i).throughput_r) * taken, whole, 1e-6);
        EXPECT_NEAR(double(paths.row(i).throughput_g) * taken, 2 * whole, 2e-6);
        EXPECT_NEAR(double(paths.row(i).throughput_b) * taken, 3 * whole, 3e-6);
      }
    }
  }
}

TEST_P(Split, RowsAreTakenAtEveryCount) {
  const KernelTable& k = kernels();
  Random random(5);
  constexpr uint32_t kRows = 256;
  Table<Surface> surfaces(kRows);
  Table<PathState> paths(kRows);
  AlignedArray<float> u(kRows);
  for (uint32_t i = 0; i < kRows; ++i) {
    Surface<Value> s{};
    for_each_field([&](auto, auto& field) { field = decltype(+field)(random.below(1000)); }, s);
    surfaces.set(i, s);
    PathState<Value> p{};
    for_each_field([&](auto, auto& field) { field = decltype(+field)(random.below(1000)); }, p);
    paths.set(i, p);
    u[i] = random.unit();
  }
  for (const uint32_t n : tail_counts(k.lanes)) {
    AlignedArray<uint32_t> order(n);
    for (uint32_t i = 0; i < n; ++i) order[i] = n % 2 ? i * 3 : random.below(kRows);
    for (const bool turned : {false, true}) {
      GuardedTable<Surface> s(n);
      GuardedTable<PathState> p(n);
      GuardedColumn<float> v(n);
      k.take_rows(surfaces.view(), paths.view(), u.data(), order.data(), turned, s.columns(),
                  p.columns(), v.data(), n);
      EXPECT_TRUE(s.untouched() && p.untouched() && v.untouched());
      for (uint32_t i = 0; i < n; ++i) {
        Surface<Value> wanted = surfaces.row(order[i]);
        if (turned)
          for (float* normal :
               {&wanted.ng_x, &wanted.ng_y, &wanted.ng_z, &wanted.ns_x, &wanted.ns_y, &wanted.ns_z})
            *normal = -*normal;
        for_each_field([&](auto, auto a, auto b) { EXPECT_EQ(a, b); }, s.row(i), wanted);
        for_each_field([&](auto, auto a, auto b) { EXPECT_EQ(a, b); }, p.row(i),
                       paths.row(order[i]));
        EXPECT_EQ(v[i], u[order[i]]);
      }
    }
  }
}

// ---- Light through veils -----------------------------------------------------------------------

// A point light of intensity 1 straight above a floor, 2 away: Kd / (4 pi) reaches the eye.
TEST_P(Split, PointLightThroughVeils) {
  const std::string veil =
      kBasics + mix("veil", "black", "hole", .3) + mix("half", "hole", "black", .5);
  const auto text = [&](const std::string& veils) {
    return view_text("2 -2 .3", "0 0 0", .02, 2, 2) + veil + use("grey") + shelf("0") + veils +
           "LightSource \"point\" \"point from\" [0 0 2]\nWorldEnd\n";
  };
  const double free = .5 / (4 * std::numbers::pi);
  expect_red(text(""), 1, 1, free);
  expect_red(text(use("veil") + shelf("1")), 1, 1, .3 * free);
  expect_red(text(use("half") + shelf("1") + use("veil") + shelf("1.5")), 1, 1, .15 * free);
  // A sphere is met once from outside when the light is in it, twice when it is between.
  expect_red(text(use("half") + sphere_text("0 0 2", .5)), 1, 1, .5 * free);
  expect_red(text(use("half") + sphere_text("0 0 1", .5) + use("black") + sphere_text("2 2 2", .5)),
             1, 1, .25 * free);
  expect_red(text(use("half") + "AttributeBegin\nTranslate 0 0 1\nShape \"plane\"\nAttributeEnd\n"),
             1, 1, .5 * free);
  // What is solid stays solid.
  EXPECT_EQ(see(text(use("half") + shelf("1") + use("black") + shelf("1.5")), 1, 1).mean.x, 0);
}

TEST_P(Split, PointLightThroughPanes) {
  const std::string below = quad_text("-3 -3 1", "-3 3 1", "3 3 1", "3 -3 1");  // outside down
  const auto text = [&](const std::string& panes) {
    return view_text("2 -2 .3", "0 0 0", .02, 2, 2) + kBasics + pane("pane", 1.5, .5) +
           mix("half", "black", "pane", .5) + use("grey") + shelf("0") + panes +
           "LightSource \"point\" \"point from\" [0 0 2]\nWorldEnd\n";
  };
  // What the pane reflects is taken where light enters by the outside: 1 - F (1 + (1 - F)^2).
  const double free = .5 / (4 * std::numbers::pi), enters = 1 - .04 * (1 + .96 * .96);
  expect_red(text(use("pane") + shelf("1")), 1, 1, .5 * enters * free);
  expect_red(text(use("pane") + below), 1, 1, .5 * free);
  expect_red(text(use("half") + shelf("1.5") + use("pane") + below), 1, 1, .125 * enters * free);
}

TEST_P(Split, AreaLightThroughAVeilInClosedForm) {
  // As Renders.LitPlaneByLambertsFormula: E = .752274688 without the veil. Light sampling and
  // directions that find the lamp each bring a part: both must be weakened alike.
  const std::string text =
      view_text("2 -2 .3", "0 0 0", .02, 2, 2) + kBasics + mix("veil", "black", "hole", .4) +
      use("grey") + quad_text("-5 -5 0", "5 -5 0", "5 5 0", "-5 5 0") + use("veil") + shelf(".7") +
      "AttributeBegin\n" + light_text("1 1 1") +
      quad_text("-.5 -.5 1", "-.5 .5 1", ".5 .5 1", ".5 -.5 1") + "AttributeEnd\nWorldEnd\n";
  expect_red(text, 128, 1, .4 * .5 / std::numbers::pi * 0.752274688);
  // The same by a pane that only tints, whose paths are chosen by its own sample().
  const std::string tint = view_text("2 -2 .3", "0 0 0", .02, 2, 2) + kBasics +
                           pane("tint", 1, .4) + text.substr(text.find(use("grey")));
  std::string by_pane = tint;
  by_pane.replace(by_pane.find(use("veil")), use("veil").size(), use("tint"));
  expect_red(by_pane, 128, 1, .4 * .5 / std::numbers::pi * 0.752274688);
}

TEST_P(Split, EachCrossingDecidesAnew) {
  // A lamp seen through veils, by the eye and by a mirror: .5 for each crossing, at any depth.
  const auto text = [](const std::string& veils) {
    return view_text("0 -3 0", "0 0 0", 4, 8, 8) + kBasics + mix("half", "black", "hole", .5) +
           veils + use("black") + "AttributeBegin\n" + light_text("1 1 1") +
           quad_text("-2 2 -2", "2 2 -2", "2 2 2", "-2 2 2") + "AttributeEnd\nWorldEnd\n";
  };
  const auto upright = [](const std::string& y) {
    return quad_text("-2 " + y + " -2", "2 " + y + " -2", "2 " + y + " 2", "-2 " + y + " 2");
  };
  // Outwards light is not weakened; what is reflected, a fourth, comes from the dark.
  const std::string strong = pane("strong", 3, 1) + use("strong");
  for (const uint32_t depth : {0u, 3u}) {
    expect_red(text(strong + upright("0") + upright(".5") + upright("1")), 64, depth, 1);
    expect_red(text(use("half") + upright("0")), 64, depth, .5);
    expect_red(text(use("half") + upright("0") + upright(".5") + upright("1")), 256, depth, .125);
  }
}

TEST_P(Split, VeilsInObjects) {
  const auto text = [](const std::string& objects) {
    return view_text("2 -2 .3", "0 0 0", .02, 2, 2) + kBasics + mix("half", "black", "hole", .5) +
           use("grey") + shelf("0") + "AttributeBegin\n" + objects +
           "AttributeEnd\nLightSource \"point\" \"point from\" [0 0 2]\nWorldEnd\n";
  };
  const double free = .5 / (4 * std::numbers::pi);
  const std::string twice =
      "ObjectInstance \"o\"\nTranslate 0 0 .5\nObjectInstance \"o\"\nTranslate 0 0 7\n";
  expect_red(
      text("ObjectBegin \"o\"\n" + use("half") + shelf("1") + "ObjectEnd\n" + use("half") + twice),
      1, 1, .25 * free);
  // An instance's material replaces the object's: one veil, one hole.
  expect_red(text("ObjectBegin \"o\"\n" + use("black") + shelf("1") + "ObjectEnd\n" + use("half") +
                  "ObjectInstance \"o\"\n" + use("hole") + twice),
             1, 1, .5 * free);
}

// ---- Which material ----------------------------------------------------------------------------

/// What a floor of a material shows of a point light 2 above it, by pi: its Kd / 4.
std::string floor_text(const std::string& materials, const std::string& name,
                       const std::string& floor) {
  return view_text("1 -1 .5", "0 0 0", .02, 8, 8) + kBasics + materials + use(name) + floor +
         "LightSource \"point\" \"point from\" [0 0 2]\nWorldEnd\n";
}

TEST_P(Split, MixturesByTheirShares) {
  const std::string text =
      floor_text(mix("inner", "red", "green", .25) + mix("outer", "inner", "blue", .5) +
                     mix("most", "outer", "black", .125),
                 "most", shelf("0"));
  const glm::dvec3 seen = see(text, 64, 1).mean * (4 * std::numbers::pi);
  const glm::dvec3 exact = .875 * glm::dvec3(.5 * .75 * .8, .5 * .25 * .6, .5 * .4);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], exact[k], .01 * exact[k]);
}

TEST_P(Split, UnequalChildrenBringTheirShares) {
  // Each brings its share, however often it is chosen.
  const std::string dark = named("dark", "[\"matte\"] \"color Kd\" [.02 .02 .02]");
  const auto text = [&](const std::string& materials) {
    return floor_text(dark + materials, "m", shelf("0"));
  };
  const double free = 1 / (4 * std::numbers::pi);
  expect_red(text(mix("m", "dark", "red", .5)), 64, 1, .5 * .82 * free);
  expect_red(text(mix("m", "red", "dark", .875)), 64, 1, (.125 * .8 + .875 * .02) * free);
  expect_red(text(mix("inner", "dark", "red", .25) + mix("m", "inner", "dark", .5)), 64, 1,
             (.875 * .02 + .125 * .8) * free);
  // The same where a veil is chosen for what it lets pass: the floor below is grey.
  const std::string veiled = view_text("2 -2 4", "0 0 0", .02, 2, 2) + kBasics + dark +
                             mix("veil", "dark", "hole", .5) + use("grey") + shelf("0") +
                             use("veil") + shelf("1") +
                             "LightSource \"distant\" \"point from\" [0 0 1] \"point to\" "
                             "[0 0 0]\nWorldEnd\n";
  expect_red(veiled, 256, 1, (.5 * .02 + .25 * .5) / std::numbers::pi);
}

TEST_P(Split, AmountsOfNothingAndAllAreTheMaterialItself) {
  const auto bins = [&](double amount) {
    return compile_text(floor_text(mix("m", "red", "green", amount), "m", shelf("0")), kernels())
        .bins;
  };
  EXPECT_EQ(bins(0)[1].material, MaterialKind::kMatte);
  EXPECT_EQ(bins(1)[1].material, MaterialKind::kMatte);
  EXPECT_EQ(bins(.5)[1].material, MaterialKind::kMix);
}

TEST_P(Split, SidesHaveTheirMaterials) {
  const std::string below = quad_text("-3 -3 0", "-3 3 0", "3 3 0", "3 -3 0");  // outside down
  const auto kd = [&](const std::string& materials, const std::string& name,
                      const std::string& floor) {
    return see(floor_text(materials, name, floor), 1, 1).mean * (4 * std::numbers::pi);
  };
  const std::string two = double_side("two", "red", "green");
  EXPECT_NEAR(kd(two, "two", shelf("0")).x, .8, 1e-5);
  EXPECT_EQ(kd(two, "two", shelf("0")).y, 0);
  EXPECT_NEAR(kd(two, "two", below).y, .6, 1e-5);
  EXPECT_EQ(kd(two, "two", below).x, 0);
  // A child with sides of its own: the flags say which of them is looked at.
  const auto nested = [&](const std::string& flags) {
    return two + double_side("nested", "two", "two", flags);
  };
  const std::string front = "\"bool usefrontforfront\" [\"false\"]",
                    back = "\"bool usefrontforback\" [\"false\"]";
  EXPECT_NEAR(kd(nested(""), "nested", shelf("0")).x, .8, 1e-5);
  EXPECT_NEAR(kd(nested(""), "nested", below).x, .8, 1e-5);
  EXPECT_NEAR(kd(nested(front), "nested", shelf("0")).y, .6, 1e-5);
  EXPECT_NEAR(kd(nested(back), "nested", below).y, .6, 1e-5);
}

TEST_P(Split, ACoatOverMatteIsGlossy) {
  const std::string coat =
      "\"float index\" [1.7] \"color Ka\" [.3 .6 .9] \"float d\" [.5] \"float uroughness\" [.3] "
      "\"float vroughness\" [.4]";
  const std::string glossy = named("m", "[\"glossy\"] \"color Kd\" [.5 .5 .5] " + coat);
  const auto seen = [&](const std::string& material, const std::string& floor) {
    return see(view_text("2 -2 .8", "0 0 0", 6, 8, 8) + kBasics + material + use("m") + floor +
                   use("black") + "AttributeBegin\n" + light_text("1 1 1") +
                   quad_text("-1 1 1", "-1 2 1", "1 2 1", "1 1 1") + "AttributeEnd\nWorldEnd\n",
               64, 1)
        .red;
  };
  for (const std::string& floor : {shelf("0"), quad_text("-3 -3 0", "-3 3 0", "3 3 0", "3 -3 0")}) {
    const Estimate a = seen(glossy, floor), b = seen(coating("m", "grey", coat), floor);
    EXPECT_LE(std::fabs(a.mean - b.mean), 3.5 * std::hypot(a.error, b.error))
        << a.mean << " +- " << a.error << " as glossy, " << b.mean << " +- " << b.error;
    EXPECT_LE(std::hypot(a.error, b.error), .01 * a.mean) << "too noisy to say anything";
  }
}

TEST_P(Split, ACoatKeepsWhatItTakesFromItsBase) {
  // In a furnace a rough coat over white may not bring more than it gets; it loses little.
  const std::string text = view_text("0 -1.5 0", "0 0 0", .01, 2, 2) + kBasics +
                           named("white", "[\"matte\"] \"color Kd\" [1 1 1]") +
                           coating("m", "white",
                                   "\"float index\" [1.5] \"float uroughness\" [.2] "
                                   "\"float vroughness\" [.2]") +
                           "AttributeBegin\n" + light_text("1 1 1") + use("black") + room_text(3) +
                           "AttributeEnd\n" + use("m") +
                           quad_text("-2 0 -2", "2 0 -2", "2 0 2", "-2 0 2") + "WorldEnd\n";
  const Estimate red = see(text, 256, 1).red;
  EXPECT_LE(red.mean, 1 + 3.5 * red.error);
  EXPECT_GE(red.mean, .95 - 3.5 * red.error);
}

TEST_P(Split, OneWayHolesForLight) {
  // A shelf with a hole on one side: light comes from above, shadow rays from below.
  const auto text = [](const std::string& front, const std::string& back) {
    return view_text("2 -2 .3", "0 0 0", .02, 2, 2) + kBasics + double_side("valve", front, back) +
           use("grey") + shelf("0") + use("valve") + shelf("1") +
           "LightSource \"point\" \"point from\" [0 0 2]\nWorldEnd\n";
  };
  expect_red(text("black", "hole"), 1, 1, .5 / (4 * std::numbers::pi));
  EXPECT_EQ(see(text("hole", "black"), 1, 1).mean.x, 0);
}

// ---- Whole scenes ------------------------------------------------------------------------------

/// Names of the materials in a room: its floor, three balls, a wall behind them, a sheet above
/// them, a pane before them, and the lamp.
struct RoomMaterials {
  std::string floor, balls[3], wall, sheet, pane, lamp;
};
/// A room under a lamp and a point. materials: their statements, beside kBasics.
std::string room_of(const std::string& materials, const RoomMaterials& m, uint32_t width = 24,
                    uint32_t height = 16) {
  return view_text("0 -2.6 .3", "0 0 -.2", 50, width, height) + kBasics + materials + use(m.floor) +
         shelf("-1") + use(m.balls[0]) + sphere_text("-.6 0 -.6", .35) + use(m.balls[1]) +
         sphere_text("0 .2 -.6", .35) + use(m.balls[2]) + sphere_text("0.7 0 -.6", .3) +
         use(m.wall) + quad_text("-1 1 -1", "1 1 -1", "1 1 1", "-1 1 1") + use(m.sheet) +
         quad_text("-1 -.5 .3", "1 -.5 .3", "1 .5 .5", "-1 .5 .5") + use(m.pane) +
         quad_text("-.5 -1 -.9", ".3 -1 -.9", ".3 -1 -.4", "-.5 -1 -.4") + "AttributeBegin\n" +
         light_text("9 8 7") + use(m.lamp) +
         quad_text("-.4 -.4 1", "-.4 .4 1", ".4 .4 1", ".4 -.4 1") +
         "AttributeEnd\nLightSource \"point\" \"point from\" [-.8 -.9 .8]\nWorldEnd\n";
}

std::string veiled_room(uint32_t width, uint32_t height) {
  return room_of(
      named("glass", "[\"glass\"]") +
          named("sheet", "[\"mattetranslucent\"] \"color Kr\" [.4 .3 .2] \"color Kt\" [.3 .5 .2]") +
          mix("veil", "red", "hole", .6) + mix("shiny", "sheet", "mirror", .3) +
          mix("odd", "veil", "shiny", .5) + double_side("valve", "odd", "glass"),
      {"grey", {"veil", "odd", "valve"}, "shiny", "veil", "veil", "veil"}, width, height);
}

std::string coated_room() {
  const std::string coat =
      "\"color Ks\" [.3 .2 .1] \"color Ka\" [.3 .6 .9] \"float d\" [.3] "
      "\"float uroughness\" [.3] \"float vroughness\" [.3]";
  return room_of(
      pane("pane", 1.5, .8) +
          named("metal", "[\"metal\"] \"float uroughness\" [.4] \"float vroughness\" [.4]") +
          named("sheet", "[\"mattetranslucent\"] \"color Kr\" [.4 .3 .2] \"color Kt\" [.3 .5 .2]") +
          mix("some", "red", "mirror", .4) + mix("dusty", "pane", "grey", .3) +
          double_side("sides", "red", "green") + coating("over metal", "metal", coat) +
          coating("over sheet", "sheet", coat) + coating("over some", "some", coat) +
          coating("over sides", "sides", coat),
      {"grey", {"over metal", "over some", "over sides"}, "over sheet", "dusty", "pane", "black"});
}

/// Mixtures whose children give back unlike amounts of light, one of them by a texture's amount.
std::string unequal_room() {
  const std::string coat =
      "\"color Ks\" [.1 .1 .1] \"float uroughness\" [.3] \"float vroughness\" [.3]";
  return room_of(
      "Texture \"squares\" \"float\" \"checkerboard\" \"float tex1\" [.2] \"float tex2\" [.9] "
      "\"float uscale\" [4] \"float vscale\" [4]\n" +
          named("dark", "[\"matte\"] \"color Kd\" [.02 .06 .04]") +
          named("gold",
                "[\"metal\"] \"string name\" [\"gold\"] \"float uroughness\" [.4] \"float "
                "vroughness\" [.4]") +
          named("varied",
                "[\"mix\"] \"string namedmaterial1\" [\"dark\"] \"string namedmaterial2\" "
                "[\"gold\"] \"texture amount\" [\"squares\"]") +
          mix("two", "dark", "red", .4) + mix("three", "two", "mirror", .3) +
          mix("veil", "dark", "hole", .5) + coating("coated", "dark", coat) +
          coating("coated mixture", "two", coat),
      {"two", {"varied", "coated", "coated mixture"}, "three", "veil", "veil", "black"});
}

/// Of random numbers of one kind, path by path.
void expect_agreement(const std::string& text, const KernelTable& kernels, SamplerKind sampler) {
  const Scene scene = compile_text(text, kernels);
  PlanOptions options;
  options.sampler = sampler;
  options.max_depth = 5;
  options.seed = 3;
  EXPECT_GT(agreement(scene, make_plan(scene, kernels, options), 8, 1e-2), .97);
}

TEST_P(Split, PathsAgreeWithTheReference) {
  for (const SamplerKind sampler : {SamplerKind::kSobol, SamplerKind::kIndependent})
    expect_agreement(veiled_room(24, 16), kernels(), sampler);
}

TEST_P(Split, CoatsAndPanesAgreeWithTheReference) {
  expect_agreement(coated_room(), kernels(), SamplerKind::kSobol);
}

TEST_P(Split, UnequalChildrenAgreeWithTheReference) {
  for (const SamplerKind sampler : {SamplerKind::kSobol, SamplerKind::kIndependent})
    expect_agreement(unequal_room(), kernels(), sampler);
}

TEST_P(Split, SameBitsForEveryBatch) {
  const Scene scene = compile_text(veiled_room(48, 32), kernels());
  PlanOptions options;
  options.max_depth = 6;
  const Plan plan = make_plan(scene, kernels(), options);
  const Film film = render_film(scene, plan, 0, 4);
  EXPECT_TRUE(same_bits(film, render_film(scene, plan, 0, 4, 2)));
  EXPECT_TRUE(same_bits(film, render_film(scene, plan, 0, 4, 1, 100, 8)));
}

}  // namespace
}  // namespace yat
