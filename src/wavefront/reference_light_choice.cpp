// The oracle's choice of lights (reference_parts.h): what decides is as in the kernels, but in
// double precision.

#include <algorithm>

#include "wavefront/reference_parts.h"

namespace yat::reference {

namespace {

struct Child {
  Vec center;
  double radius, intensity;
  uint32_t axis;
  double chord;
  uint32_t child;
};
Child left_of(const LightNode<Value>& n) {
  return {{n.l_x, n.l_y, n.l_z}, n.l_radius, n.l_intensity, n.l_axis, n.l_chord, n.l_child};
}
Child right_of(const LightNode<Value>& n) {
  return {{n.r_x, n.r_y, n.r_z}, n.r_radius, n.r_intensity, n.r_axis, n.r_chord, n.r_child};
}

/// A receiver in tree space.
struct Place {
  Vec at, up;
  bool all_around;
};
Place place_of(const Scene& scene, const Receiver& receiver) {
  Vec at = receiver.position * double(scene.light_tree_scale);
  for (int k = 0; k < 3; ++k) at[k] = std::clamp(at[k], -double(kTreeReach), double(kTreeReach));
  return {at, receiver.up, receiver.all_around};
}

double bounded(double cosine) {
  return std::clamp(cosine, double(kLeastCosine), 1.0);
}

/// scene/light_nodes.h; `sided`: weighted by the receiver's cosine too.
double sent(const Child& child, const Place& place, bool sided) {
  const double distance = std::max(glm::length(child.center - place.at), double(kTreeNear));
  const Vec w = (child.center - place.at) / distance;
  const double slack = std::min(child.radius / distance, 1.0);
  Vec axis;
  for (int k = 0; k < 3; ++k) {
    const auto bits = int32_t(child.axis >> (10 * k) & 0x3ffu);
    axis[k] = (bits < 512 ? bits : bits - 1024) / 511.0;
  }
  const double near = std::max(distance, child.radius);
  const double light =
      child.intensity * bounded(child.chord + slack - glm::dot(axis, w)) / (near * near);
  return sided && !place.all_around ? light * bounded(slack + glm::dot(place.up, w)) : light;
}

double left_share(const LightNode<Value>& node, const Place& place, bool sided) {
  const double left = sent(left_of(node), place, sided);
  const double both = left + sent(right_of(node), place, sided);
  return both > 0 ? left / both : .5;
}

double far_share(const Scene& scene, const Place& place) {
  if (!(scene.far_light > 0)) return 0;
  const LightNode<Value> root = scene.light_tree.nodes.row(0);
  const double near = sent(left_of(root), place, false) + sent(right_of(root), place, false);
  const auto far = double(scene.far_light);
  return std::clamp(far / (far + near), double(kLeastShare), 1 - double(kLeastShare));
}

/// The alias table, in single precision as in the kernels: a path that chose another light would
/// not be the same path.
struct AliasChoice {
  uint32_t light;
  float left;
};
AliasChoice by_power(const Scene& scene, float u) {
  const uint32_t count = scene.light_choice.size();
  if (count < 2) return {0, u};
  const float place = u * float(count);
  const uint32_t interval = std::min(uint32_t(place), count - 1);
  const LightChoice<Value> entry = scene.light_choice.row(interval);
  const float rest = place - float(uint32_t(place)), below_one = 0x1.fffffep-1f;
  if (rest < entry.threshold) return {interval, std::min(rest / entry.threshold, below_one)};
  return {entry.other, std::min((rest - entry.threshold) / (1 - entry.threshold), below_one)};
}

}  // namespace

LightChance choose_light(const Scene& scene, const Receiver& receiver, float number) {
  if (scene.light_tree.nodes.size() == 0) {
    const AliasChoice chosen = by_power(scene, number);
    const auto chance = double(scene.lights.row(chosen.light).probability);
    return {chosen.light, chance, chance, chosen.left};
  }
  const Place place = place_of(scene, receiver);
  auto u = double(number);
  const double far = far_share(scene, place);
  if (u < far) {
    const uint32_t light = scene.first_far_light + by_power(scene, float(u / far)).light;
    const double chance = far * double(scene.lights.row(light).probability);
    return {light, chance, chance};
  }
  u = (u - far) / (1 - far);
  LightChance out{0, 1 - far, 1 - far};
  do {
    const LightNode<Value> node = scene.light_tree.nodes.row(out.light);
    const double share = left_share(node, place, true), nominal = left_share(node, place, false);
    const bool left = u < share;
    u = left ? u / share : (u - share) / (1 - share);
    out.chance *= left ? share : 1 - share;
    out.nominal *= left ? nominal : 1 - nominal;
    out.light = left ? node.l_child : node.r_child;
  } while (!(out.light >> 31));
  out.light &= 0x7fffffffu;
  return out;
}

double chance_of_light(const Scene& scene, const Receiver& receiver, uint32_t light) {
  const auto of_row = double(scene.lights.row(light).probability);
  if (scene.light_tree.nodes.size() == 0) return of_row;
  const Place place = place_of(scene, receiver);
  const double far = far_share(scene, place);
  if (light >= scene.first_far_light) return far * of_row;
  double chance = 1 - far;
  uint32_t at = 0;
  for (uint32_t trail = scene.light_tree.trail[light]; !(at >> 31); trail >>= 1) {
    const LightNode<Value> node = scene.light_tree.nodes.row(at);
    const double left = left_share(node, place, true);
    chance *= trail & 1 ? 1 - left : left;
    at = trail & 1 ? node.r_child : node.l_child;
  }
  return chance;
}

}  // namespace yat::reference
