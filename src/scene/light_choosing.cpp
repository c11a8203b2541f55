#include "scene/light_choosing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

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
bool make_tree(std::span<const LightRow<Value>> rows, uint32_t placed, ThreadPool& pool,
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

/// Whether a surface asks all lights. Sky, sun and lamp have noise of their own each, and one
/// shadow ray for two of them adds that of the choice: with two lights, one of them without a
/// place, both of weight, two rays are worth their time. Among lamps they are not
/// (docs/decisions.md).
bool asks_all(const std::vector<double>& power, uint32_t placed, LightChoosing choosing) {
  constexpr double kLeastPower = 1. / 20;
  if (choosing == LightChoosing::kAll) return power.size() > 1;
  if (choosing != LightChoosing::kAuto || power.size() != 2 || placed == 2) return false;
  const auto [least, most] = std::minmax(power[0], power[1]);
  return least >= kLeastPower * (least + most);
}

/// Whether an environment sends about as much from everywhere. Its own samples then are no better
/// than those of a surface that takes all directions alike: for surfaces turned any way, the second
/// moment of a light sample is 8/3 of the mean's square, that of a direction by the cosine this
/// unevenness.
bool is_even(const LightRow<Value>& row) {
  constexpr float kMostUneven = 2;
  switch (LightKind(row.kind)) {
    case LightKind::kConstant:
      return true;
    case LightKind::kImage:
    case LightKind::kSky:
      return row.c_y <= kMostUneven;
    default:
      return false;
  }
}

/// Whether even environments, the last rows, are left to be found by the directions that materials
/// choose: their shadow rays are spared, or left to other lights. Where there is none, they are
/// worth it to all but matte surfaces, whose directions are just what such a sky asks for
/// (docs/decisions.md).
bool leaves_skies(std::span<const LightRow<Value>> others, const Scene& scene) {
  const auto shines = [&](const LightRow<Value>& row) {
    return light_power(row, scene.colour, double(scene.radius)) > 0;
  };
  return std::any_of(others.begin(), others.end(), shines) ||
         std::all_of(scene.bins.begin() + 1, scene.bins.end(), [](const Bin& bin) {
           const MaterialTraits traits = material_traits(bin.material);
           return bin.material == MaterialKind::kMatte || traits.delta || traits.see_through;
         });
}

}  // namespace

void prepare_light_choice(std::vector<LightRow<Value>>& rows, const CompileOptions& options,
                          ThreadPool& pool, Scene& scene) {
  // --light-choice all goes on as auto where there are too many.
  const bool too_many =
      options.light_choice == LightChoosing::kAll && rows.size() > kMostAskedLights;
  const LightChoosing choosing = too_many ? LightChoosing::kAuto : options.light_choice;
  const auto environments = std::stable_partition(
      rows.begin(), rows.end(),
      [](const LightRow<Value>& row) { return row.kind < kFirstEnvironment; });
  const auto far = std::stable_partition(
      rows.begin(), environments,
      [&](const LightRow<Value>& row) { return light_bound(row, 1, scene.shapes).has_value(); });
  const auto even = std::stable_partition(environments, rows.end(),
                                          [](const LightRow<Value>& row) { return !is_even(row); });
  scene.first_environment = uint32_t(environments - rows.begin());
  const auto others = size_t(even - rows.begin());
  const bool leaves = choosing == LightChoosing::kAuto && options.leaves_even_skies &&
                      leaves_skies({rows.data(), others}, scene);
  scene.asked_lights = uint32_t(leaves ? others : rows.size());
  const std::span<LightRow<Value>> asked(rows.data(), scene.asked_lights);
  const auto placed = uint32_t(far - rows.begin()), all = uint32_t(asked.size());
  scene.first_far_light = placed;
  for (LightRow<Value>& row : rows) row.probability = 0;
  std::vector<double> power;
  for (const LightRow<Value>& row : asked)
    power.push_back(choosing == LightChoosing::kUniform
                        ? 1
                        : light_power(row, scene.colour, double(scene.radius)));
  for (LightRow<Value>& row : asked) row.probability = 1;
  scene.every_light = asks_all(power, placed, choosing);
  if (scene.every_light || all == 0) return;

  const bool may = choosing != LightChoosing::kPower && choosing != LightChoosing::kUniform;
  const uint32_t least = choosing == LightChoosing::kTree ? 2 : kTreeLights;
  const bool by_tree = may && placed >= least && make_tree(asked, placed, pool, scene);
  const uint32_t first = by_tree ? placed : 0;
  if (first == all) return;
  power.erase(power.begin(), power.begin() + first);
  if (may && choosing != LightChoosing::kTree && !by_tree) leave_half_to_places(power, placed);
  const AliasTable table = make_alias_table(power);
  scene.light_choice.resize(all - first);
  for (uint32_t i = first; i < all; ++i) {
    asked[i].probability = table.probability[i - first];
    scene.light_choice.set(i - first, table.choice[i - first]);
  }
}

}  // namespace yat
