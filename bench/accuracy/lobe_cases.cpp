// Directional albedos of rough metals that absorb nothing, in light from all around.

#include <fmt/format.h>

#include "accuracy/case.h"
#include "accuracy/lobes.h"
#include "accuracy/scene_text.h"

namespace yat::accuracy {

namespace {

/// A flat mirror under a uniform sky of radiance 1, seen at cosine c: radiance is the albedo.
std::string furnace(const std::string& material, double c) {
  return slanted_view({0, 0, 0}, {std::sqrt(1 - c * c), 0, c}) + material +
         quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}) + constant_sky(1) + "WorldEnd\n";
}

}  // namespace

void add_lobe_cases(std::vector<Case>& cases, std::vector<Missing>& missing) {
  for (const double alpha : {.1, .3, .5, 1.})
    for (const double c : {1., .5, .1}) {
      // Index 1e8: all but 1e-6 is reflected, at every angle.
      const std::string lux = fmt::format(
          "Texture \"f\" \"fresnel\" \"constant\" \"float value\" [1e8]\nMaterial \"metal2\" "
          "\"texture fresnel\" [\"f\"] \"float uroughness\" [{0}] \"float vroughness\" [{0}]\n",
          alpha);
      cases.push_back({fmt::format("lobes.luxrender.{}.{}", alpha, c),
                       fmt::format("LuxRender's lobe, F = 1, roughness {}, cosine {}", alpha, c),
                       {{furnace(lux, c), 1}},
                       [=](const Machine&) { return Known{luxrender_albedo(alpha, c), 0}; },
                       {}});
    }
  for (const double m : {.1, .3, .5, 1.})
    for (const double c : {1., .5, .1}) {
      Probe probe{furnace(fmt::format("Material \"metal2\" \"color fresnel\" [1 1 1] \"float "
                                      "uroughness\" [{}]\n",
                                      m),
                          c),
                  1};
      probe.dialect = Dialect::kYart;
      probe.compensation = EnergyCompensation::kOff;
      cases.push_back({fmt::format("lobes.cook_torrance.{}.{}", m, c),
                       fmt::format("Cook and Torrance's lobe, F = 1, slope {}, cosine {}", m, c),
                       {probe},
                       [=](const Machine&) { return Known{cook_torrance_albedo(m, c), 0}; },
                       {}});
    }
  missing.push_back({"lobes.ggx",
                     "GGX with height-correlated masking: no material of yat has it. LuxRender's "
                     "lobe is GGX's D with Schlick's G; YART's is Beckmann's with V-cavities"});
}

}  // namespace yat::accuracy
