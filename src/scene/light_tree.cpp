#include "scene/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace yat {

namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;
constexpr uint32_t kBins = 16;
/// A trail has a bit per level.
constexpr uint32_t kMaxDepth = 32;
/// Sets of this many lights are worth a task of their own.
constexpr uint32_t kTaskLights = 8192;

struct Box {
  dvec3 low{INFINITY}, high{-INFINITY};
  void add(const dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  dvec3 size() const { return high - low; }
};

/// Directions within `angle` of an axis; angle < 0: none.
struct Cone {
  dvec3 axis{0, 0, 1};
  double angle = -1;
};

/// A cone about two: Conty Estevez and Kulla 2018, algorithm 1.
Cone join(const Cone& a, const Cone& b) {
  if (a.angle < 0) return b;
  if (b.angle < 0) return a;
  const Cone &wide = a.angle < b.angle ? b : a, &slim = a.angle < b.angle ? a : b;
  const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1., 1.));
  if (std::min(between + slim.angle, kPi) <= wide.angle) return wide;
  const double angle = (wide.angle + between + slim.angle) / 2;
  const dvec3 across = slim.axis - glm::dot(slim.axis, wide.axis) * wide.axis;
  const double length = glm::length(across);
  if (angle >= kPi || !(length > 0)) return {wide.axis, kPi};
  const double turn = angle - wide.angle;
  return {std::cos(turn) * wide.axis + std::sin(turn) / length * across, angle};
}

