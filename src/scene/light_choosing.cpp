#include "scene/light_choosing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scene/alias_table.h"
#include "scene/compile_parts.h"

namespace yat {

namespace {

/// Of the light's radiance. Colours outside the film's gamut may have none, but are seen all the
/// same.
double light_luminance(const LightRow<Value>& row, const ColourModel& colour) {
  const glm::dvec3 bands(row.radiance_r, row.radiance_g, row.radiance_b);
  return std::max(luminance(to_rgb(bands, colour.film)),
                  std::max({bands.x, bands.y, bands.z}) / 64);
}

/// Builds the tree, if it can be of use: not where no light with a place shines.
bool make_tree(std::vector<LightRow<Value>>& rows, uint32_t placed, ThreadPool& pool,
               Scene& scene) {
  std::vector<LightBound> bounds;
  double total = 0, far = 0;
  for (const LightRow<Value>& row : rows) {
    const double y = light_luminance(row, scene.colour);
    if (bounds.size() < placed) {
      bounds.push_back(*light_bound(row, y, scene.shapes));
      total += bounds.back().intensity;
    } else {
      const auto radius = double(scene.radius);
      far += light_power(row, scene.colour, radius) / (std::numbers::pi * radius * radius);
    }
  }
  const double scale = 1 / double(scene.radius), far_share = far / (total * scale * scale);
  if (!(total > 0) || !std::isfinite(1 / total) || !std::isfinite(float(far_share))) return false;
  scene.light_tree = build_light_tree(bounds, scale, pool);
  scene.light_tree_scale = float(scale);
  scene.far_light = float(far_share);
  return true;
}

/// Power of a sky or a sun is that through a disc around the whole scene, most of which may meet no
/// surface that is seen: lights with a place, the first ones, keep at least half of the chances.
void leave_half_to_places(std::vector<double>& power, uint32_t placed) {
  const auto first_far = power.begin() + placed;
  const double near = std::accumulate(power.begin(), first_far, 0.),
               far = std::accumulate(first_far, power.end(), 0.);
  if (near > 0 && far > near)
    for (auto p = first_far; p != power.end(); ++p) *p *= near / far;
}

}  // namespace

void prepare_light_choice(std::vector<LightRow<Value>>& rows, LightChoosing choosing,
                          ThreadPool& pool, Scene& scene) {
  const auto environments = std::stable_partition(
      rows.begin(), rows.end(),
      [](const LightRow<Value>& row) { return row.kind < kFirstEnvironment; });
  const auto far = std::stable_partition(
      rows.begin(), environments,
      [&](const LightRow<Value>& row) { return light_bound(row, 1, scene.shapes).has_value(); });
  scene.first_environment = uint32_t(environments - rows.begin());
  const auto placed = uint32_t(far - rows.begin()), all = uint32_t(rows.size());
  scene.first_far_light = placed;
  const uint32_t least = choosing == LightChoosing::kTree ? 2 : kTreeLights;
  const bool may = choosing == LightChoosing::kAuto || choosing == LightChoosing::kTree;
  const bool by_tree = may && placed >= least && make_tree(rows, placed, pool, scene);

  for (uint32_t i = 0; i < placed && by_tree; ++i) rows[i].probability = 1;
  const uint32_t first = by_tree ? placed : 0;
  std::vector<double> power;
  for (uint32_t i = first; i < all; ++i)
    power.push_back(choosing == LightChoosing::kUniform
                        ? 1
                        : light_power(rows[i], scene.colour, double(scene.radius)));
  if (choosing == LightChoosing::kAuto && !by_tree) leave_half_to_places(power, placed);
  const AliasTable table = make_alias_table(power);
  scene.light_choice.resize(all - first);
  for (uint32_t i = first; i < all; ++i) {
    rows[i].probability = table.probability[i - first];
    scene.light_choice.set(i - first, table.choice[i - first]);
  }
}

}  // namespace yat
