// imagemap (lxs 8.3).

#include "scene/compile_texture_image.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "kernels/textures/bands.h"
#include "scene/compile_parts.h"

namespace yat {

namespace {

ImageFilter read_filter(TextureContext& c) {
  const std::string name = c.p.text("filtertype", "bilinear");
  if (name == "nearest") return ImageFilter::kNearest;
  if (name == "bilinear") return ImageFilter::kBilinear;
  if (name == "mipmap_trilinear") return ImageFilter::kTrilinear;
  if (name == "mipmap_ewa") {
    c.diagnostics().note(c.p.loc("filtertype"),
                         "filtertype \"mipmap_ewa\": filtered as \"mipmap_trilinear\"");
    return ImageFilter::kTrilinear;
  }
  c.diagnostics().warning(
      c.p.loc("filtertype"),
      fmt::format("{}: unknown filtertype \"{}\"{}: bilinear is used", c.what(), name,
                  did_you_mean(name, {"nearest", "bilinear", "mipmap_trilinear", "mipmap_ewa"})));
  return ImageFilter::kBilinear;
}

ImageWrap read_wrap(TextureContext& c) {
  const std::string name = c.p.text("wrap", "repeat");
  if (name == "repeat") return ImageWrap::kRepeat;
  if (name == "black") return ImageWrap::kBlack;
  if (name == "white") return ImageWrap::kWhite;
  if (name == "clamp") return ImageWrap::kClamp;
  c.diagnostics().warning(c.p.loc("wrap"),
                          fmt::format("{}: unknown wrap \"{}\"{}: repeat is used", c.what(), name,
                                      did_you_mean(name, {"repeat", "black", "white", "clamp"})));
  return ImageWrap::kRepeat;
}

/// Weights of r, g, b, a in the number that a channel is.
std::array<float, 4> read_channel(TextureContext& c) {
  const std::string name = c.p.text("channel", "mean");
  if (name == "red") return {1, 0, 0, 0};
  if (name == "green") return {0, 1, 0, 0};
  if (name == "blue") return {0, 0, 1, 0};
  if (name == "alpha") return {0, 0, 0, 1};
  if (name == "colored_mean") return {.212671f, .715160f, .072169f, 0};
  if (name != "mean")
    c.diagnostics().warning(
        c.p.loc("channel"),
        fmt::format("{}: unknown channel \"{}\"{}: mean is used", c.what(), name,
                    did_you_mean(name, {"mean", "red", "green", "blue", "alpha", "colored_mean"})));
  return {1.f / 3, 1.f / 3, 1.f / 3, 0};
}

TextureValue image(TextureContext& c, bool colour, bool normal_map) {
  ImageLook look{.colour = colour, .normal_map = normal_map};
  look.gain = double(c.p.number("gain", 1));
  look.gamma = double(c.p.number("gamma", 1));
  look.filter = read_filter(c);
  look.wrap = read_wrap(c);
  if (!colour) look.weights = read_channel(c);
  c.p.accept({"channel", "maxanisotropy", "discardmipmaps"});
  if (!(look.gamma > 0) || !std::isfinite(look.gamma)) {
    c.diagnostics().warning(
        c.p.loc("gamma"),
        fmt::format("{}: \"gamma\" is {}, but must be above 0: 1 is used", c.what(), look.gamma));
    look.gamma = 1;
  }
  // Read before anything can fail, so that its parameters count as used.
  return image_texture(c, look, map_2d(c, look.filter == ImageFilter::kTrilinear));
}

TextureValue imagemap(TextureContext& c) {
  if (c.colour() && c.textures.description().dialect == Dialect::kYart) return yart_imagemap(c);
  return image(c, c.colour(), false);
}
/// Its colours are numbers: no bands.
TextureValue normalmap(TextureContext& c) {
  return image(c, true, true);
}

constexpr TextureClass kClasses[] = {{"imagemap", &imagemap}, {"normalmap", &normalmap}};

}  // namespace

TextureValue image_texture(TextureContext& c, const ImageLook& look, TextureGraph::Input at) {
  const std::string name = c.p.text("filename", "");
  const bool mips = look.filter == ImageFilter::kTrilinear;
  const double gain = look.gain, gamma = look.gamma;
  const SourceLoc loc = c.p.loc("filename");
  const bool colour = look.colour;
  const TextureValue white =
      colour ? TextureValue::of_colour(glm::dvec3(1.)) : TextureValue::number(1);
  const std::string path = find_data_file(name, loc, c.textures.description(), c.diagnostics());
  if (path.empty()) {
    c.diagnostics().error(loc, fmt::format("image \"{}\" not found: white is used", name));
    return white;
  }
  ImageStore& images = c.textures.images();
  std::string problem;
  const uint32_t image = images.read(path, mips, gamma, problem);
  if (image == kNone) {
    c.diagnostics().error(
        loc, fmt::format("image \"{}\" cannot be read ({}): white is used", name, problem));
    return white;
  }
  if (images.bad_texels(image))
    c.diagnostics().warning(loc,
                            fmt::format("image \"{}\": {} texels are NaN or infinite: taken as "
                                        "black",
                                        name, images.bad_texels(image)));

  const TexelFormat format = images.format(image);
  ImageParameters<Value> parameters{};
  parameters.image = image;
  parameters.gain =
      float(format == TexelFormat::kByte1 || format == TexelFormat::kByte4 ? gain / 255 : gain);
  parameters.gamma = float(gamma);
  uint32_t variant = image_variant(format, uint32_t(look.filter), look.wrap);
  if (gamma == 1) variant |= kImageLinear;
  TextureValue value;
  value.colour = colour;
  value.normal_map = look.normal_map;
  const auto decode = [&](double x) { return std::pow(std::max(0., gain * x), gamma); };
  const glm::dvec3 mean = images.mean(image);
  value.least = 0;
  value.most = decode(look.wrap == ImageWrap::kWhite ? std::max(1., images.largest(image))
                                                     : images.largest(image));
  const bool one_channel = images.one_channel(image);
  std::vector<TextureGraph::Input> inputs = {at};
  if (mips) inputs.push_back({at.node, 2});
  if (!colour) {
    variant |= kImageNumber;
    parameters.r = look.weights[0];
    parameters.g = look.weights[1];
    parameters.b = look.weights[2];
    parameters.a = look.weights[3];
    // A grey file has no alpha: it counts as 1.
    if (one_channel && look.weights[3] == 1) return TextureValue::number(decode(1));
    const glm::dvec4 w(look.weights[0], look.weights[1], look.weights[2], look.weights[3]);
    value.constant = glm::dvec3(decode(glm::dot(w, glm::dvec4(mean, 1.))));
    value.node = c.graph().add<ImageParameters>(StepKind::kImage, variant, parameters, inputs, 1);
    return value;
  }
  value.constant = {decode(mean.x), decode(mean.y), decode(mean.z)};
  // Bands of a grey are that grey.
  const bool same =
      c.textures.colour().reflectance.red[0] == 1 && c.textures.colour().reflectance.red[1] == 0;
  const bool bands = !one_channel && !same && !look.normal_map;
  if (bands) {  // Gamma acts on spectra, so on bands.
    variant |= kImageLinear;
    parameters.gamma = 1;
  }
  value.node = c.graph().add<ImageParameters>(StepKind::kImage, variant, parameters, inputs,
                                              one_channel ? 1 : 3);
  if (bands)
    value.node = c.graph().add<BandsParameters>(StepKind::kBands, gamma == 1 ? 0 : kBandsRaised,
                                                {float(gamma)}, {{value.node, 0}}, 3);
  return value;
}

std::span<const TextureClass> image_textures() {
  return kClasses;
}

}  // namespace yat