/// Measure of the directions into which lights with normals in the cone shine, weighted by cosines.
double spread(const Cone& cone) {
  const double o = std::max(cone.angle, 0.), w = std::min(o + kPi / 2, kPi);
  return 2 * kPi * (1 - std::cos(o)) +
         kPi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

struct Part {
  Box box;
  Cone cone;
  double intensity = 0;
  uint32_t count = 0;
  void add(const Part& p) {
    box.add(p.box);
    cone = join(cone, p.cone);
    intensity += p.intensity;
    count += p.count;
  }
  /// The diagonal stands for the area: lights often lie on a plane or a line.
  double cost() const {
    const dvec3 d = box.size();
    return count ? intensity * glm::dot(d, d) * spread(cone) : 0;
  }
};

/// Half of a node's row.
struct Child {
  dvec3 center;
  double radius, intensity;
  uint32_t axis;
  double chord;
  uint32_t child;
};

uint32_t pack_axis(const dvec3& axis, dvec3& packed) {
  uint32_t word = 0;
  for (int k = 0; k < 3; ++k) {
    const auto number = int32_t(std::lround(axis[k] * 511));
    packed[k] = number / 511.;
    word |= (uint32_t(number) & 0x3ffu) << (10 * k);
  }
  return word;
}

class Builder {
 public:
  Builder(std::span<const LightBound> lights, double scale, LightTree& tree)
      : lights_(lights), scale_(scale), tree_(tree), order_(lights.size()), depths_(lights.size()) {
    for (uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
    double total = 0;
    for (const LightBound& light : lights) total += light.intensity;
    share_ = total > 0 && std::isfinite(1 / total) ? 1 / total : 0;
  }

  void build() {
    const auto n = uint32_t(lights_.size());
    tree_.nodes.resize(n - 1);
    tree_.trail.resize(n);
    split(0, n, 0, 0, 0);
    tree_.depth = *std::max_element(depths_.begin(), depths_.end());
  }

 private:
  /// Lights order_[begin, end), at least two, become node `node` and the end - begin - 2 after it.
  void split(uint32_t begin, uint32_t end, uint32_t node, uint32_t level, uint32_t trail) {
    const uint32_t middle = divide(begin, end, level), right_node = node + (middle - begin);
    const Child left = child_of(begin, middle, node + 1), right = child_of(middle, end, right_node);
    LightNode<Value> row{};
    const auto set = [](const Child& from, float& x, float& y, float& z, float& radius,
                        float& intensity, uint32_t& axis, float& chord, uint32_t& child) {
      x = float(from.center.x);
      y = float(from.center.y);
      z = float(from.center.z);
      radius = std::nextafter(float(from.radius), INFINITY);
      intensity = float(from.intensity);
      axis = from.axis;
      chord = std::nextafter(float(from.chord), INFINITY);
      child = from.child;
    };
    set(left, row.l_x, row.l_y, row.l_z, row.l_radius, row.l_intensity, row.l_axis, row.l_chord,
        row.l_child);
    set(right, row.r_x, row.r_y, row.r_z, row.r_radius, row.r_intensity, row.r_axis, row.r_chord,
        row.r_child);
    tree_.nodes.set(node, row);
    const auto go_on = [&](uint32_t from, uint32_t to, uint32_t next, uint32_t bit) {
      const uint32_t way = trail | bit << level;
      if (to - from > 1) {
        split(from, to, next, level + 1, way);
      } else {
        tree_.trail[order_[from]] = way;
        depths_[order_[from]] = level + 1;
      }
    };
    if (end - begin > kTaskLights)
      parallel_invoke([&] { go_on(begin, middle, node + 1, 0); },
                      [&] { go_on(middle, end, right_node, 1); });
    else {
      go_on(begin, middle, node + 1, 0);
      go_on(middle, end, right_node, 1);
    }
  }

  Part part_of(uint32_t i) const {
    const LightBound& light = lights_[i];
    Part part;
    part.box.add(light.center - light.radius);
    part.box.add(light.center + light.radius);
    part.cone = {light.axis, light.everywhere ? kPi : 0};
    part.intensity = light.intensity;
    part.count = 1;
    return part;
  }

  /// Puts the lights in the order of the cheapest split and returns where the right part begins.
  uint32_t divide(uint32_t begin, uint32_t end, uint32_t level) {
    const uint32_t n = end - begin, half = begin + n / 2;
    if (n == 2) return half;
    Box centers;
    for (uint32_t i = begin; i < end; ++i) centers.add(lights_[order_[i]].center);
    const dvec3 size = centers.size();
    const double widest = std::max({size.x, size.y, size.z});
    // What is left of the trail must do for halves.
    const bool deep = level + 2 + uint32_t(std::bit_width(n)) >= kMaxDepth;
    double best = INFINITY;
    int best_axis = -1;
    uint32_t best_bin = 0;
    const auto bin_of = [&](int axis, uint32_t light) {
      const double place = (lights_[light].center[axis] - centers.low[axis]) / size[axis];
      return std::min(uint32_t(place * kBins), kBins - 1);
    };
    for (int axis = 0; axis < 3 && !deep; ++axis) {
      if (!(size[axis] > 0)) continue;
      std::array<Part, kBins> bins;
      for (uint32_t i = begin; i < end; ++i) bins[bin_of(axis, order_[i])].add(part_of(order_[i]));
      std::array<double, kBins> left_cost{};
      std::array<uint32_t, kBins> left_count{};
      Part part;
      for (uint32_t b = 0; b + 1 < kBins; ++b) {
        part.add(bins[b]);
        left_cost[b] = part.cost();
        left_count[b] = part.count;
      }
      part = {};
      for (uint32_t b = kBins - 1; b > 0; --b) {
        part.add(bins[b]);
        // Slim parts are dear: they are seen as one from nowhere but their ends.
        const double cost = (left_cost[b - 1] + part.cost()) * widest / size[axis];
        if (left_count[b - 1] && part.count && cost < best) {
          best = cost;
          best_axis = axis;
          best_bin = b;
        }
      }
    }
    if (best_axis >= 0)
      return uint32_t(
          std::partition(order_.begin() + begin, order_.begin() + end,
                         [&](uint32_t light) { return bin_of(best_axis, light) < best_bin; }) -
          order_.begin());
    // All in one place, or the trail is nearly full: halves along the widest axis.
    const int axis = size.x == widest ? 0 : size.y == widest ? 1 : 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) {
                       const double x = lights_[a].center[axis], y = lights_[b].center[axis];
                       return x != y ? x < y : a < b;
                     });
    return half;
  }

  Child child_of(uint32_t begin, uint32_t end, uint32_t node) const {
    Box box;
    dvec3 axis(0.);
    double intensity = 0;
    bool everywhere = false;
    for (uint32_t i = begin; i < end; ++i) {
      const LightBound& light = lights_[order_[i]];
      box.add(light.center - light.radius);
      box.add(light.center + light.radius);
      axis += light.intensity * share_ * light.axis;
      intensity += light.intensity * share_;
      everywhere = everywhere || light.everywhere;
    }
    Child child;
    const dvec3 center =
        end - begin == 1 ? lights_[order_[begin]].center : (box.low + box.high) / 2.;
    child.center = scale_ * center;
    child.intensity = intensity;
    child.child = end - begin == 1 ? 0x80000000u | order_[begin] : node;
    // By the largest component first: squares of dim lights' parts may be too small for a double.
    const double largest = std::max({std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)});
    dvec3 packed;
    child.axis = pack_axis(largest > 0 ? glm::normalize(axis / largest) : dvec3(0, 0, 1), packed);
    child.radius = child.chord = 0;
    for (uint32_t i = begin; i < end; ++i) {
      const LightBound& light = lights_[order_[i]];
      child.radius =
          std::max(child.radius, scale_ * (glm::length(light.center - center) + light.radius));
      child.chord = std::max(child.chord, glm::length(light.axis - packed));
    }
    if (everywhere) child.chord = 2;
    return child;
  }

  std::span<const LightBound> lights_;
  const double scale_;
  LightTree& tree_;
  std::vector<uint32_t> order_, depths_;
  double share_ = 0;
};

