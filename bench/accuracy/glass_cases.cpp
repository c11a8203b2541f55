// Smooth glass: what it reflects, transmits and absorbs.

#include <fmt/format.h>

#include "accuracy/case.h"
#include "accuracy/fresnel.h"
#include "accuracy/scene_text.h"

namespace yat::accuracy {

namespace {

constexpr double kIndex = 1.5;

/// Looks down at the origin, `angle` degrees from the normal.
std::string view(double angle) {
  const double a = angle * kPi / 180;
  return slanted_view({0, 0, 0}, {std::sin(a), 0, std::cos(a)});
}
std::string glass(double index) {
  return fmt::format(
      "Material \"glass\" \"color Kr\" [1 1 1] \"color Kt\" [1 1 1] \"float index\" [{}]\n", index);
}
/// z in [-thickness, 0], outside outwards, so wide that what leaves by the sides is below 1e-6.
constexpr double kHalfWidth = 1.5;
std::string slab_shape(double thickness, double half_width = kHalfWidth) {
  const double w = half_width;
  return quad({-w, -w, 0}, {2 * w, 0, 0}, {0, 2 * w, 0}) +
         quad({-w, -w, -thickness}, {0, 2 * w, 0}, {2 * w, 0, 0});
}
/// Shines with 1 towards the slab, from above or from below.
std::string shining(bool above) {
  const double w = 50;
  return attribute(matte(0) + area_light(1) +
                   (above ? quad({-w, -w, 1}, {0, 2 * w, 0}, {2 * w, 0, 0})
                          : quad({-w, -w, -1}, {2 * w, 0, 0}, {0, 2 * w, 0})));
}

}  // namespace

void add_glass_cases(std::vector<Case>& cases) {
  for (const double angle : {0., 60.}) {
    const Slab both = slab(kIndex, std::cos(angle * kPi / 180));
    const std::string body = glass(kIndex) + slab_shape(.1) + "WorldEnd\n";
    std::optional<double> r, t;
    if (angle == 0) r = .076923077, t = .923076923;
    cases.push_back({fmt::format("glass.slab.reflected.{}", angle),
                     fmt::format("slab of index 1.5, {} degrees: reflected", angle),
                     {{view(angle) + shining(true) + body, 1000}},
                     known(both.reflected),
                     r});
    cases.push_back({fmt::format("glass.slab.transmitted.{}", angle),
                     "the same: transmitted",
                     {{view(angle) + shining(false) + body, 1000}},
                     known(both.transmitted),
                     t});
  }
  // A small white receiver, face down above a half-space of glass under a uniform sky: of what it
  // would get from all around below it, it gets what the glass reflects. It covers 2e-7 of that.
  cases.push_back(
      {"glass.mean_reflectance",
       "reflectance of index 1.5 for light from a hemisphere",
       {{point_view({0, 0, 1}, {0, 0, -1}) + matte(1) +
             quad({-5e-4, -5e-4, 1}, {0, 1e-3, 0}, {1e-3, 0, 0}) + glass(kIndex) +
             "Shape \"plane\"\n" + matte(0) + translated({0, 0, -1}, "Shape \"plane\"\n") +
             constant_sky(1) + "WorldEnd\n",
         1000}},
       [](const Machine&) { return Known{mean_fresnel(kIndex), 0}; },
       .091777959});
  // An absorbing volume of index 1 in front of light: exp(-sigma d / cos). A ray begins up to 32
  // roundings of the coordinates behind the surface that it leaves; in the wide slab that would be
  // 2e-4 of its thickness, but the way counts from the surface. Places are known to 2 roundings.
  for (const double angle : {0., 60.}) {
    const double sigma = 1.7, thickness = .4, c = std::cos(angle * kPi / 180);
    for (const double half_width : {kHalfWidth, 40.})
      cases.push_back(
          {fmt::format("glass.absorption.{}{}", half_width == kHalfWidth ? "" : "wide.", angle),
           fmt::format("absorption 1.7 over .4, index 1, {} degrees, {} m wide", angle,
                       2 * half_width),
           {{view(angle) + shining(false) +
                 attribute(fmt::format("MakeNamedVolume \"dark\" \"clear\" \"float fresnel\" [1] "
                                       "\"color absorption\" [{0} {0} {0}]\nInterior "
                                       "\"dark\"\nMaterial \"glass2\"\n",
                                       sigma) +
                           slab_shape(thickness, half_width)) +
                 "WorldEnd\n",
             1000}},
           [=](const Machine&) {
             const double value = std::exp(-sigma * thickness / c);
             return Known{value, value * sigma * half_width * 2 * 0x1p-24 / c};
           },
           {}});
    const double inside = std::sqrt(1 - (1 - c * c) / 2.25);
    const Slab both = slab(kIndex, c, std::exp(-sigma * thickness / inside));
    cases.push_back(
        {fmt::format("glass.absorbing_slab.{}", angle),
         fmt::format("the same with index 1.5: transmitted", angle),
         {{view(angle) + shining(false) +
               attribute(fmt::format("MakeNamedVolume \"dark\" \"clear\" \"float fresnel\" [1.5] "
                                     "\"color absorption\" [{0} {0} {0}]\nInterior "
                                     "\"dark\"\nMaterial \"glass2\"\n",
                                     sigma) +
                         slab_shape(thickness)) +
               "WorldEnd\n",
           1000}},
         known(both.transmitted),
         {}});
  }
}

}  // namespace yat::accuracy
