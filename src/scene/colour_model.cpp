#include "scene/colour_model.h"

#include <algorithm>

namespace yat {

namespace {

constexpr ColourModel kBandModel = {
    .reflectance = {.cyan = {.1282f, .9781f, .9725f},
                    .magenta = {.8922f, .0582f, .9356f},
                    .yellow = {1.f, .9559f, .0958f},
                    .red = {.8875f, .0207f, .0219f},
                    .green = {.1272f, .9340f, .0723f},
                    .blue = {0.f, .0406f, .9098f}},
    .light = {.cyan = {.1712f, .9826f, .9758f},
              .magenta = {.8324f, .0562f, .9416f},
              .yellow = {1.0110f, .9535f, .0816f},
              .red = {.8316f, .0164f, .0154f},
              .green = {.1621f, .9417f, .0616f},
              .blue = {.0045f, .0406f, .9215f}},
    .film = {.r_g = -.1560f,
             .r_b = .0035f,
             .g_r = -.0250f,
             .g_b = -.0505f,
             .b_r = -.0224f,
             .b_g = -.0570f},
};

constexpr BandBasis kChannels = {.cyan = {0, 1, 1},
                                 .magenta = {1, 0, 1},
                                 .yellow = {1, 1, 0},
                                 .red = {1, 0, 0},
                                 .green = {0, 1, 0},
                                 .blue = {0, 0, 1}};
constexpr ColourModel kRgbModel = {
    .reflectance = kChannels, .light = kChannels, .film = {0, 0, 0, 0, 0, 0}};

}  // namespace

const ColourModel& colour_model(ColourMode mode) {
  return mode == ColourMode::kBands ? kBandModel : kRgbModel;
}

glm::dvec3 to_bands(const glm::dvec3& rgb, const BandBasis& basis) {
  const auto [r, g, b] = bands_of<double>({rgb.x, rgb.y, rgb.z}, basis,
                                          [](double x, double y) { return std::min(x, y); });
  return {r, g, b};
}

glm::dvec3 to_rgb(const glm::dvec3& bands, const BandMatrix& film) {
  const auto [r, g, b] = rgb_of<double>({bands.x, bands.y, bands.z}, film);
  return {r, g, b};
}

}  // namespace yat
