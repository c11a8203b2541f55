// The light tree, and the choice by it, built here for one instruction set, against double
// precision.

#include <cmath>
#include <cstring>

#include "chi2.h"
#include "kernels/light_choice.h"
#include "many_lights.h"
#include "wavefront/reference_parts.h"

namespace yat::YAT_ISA {
namespace {

using A = NativeArch;
using reference::Receiver;
using reference::Vec;

struct Numbers {
  std::mt19937 engine{5};
  float unit() { return float(engine() >> 8) * 0x1p-24f; }
  double symmetric() { return 2 * double(unit()) - 1; }
  Vec point(double size) { return size * Vec(symmetric(), symmetric(), symmetric()); }
  Vec direction() {
    for (;;) {
      const Vec v = point(1);
      if (const double l = glm::length(v); l > .1 && l < 1) return v / l;
    }
  }
};

Vec rounded(const Vec& v) {
  return {float(v.x), float(v.y), float(v.z)};
}
Vec3<A> spread(const Vec& v) {
  return {Float<A>(float(v.x)), Float<A>(float(v.y)), Float<A>(float(v.z))};
}

const KernelTable& some_kernels() {
  return *built_isas().front().table();
}

/// Scenes with and without lights that have no place.
std::vector<Scene> scenes() {
  std::vector<Scene> all;
  for (const std::string& more : {std::string(), other_lights_text()})
    all.push_back(
        compile_lamps(lamp_room_text(8, 8, 150, more), some_kernels(), LightChoosing::kTree));
  return all;
}

/// In the room, on lamps, outside, far away and farther than the tree reaches.
std::vector<Vec> receivers(const Scene& scene, Numbers& numbers) {
  std::vector<Vec> points;
  for (int i = 0; i < 40; ++i) points.push_back(numbers.point(1));
  for (uint32_t i = 0; i < 20; ++i) {
    const LightRow<Value> row = scene.lights.row(i);
    points.push_back({row.a_x, row.a_y, row.a_z});
  }
  for (const double size : {5., 1e3, 1e6, 1e20, 1e38}) points.push_back(numbers.point(size));
  for (Vec& p : points) p = rounded(p);
  return points;
}

Float<A> nominal_of(const SceneView& view, const Vec& receiver, uint32_t light) {
  const UInt<A> row(light);
  return chance_of_light<A, true>(view.lights, row, gather<A>(view.lights.rows, row),
                                  spread(receiver), tail_mask<A>(0, kLanes<A>));
}

TEST(LightTree, ChancesAreThoseOfDoublePrecisionAndAddUpToOne) {
  Numbers numbers;
  for (const Scene& scene : scenes()) {
    const SceneView view = scene.view();
    for (const Vec& p : receivers(scene, numbers)) {
      double sum = 0;
      for (uint32_t light = 0; light < scene.lights.size(); ++light) {
        const auto chance = double(nominal_of(view, p, light).get(0));
        const double expected = reference::nominal_chance(scene, p, light);
        EXPECT_NEAR(chance, expected, 2e-4 * expected) << "light " << light;
        EXPECT_GT(chance, 0) << "light " << light;
        sum += chance;
      }
      EXPECT_NEAR(sum, 1, 1e-5);
    }
  }
}

LitPoint<A> lit_point(const SceneView& view, const Receiver& receiver) {
  return {LitPoint<A>::to_tree(view.lights.tree, spread(receiver.position)), spread(receiver.up),
          Float<A>(receiver.all_around ? 1.f : kLeastCosine)};
}

TEST(LightTree, LightsAreChosenAsOftenAsTheirChanceSays) {
  Numbers numbers;
  constexpr int kTests = 8, kDraws = 1 << 15;
  for (const Scene& scene : scenes()) {
    const SceneView view = scene.view();
    const uint32_t lights = scene.lights.size();
    for (int test = 0; test < kTests; ++test) {
      const Receiver receiver{rounded(numbers.point(1)), rounded(numbers.direction()),
                              test % 2 == 1};
      std::vector<double> seen(lights, 0.), expected(lights);
      double sum = 0;
      for (uint32_t light = 0; light < lights; ++light) {
        const double chance = reference::chance_of_light(scene, receiver, light);
        sum += chance;
        expected[light] = chance * kDraws;
      }
      EXPECT_NEAR(sum, 1, 1e-7);  // Rows hold floats.
      const LitPoint<A> lit = lit_point(view, receiver);
      const Mask<A> all = tail_mask<A>(0, kLanes<A>);
      for (uint32_t draw = 0; draw < kDraws; draw += kLanes<A>) {
        alignas(64) float u[kLanes<A>];
        for (float& x : u) x = numbers.unit();
        const ChosenLight<A> chosen =
            choose_light_by_tree<A>(view.lights, lit, all, Float<A>::load_aligned(u));
        for (uint32_t lane = 0; lane < kLanes<A>; ++lane) {
          const uint32_t light = chosen.row.get(lane);
          ASSERT_LT(light, lights);
          ++seen[light];
          if (draw > 1024) continue;
          // What the choice says of itself, and what the other side of the weights will say.
          const double own = double(chosen.chance.get(lane)) *
                             double(scene.lights.row(light).probability) * kDraws;
          EXPECT_NEAR(own, expected[light], 1e-4 * expected[light]) << "light " << light;
          EXPECT_EQ(chosen.nominal.get(lane) * scene.lights.row(light).probability,
                    nominal_of(view, receiver.position, light).get(0));
          const reference::LightChance precise = reference::choose_light(scene, receiver, u[lane]);
          if (precise.light == light) {
            EXPECT_NEAR(precise.chance * kDraws, own, 1e-4 * own);
          }
        }
      }
      // Twice 8 tests at this level: all pass with probability 99 %.
      EXPECT_GT(chi2_p_value(seen, expected), 6e-4) << "test " << test;
    }
  }
}

// The last number below one, and the first: always a light of the scene.
TEST(LightTree, ExtremeNumbersChooseALight) {
  Numbers numbers;
  for (const Scene& scene : scenes()) {
    const SceneView view = scene.view();
    for (const Vec& p : receivers(scene, numbers))
      for (const float u : {0.f, 1 - 0x1p-24f, .5f}) {
        const ChosenLight<A> chosen = choose_light_by_tree<A>(
            view.lights, lit_point(view, {p, {0, 0, 1}, false}), tail_mask<A>(0, 1), Float<A>(u));
        EXPECT_LT(chosen.row.get(0), scene.lights.size());
        EXPECT_GT(chosen.chance.get(0), 0.f);
        for (uint32_t lane = 1; lane < kLanes<A>; ++lane)
          EXPECT_LT(chosen.row.get(lane), scene.lights.size());
      }
  }
}

// ---- Building ----------------------------------------------------------------------------------

LightBound lamp(const Vec& center, double radius, const Vec& axis, double intensity) {
  return {center, radius, axis, false, intensity};
}

struct Half {
  Vec center;
  double radius, intensity, chord;
  Vec axis;
  uint32_t child;
};
Half half_of(const LightNode<Value>& n, bool right) {
  Half h{right ? Vec(n.r_x, n.r_y, n.r_z) : Vec(n.l_x, n.l_y, n.l_z),
         right ? n.r_radius : n.l_radius,
         right ? n.r_intensity : n.l_intensity,
         right ? n.r_chord : n.l_chord,
         Vec(0.),
         right ? n.r_child : n.l_child};
  const uint32_t word = right ? n.r_axis : n.l_axis;
  for (int k = 0; k < 3; ++k) h.axis[k] = (int32_t(word << (22 - 10 * k)) >> 22) / 511.;
  return h;
}

/// Every light is where its trail leads, and within the bounds of all nodes on the way.
void expect_sound(const std::vector<LightBound>& lights, double scale, const LightTree& tree) {
  double total = 0;
  for (const LightBound& light : lights) total += light.intensity;
  EXPECT_LE(tree.depth, 32u);
  ASSERT_EQ(tree.nodes.size(), lights.size() - 1);
  std::vector<double> sums(2 * tree.nodes.size(), 0.), wanted(2 * tree.nodes.size());
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const LightBound& light = lights[i];
    uint32_t at = 0, level = 0;
    for (uint32_t trail = tree.trail[i]; !(at >> 31); trail >>= 1) {
      ASSERT_LT(level++, tree.depth);
      const Half half = half_of(tree.nodes.row(at), trail & 1);
      // Floats round the centre.
      const double slack = 1e-6 * (glm::length(half.center) + half.radius);
      EXPECT_LE(glm::length(half.center - scale * light.center) + scale * light.radius,
                half.radius + slack);
      EXPECT_LE(glm::length(half.axis - light.axis), half.chord);
      sums[2 * at + (trail & 1)] += light.intensity / total;
      wanted[2 * at + (trail & 1)] = half.intensity;
      at = half.child;
    }
    EXPECT_EQ(at & 0x7fffffffu, i);
  }
  for (size_t i = 0; i < sums.size(); ++i) EXPECT_NEAR(sums[i], wanted[i], 1e-6 * sums[i] + 1e-44);
}

std::vector<LightBound> random_lamps(uint32_t count) {
  Numbers numbers;
  std::vector<LightBound> lights;
  for (uint32_t i = 0; i < count; ++i)
    lights.push_back(lamp(numbers.point(3), .01, numbers.direction(), .1 + double(numbers.unit())));
  return lights;
}

TEST(LightTree, HoldsEveryLightWithinItsBounds) {
  ThreadPool pool(1);
  std::vector<LightBound> one_place, line, powers;
  for (uint32_t i = 0; i < 1000; ++i) {
    one_place.push_back(lamp({1, 2, 3}, 0, {0, 0, 1}, 1));
    line.push_back(lamp({double(i), 0, 0}, .5, {1, 0, 0}, 1 + i % 7));
    powers.push_back(
        lamp({std::pow(2., -double(i)), 0, 0}, 0, {0, 1, 0}, std::pow(4., -double(i))));
  }
  for (const auto& lights :
       {random_lamps(2), random_lamps(3), random_lamps(3000), one_place, line, powers})
    for (const double scale : {1., 1e-3, 1e15})
      expect_sound(lights, scale, build_light_tree(lights, scale, pool));
}

TEST(LightTree, IsTheSameForAnyNumberOfThreads) {
  const std::vector<LightBound> lights = random_lamps(30000);
  ThreadPool one(1), many(4);
  const LightTree a = build_light_tree(lights, 1, one), b = build_light_tree(lights, 1, many);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(std::memcmp(a.nodes.view().words, b.nodes.view().words,
                        size_t(a.nodes.size()) * row_words<LightNode> * 4),
            0);
  for (uint32_t i = 0; i < lights.size(); ++i) ASSERT_EQ(a.trail[i], b.trail[i]);
}

TEST(LightTree, LightsWithoutAPlaceComeLastAndHaveAShare) {
  const Scene scene = compile_lamps(lamp_room_text(8, 8, 20, other_lights_text()), some_kernels(),
                                    LightChoosing::kTree);
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    const auto kind = LightKind(scene.lights.row(i).kind);
    const bool far = kind == LightKind::kDistant || uint32_t(kind) >= kFirstEnvironment;
    EXPECT_EQ(i >= scene.first_far_light, far) << i;
    EXPECT_EQ(i >= scene.first_environment, uint32_t(kind) >= kFirstEnvironment) << i;
  }
  EXPECT_EQ(scene.lights.size() - scene.first_far_light, 2u);
  EXPECT_EQ(scene.light_choice.size(), 2u);
  double near = 0;
  for (uint32_t i = 0; i < scene.first_far_light; ++i)
    near += reference::nominal_chance(scene, {0, 0, 0}, i);
  EXPECT_GT(near, double(kLeastShare) - 1e-6);
  EXPECT_LT(near, 1 - double(kLeastShare) + 1e-6);
}

}  // namespace
}  // namespace yat::YAT_ISA
