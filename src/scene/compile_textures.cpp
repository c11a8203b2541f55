#include "scene/compile_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/textures/bands.h"
#include "kernels/textures/constant.h"
#include "kernels/textures/weigh.h"
#include "scene/compile_parts.h"

namespace yat {

namespace {

/// Textures may name textures; a chain this long is a loop.
constexpr int kMaxTextureDepth = 32;

constexpr auto kFamilies = {&arithmetic_textures, &image_textures,   &pattern_textures,
                            &noise_textures,      &blender_textures, &spectral_textures};

const TextureClass* find_class(std::string_view name) {
  for (const auto family : kFamilies)
    for (const TextureClass& candidate : family())
      if (candidate.name == name) return &candidate;
  return nullptr;
}

std::vector<std::string_view> class_names() {
  std::vector<std::string_view> names;
  for (const auto family : kFamilies)
    for (const TextureClass& candidate : family()) names.push_back(candidate.name);
  return names;
}

/// Weights with which bands give the luminance of what they are on the film.
glm::dvec3 luminance_of_bands(const ColourModel& colour) {
  const auto of = [&](const glm::dvec3& bands) { return luminance(to_rgb(bands, colour.film)); };
  return {of({1, 0, 0}), of({0, 1, 0}), of({0, 0, 1})};
}

}  // namespace

std::optional<TextureValue> TextureCompiler::value(uint32_t row, int depth) {
  if (row >= description_.textures.size()) return {};  // reported by the parser
  const TextureEntry& entry = description_.textures[row];
  if (depth > kMaxTextureDepth) {
    diagnostics_.error(entry.plugin.loc,
                       fmt::format("texture \"{}\" is made of itself", entry.name));
    return {};
  }
  if (done_[row]) return *done_[row];
  Parameters p(entry.plugin, fmt::format("texture \"{}\"", entry.name), diagnostics_);
  TextureContext context{*this, p, entry, depth};
  std::optional<TextureValue> made;
  if (const TextureClass* found = find_class(entry.plugin.type)) {
    made = found->compile(context);
  } else {
    diagnostics_.error(
        entry.plugin.loc,
        fmt::format("texture \"{}\": unknown class \"{}\"{}: the default of the "
                    "parameter that uses it is taken",
                    entry.name, entry.plugin.type, did_you_mean(entry.plugin.type, class_names())));
    p.accept_all();
  }
  p.report_unused();
  // What depends on the shape is another texture on the next.
  if (!saw_shape_) done_[row] = made;
  return made;
}

std::optional<TextureValue> TextureCompiler::texture(const Parameter& parameter, bool colour,
                                                     int depth) {
  std::optional<TextureValue> v = value(parameter.texture, depth);
  if (!v) return v;
  const TextureEntry& entry = description_.textures[parameter.texture];
  if (v->normal_map) {
    diagnostics_.error(parameter.loc,
                       fmt::format("texture \"{}\" is a normal map, which only \"bumpmap\" can "
                                   "take: the default of \"{}\" is used",
                                   entry.name, parameter.name));
    return {};
  }
  if (v->colour == colour) return v;
  if (colour) {
    diagnostics_.warning(
        parameter.loc, fmt::format("texture \"{}\" for \"{}\" is a float texture where a color is "
                                   "wanted: it is used as a grey",
                                   entry.name, parameter.name));
    v->colour = true;  // a node of one channel stands in for three
    return v;
  }
  diagnostics_.warning(parameter.loc,
                       fmt::format("texture \"{}\" for \"{}\" is a color texture where a float is "
                                   "wanted: its luminance is used",
                                   entry.name, parameter.name));
  if (!v->varies()) return TextureValue::number(luminance(v->constant));
  const glm::vec3 weights(luminance_of_bands(colour_));
  if (graph_[v->node].outputs > 1)
    v->node = graph_.add<WeighParameters>(StepKind::kWeigh, 0, {weights.x, weights.y, weights.z},
                                          {{v->node, 0}}, 1);
  v->colour = false;
  v->constant = glm::dvec3(luminance(v->constant));
  return v;
}

std::optional<TextureValue> TextureCompiler::bump(const Parameter& parameter) {
  const std::optional<TextureValue> v = value(parameter.texture, 0);
  return v && v->normal_map ? v : texture(parameter, false);
}

TextureValue TextureCompiler::color(Parameters& p, std::string_view name,
                                    const glm::dvec3& fallback, int depth) {
  if (const Parameter* t = p.texture(name)) {
    const auto v = texture(*t, true, depth);
    return v ? *v : TextureValue::of_colour(fallback);
  }
  return TextureValue::of_colour(p.triple(name, ParameterType::kColor, fallback));
}

TextureValue TextureCompiler::number(Parameters& p, std::string_view name, double fallback,
                                     int depth) {
  if (const Parameter* t = p.texture(name)) {
    const auto v = texture(*t, false, depth);
    return v ? *v : TextureValue::number(fallback);
  }
  return TextureValue::number(double(p.number(name, float(fallback))));
}

TextureGraph::Input TextureCompiler::node(const TextureValue& value) {
  if (value.varies()) return {value.node, 0};
  glm::dvec3 c = value.constant;
  // A grey is one number; a colour with a negative channel is bands of differences.
  const bool grey = !value.colour || (c.x == c.y && c.y == c.z);
  if (!grey) c = to_bands(c, colour_.reflectance);
  const glm::vec3 f(c);
  return {graph_.add<ConstantParameters>(StepKind::kConstant, 0, {f.x, f.y, f.z}, {}, grey ? 1 : 3),
          0};
}

// ---- What materials and lights call
// --------------------------------------------------------------

glm::dvec3 color_parameter(Parameters& p, std::string_view name, const glm::dvec3& fallback,
                           TextureCompiler& textures) {
  const TextureValue v = textures.color(p, name, fallback);
  if (v.varies()) textures.varying().push_back({name, v});
  return v.constant;
}

double float_parameter(Parameters& p, std::string_view name, double fallback,
                       TextureCompiler& textures) {
  const TextureValue v = textures.number(p, name, fallback);
  if (v.varies()) textures.varying().push_back({name, v});
  return v.constant.x;
}

namespace {

void warn_of_mean(Parameters& p, const TextureCompiler::Varying& varying) {
  p.diagnostics().warning(p.loc(varying.parameter),
                          fmt::format("\"{}\" of {} cannot vary over a surface: about the mean of "
                                      "its texture is used",
                                      varying.parameter, p.what()));
}

}  // namespace

glm::dvec3 color_parameter(Parameters& p, std::string_view name, const glm::dvec3& fallback,
                           const Description& description) {
  TextureCompiler textures(description, colour_model(ColourMode::kRgb), p.diagnostics(),
                           ImageStore::kDefaultLimit, TextureUse::kLight);
  const glm::dvec3 value = color_parameter(p, name, fallback, textures);
  for (const auto& varying : textures.varying()) warn_of_mean(p, varying);
  return value;
}

double float_parameter(Parameters& p, std::string_view name, double fallback,
                       const Description& description) {
  TextureCompiler textures(description, colour_model(ColourMode::kRgb), p.diagnostics());
  const double value = float_parameter(p, name, fallback, textures);
  for (const auto& varying : textures.varying()) warn_of_mean(p, varying);
  return value;
}

}  // namespace yat
