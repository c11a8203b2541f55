// fbm, wrinkled, windy, marble (lxs 8.5).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/textures/bands.h"
#include "kernels/textures/marble.h"
#include "kernels/textures/noise.h"
#include "scene/compile_textures.h"

namespace yat {

namespace {

/// More octaves than this are finer than a float can tell.
constexpr int kMostOctaves = 24;

float read_octaves(TextureContext& c) {
  const int octaves = c.p.integer("octaves", 8);
  const int used = std::clamp(octaves, 0, kMostOctaves);
  if (used != octaves)
    c.diagnostics().warning(c.p.loc("octaves"), fmt::format("{}: \"octaves\" is {}: {} are used",
                                                            c.what(), octaves, used));
  return float(used);
}

/// Largest magnitude of a sum of octaves.
double reach(float octaves, float roughness) {
  double sum = 0, weight = 1;
  for (int k = 0; k < int(octaves); ++k, weight *= std::fabs(double(roughness))) sum += weight;
  return 1.1 * sum;  // noise may pass 1 by a little
}

TextureValue number_node(TextureContext& c, uint32_t form, const NoiseParameters<Value>& p,
                         double least, double most, double mean) {
  const TextureGraph::Input mapping = map_3d(c);
  TextureValue value;
  value.colour = c.colour();
  value.least = least;
  value.most = most;
  value.constant = glm::dvec3(mean);
  value.node = c.graph().add<NoiseParameters>(StepKind::kNoise, form, p, {mapping}, 1);
  return value;
}

TextureValue fbm(TextureContext& c) {
  const NoiseParameters<Value> p{read_octaves(c), c.p.number("roughness", .5f)};
  const double most = reach(p.octaves, p.roughness);
  return number_node(c, 0, p, -most, most, 0);
}

TextureValue wrinkled(TextureContext& c) {
  const NoiseParameters<Value> p{read_octaves(c), c.p.number("roughness", .5f)};
  const double most = reach(p.octaves, p.roughness);
  // Where roughness is negative magnitudes are subtracted too.
  return number_node(c, 1, p, p.roughness < 0 ? -most : 0, most, .2 * most);
}

TextureValue windy(TextureContext& c) {
  const double most = reach(3, .5f) * reach(6, .5f);
  return number_node(c, 2, {0, 0}, -most, most, 0);
}

TextureValue marble(TextureContext& c) {
  const MarbleParameters<Value> p{read_octaves(c), c.p.number("roughness", .5f),
                                  c.p.number("scale", 1), c.p.number("variation", .2f)};
  // "scale" is the marble's own: a 3D mapping without it.
  const TextureGraph::Input mapping = map_3d(c, false);
  const uint32_t rgb = c.graph().add<MarbleParameters>(StepKind::kMarble, 0, p, {mapping}, 3);
  TextureValue value;
  value.colour = true;
  value.least = 0;
  value.most = .9;
  value.constant = {.8, .8, .82};
  value.node = c.graph().add<BandsParameters>(StepKind::kBands, 0, {1.f}, {{rgb, 0}}, 3);
  return value;
}

constexpr TextureClass kClasses[] = {
    {"fbm", &fbm}, {"wrinkled", &wrinkled}, {"windy", &windy}, {"marble", &marble}};

}  // namespace

std::span<const TextureClass> noise_textures() {
  return kClasses;
}

}  // namespace yat
