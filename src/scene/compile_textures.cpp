// Parameters that may be textures, as one value for the whole surface. Textures that vary over a
// surface are not evaluated while rendering yet: an image counts by its mean.

#include <OpenImageIO/imagebuf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/compile_parts.h"

namespace yat {

namespace {

/// Textures may name textures; a chain this long is a loop.
constexpr int kMaxTextureDepth = 32;

std::optional<glm::dvec3> evaluate(uint32_t row, const Description& description,
                                   Diagnostics& diagnostics, int depth);

/// A texture's own input: a texture, or a constant of the texture's kind.
std::optional<glm::dvec3> input(Parameters& p, const TextureEntry& entry, std::string_view name,
                                double fallback, const Description& description, int depth) {
  if (const Parameter* t = p.texture(name))
    return evaluate(t->texture, description, p.diagnostics(), depth + 1);
  if (entry.kind == "color") return p.triple(name, ParameterType::kColor, glm::dvec3(fallback));
  return glm::dvec3(double(p.number(name, float(fallback))));
}

/// Mean over the picture of (gain * texel)^gamma; white, and an error, if it cannot be read.
glm::dvec3 mean_of_image(Parameters& p, const TextureEntry& entry, const Description& description) {
  const std::string name = p.text("filename", "");
  const auto gain = double(p.number("gain", 1)), gamma = double(p.number("gamma", 1));
  const std::string channel = p.text("channel", "mean");
  p.accept({"filtertype", "wrap", "maxanisotropy", "discardmipmaps", "mapping", "uscale", "vscale",
            "udelta", "vdelta", "v1", "v2"});
  const SourceLoc loc = p.loc("filename");
  const std::string path = find_data_file(name, loc, description, p.diagnostics());
  if (path.empty()) {
    p.diagnostics().error(loc, fmt::format("image \"{}\" not found: white is used", name));
    return glm::dvec3(1.);
  }
  OIIO::ImageBuf image(path);
  if (!image.read(0, 0, true, OIIO::TypeDesc::FLOAT) || image.nchannels() < 1) {
    p.diagnostics().error(loc, fmt::format("image \"{}\" cannot be read ({}): white is used", name,
                                           image.geterror()));
    return glm::dvec3(1.);
  }
  const int channels = image.nchannels();
  const auto* texels = static_cast<const float*>(image.localpixels());
  const auto count = size_t(image.spec().image_pixels());
  const int green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
  glm::dvec3 sum(0.);
  double alpha = 0;
  const auto decode = [&](float texel) {
    const double value = std::pow(std::max(0., gain * double(texel)), gamma);
    return std::isfinite(value) ? value : 0.;
  };
  for (size_t i = 0; i < count; ++i) {
    const float* texel = texels + i * size_t(channels);
    sum += glm::dvec3(decode(texel[0]), decode(texel[green]), decode(texel[blue]));
    alpha += channels == 4 ? decode(texel[3]) : channels == 2 ? decode(texel[1]) : 1;
  }
  const glm::dvec3 mean = sum / double(count);
  if (entry.kind == "color") return mean;
  if (channel == "red") return glm::dvec3(mean.x);
  if (channel == "green") return glm::dvec3(mean.y);
  if (channel == "blue") return glm::dvec3(mean.z);
  if (channel == "alpha") return glm::dvec3(alpha / double(count));
  if (channel == "colored_mean") return glm::dvec3(luminance(mean));
  return glm::dvec3((mean.x + mean.y + mean.z) / 3);
}

/// Empty, and reported, when the texture has no single value.
std::optional<glm::dvec3> evaluate(uint32_t row, const Description& description,
                                   Diagnostics& diagnostics, int depth) {
  if (row >= description.textures.size()) return std::nullopt;  // reported by the parser
  const TextureEntry& entry = description.textures[row];
  const std::string& type = entry.plugin.type;
  Parameters p(entry.plugin, fmt::format("texture \"{}\"", entry.name), diagnostics);
  if (depth > kMaxTextureDepth) {
    diagnostics.error(entry.plugin.loc,
                      fmt::format("texture \"{}\" is made of itself", entry.name));
    return std::nullopt;
  }
  const auto in = [&](std::string_view name, double fallback) {
    return input(p, entry, name, fallback, description, depth);
  };
  std::optional<glm::dvec3> value;
  if (type == "constant") {
    // A float texture may hold a color and the reverse: the conversion rules of Parameters apply.
    value = entry.kind == "color" ? p.triple("value", ParameterType::kColor, glm::dvec3(1.))
                                  : glm::dvec3(double(p.number("value", 1)));
  } else if (type == "scale" || type == "add" || type == "subtract") {
    const auto a = in("tex1", 1), b = in("tex2", 1);
    if (a && b) value = type == "scale" ? *a * *b : type == "add" ? *a + *b : *a - *b;
  } else if (type == "mix") {
    const auto a = in("tex1", 0), b = in("tex2", 1);
    std::optional<glm::dvec3> t;
    if (const Parameter* amount = p.texture("amount"))
      t = evaluate(amount->texture, description, diagnostics, depth + 1);
    else
      t = glm::dvec3(double(p.number("amount", .5f)));
    if (a && b && t) value = *a + (*b - *a) * luminance(*t);
  } else if (type == "imagemap") {
    diagnostics.warning(
        entry.plugin.loc,
        fmt::format("texture \"{}\": image textures are not yet supported: the mean "
                    "colour of the image is used",
                    entry.name));
    value = mean_of_image(p, entry, description);
  } else {
    diagnostics.warning(
        entry.plugin.loc,
        fmt::format("texture \"{}\": \"{}\" is not yet supported: the default of the "
                    "parameter that uses it is taken",
                    entry.name, type));
    p.accept_all();
  }
  p.report_unused();
  return value;
}

}  // namespace

glm::dvec3 color_parameter(Parameters& parameters, std::string_view name,
                           const glm::dvec3& fallback, const Description& description) {
  if (const Parameter* t = parameters.texture(name))
    return evaluate(t->texture, description, parameters.diagnostics(), 0).value_or(fallback);
  return parameters.triple(name, ParameterType::kColor, fallback);
}

double float_parameter(Parameters& parameters, std::string_view name, double fallback,
                       const Description& description) {
  if (const Parameter* t = parameters.texture(name)) {
    const auto value = evaluate(t->texture, description, parameters.diagnostics(), 0);
    return value ? luminance(*value) : fallback;
  }
  return double(parameters.number(name, float(fallback)));
}

}  // namespace yat
