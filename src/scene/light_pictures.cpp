// Pictures of lights from files (lxs 6.3, 6.4).

#include <OpenImageIO/imagebuf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/light_compiler.h"

namespace yat {

namespace {

/// Texels of a picture that is kept whole: 512 MB. Larger ones are halved.
constexpr uint64_t kMostTexels = uint64_t(1) << 25;

/// Means of 2 x 2 texels; what an odd side has left over is dropped.
LightPicture halved(const LightPicture& from) {
  LightPicture to{std::max(1u, from.width / 2), std::max(1u, from.height / 2), {}};
  to.texels.resize(size_t(to.width) * to.height);
  for (uint32_t y = 0; y < to.height; ++y)
    for (uint32_t x = 0; x < to.width; ++x) {
      const auto texel = [&](uint32_t i, uint32_t j) {
        return from.texels[size_t(std::min(j, from.height - 1)) * from.width +
                           std::min(i, from.width - 1)];
      };
      to.texels[size_t(y) * to.width + x] =
          .25f * (texel(2 * x, 2 * y) + texel(2 * x + 1, 2 * y) + texel(2 * x, 2 * y + 1) +
                  texel(2 * x + 1, 2 * y + 1));
    }
  return to;
}

}  // namespace

std::optional<LightPicture> read_light_picture(Parameters& p, const std::string& name, double gamma,
                                               const BandBasis& basis,
                                               const Description& description) {
  const SourceLoc loc = p.loc("mapname");
  const std::string path = find_data_file(name, loc, description, p.diagnostics());
  if (path.empty()) {
    p.diagnostics().error(
        loc, fmt::format("image \"{}\" not found: {} shines without it", name, p.what()));
    return std::nullopt;
  }
  OIIO::ImageBuf image(path);
  if (!image.read(0, 0, true, OIIO::TypeDesc::FLOAT) || image.nchannels() < 1 ||
      image.spec().image_pixels() == 0) {
    p.diagnostics().error(loc, fmt::format("image \"{}\" cannot be read ({}): {} shines without it",
                                           name, image.geterror(), p.what()));
    return std::nullopt;
  }
  LightPicture picture{uint32_t(image.spec().width), uint32_t(image.spec().height), {}};
  const auto channels = size_t(image.nchannels());
  const size_t green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
  const auto* texels = static_cast<const float*>(image.localpixels());
  picture.texels.resize(size_t(picture.width) * picture.height);
  uint64_t broken = 0;
  const auto usable = [&](float value) {
    if (value >= 0 && std::isfinite(value)) return double(value);
    ++broken;
    return 0.;
  };
  const auto raised = [&](double band) {
    return gamma == 1 ? band : usable(float(std::pow(band, gamma)));
  };
  for (size_t i = 0; i < picture.texels.size(); ++i) {
    const float* texel = texels + i * channels;
    const glm::dvec3 stored(usable(texel[0]), usable(texel[green]), usable(texel[blue]));
    const glm::dvec3 bands = to_bands(stored, basis);
    picture.texels[i] = {raised(bands.x), raised(bands.y), raised(bands.z)};
  }
  if (broken)
    p.diagnostics().warning(
        loc, fmt::format("image \"{}\": {} values are negative or no numbers: 0 is used for them",
                         name, broken));
  while (uint64_t(picture.width) * picture.height > kMostTexels) {
    picture = halved(picture);
    p.diagnostics().note(
        loc, fmt::format("image \"{}\" is used at {} x {}", name, picture.width, picture.height));
  }
  return picture;
}

std::optional<LightPicture> read_distribution(Parameters& p, const BandBasis& basis,
                                              const Description& description) {
  const std::string map_name = p.text("mapname", ""), ies_name = p.text("iesname", "");
  const bool flip_z = p.flag("flipz", false);
  if (!ies_name.empty()) {
    if (!map_name.empty())
      p.diagnostics().warning(p.loc("mapname"),
                              "a light has an image or an IES profile: the "
                              "profile is used");
    return read_ies(p, ies_name, flip_z, description);
  }
  if (map_name.empty()) return std::nullopt;
  return read_light_picture(p, map_name, 1, basis, description);
}

}  // namespace yat