/// A disk shines to one side; other analytic shapes are taken to shine to all.
LightBound shape_bound(const ShapeRow<Value>& shape, double luminance, double area) {
  const dvec3 center(shape.org_x, shape.org_y, shape.org_z);
  const bool disk = ShapeKind(shape.kind) == ShapeKind::kDisk;
  // The normal goes by the transpose of the map from the scene: its last row.
  const dvec3 normal = glm::normalize(dvec3(shape.o_zx, shape.o_zy, shape.o_zz));
  return {center, shape.radius, (shape.inward ? -1. : 1.) * normal, !disk,
          luminance * area / (disk ? 1 : 2)};
}

}  // namespace

std::optional<LightBound> light_bound(const LightRow<Value>& light, double luminance,
                                      const RowTable<ShapeRow>& shapes) {
  const dvec3 a(light.a_x, light.a_y, light.a_z), b(light.b_x, light.b_y, light.b_z),
      c(light.c_x, light.c_y, light.c_z);
  const auto extra = double(light.extra);
  const auto point = [&](double intensity) { return LightBound{a, 0, {0, 0, 1}, true, intensity}; };
  switch (LightKind(light.kind)) {
    case LightKind::kTriangle:
    case LightKind::kRectangle: {
      const bool rectangle = LightKind(light.kind) == LightKind::kRectangle;
      const dvec3 center = a + (b + c) / (rectangle ? 2. : 3.);
      const double radius = std::max(
          {glm::length(a - center), glm::length(a + b - center), glm::length(a + c - center)});
      const dvec3 normal = glm::normalize(glm::cross(b / radius, c / radius));
      const bool usable = std::isfinite(glm::dot(normal, normal));
      return LightBound{center, radius, usable ? normal : dvec3(0, 0, 1), !usable,
                        luminance * extra};
    }
    case LightKind::kSphere:
      return LightBound{a, extra, {0, 0, 1}, true, luminance * kPi * extra * extra};
    case LightKind::kShape:
      return shape_bound(shapes.row(std::bit_cast<uint32_t>(light.a_x)), luminance, extra);
    case LightKind::kPoint:
      if (light.b_y > 0) return std::nullopt;
      return point(luminance);
    case LightKind::kPointMap:
      return point(luminance);
    case LightKind::kSpot: {
      const double length = glm::length(b);
      return LightBound{a, 0, b / length, extra < 0 || !(length > 0), luminance};
    }
    case LightKind::kProjection:
      return point(luminance * double(light.b_z) / (4 * kPi));
    default:
      return std::nullopt;
  }
}

LightTree build_light_tree(std::span<const LightBound> lights, double scale, ThreadPool& pool) {
  LightTree tree;
  Builder builder(lights, scale, tree);
  pool.run([&] { builder.build(); });
  return tree;
}

}  // namespace yat
