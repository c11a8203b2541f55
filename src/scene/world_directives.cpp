// Directives between WorldBegin and WorldEnd that make or use something.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scene/directives.h"

namespace yat {
namespace {

bool is_one_of(std::string_view name, std::span<const std::string_view> names, bool any_case) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view known) {
    return known == name || (any_case && same_but_case(known, name));
  });
}

/// The kind of texture that a parameter of this name asks for. Kinds are separate name spaces, so
/// the same name may stand for three textures. `otherwise`: in a Texture, what it is itself.
TextureKind wanted_kind(std::string_view parameter, TextureKind otherwise, bool any_case) {
  static constexpr std::string_view kFloat[] = {"amount",
                                                "backface_d",
                                                "backface_index",
                                                "backface_uroughness",
                                                "backface_vroughness",
                                                "bumpmap",
                                                "cauchyb",
                                                "d",
                                                "displacementmap",
                                                "film",
                                                "filmindex",
                                                "fov",
                                                "index",
                                                "M1",
                                                "M2",
                                                "M3",
                                                "opacity1",
                                                "opacity2",
                                                "opacity3",
                                                "opacity4",
                                                "p1",
                                                "p2",
                                                "p3",
                                                "R1",
                                                "R2",
                                                "R3",
                                                "roughness",
                                                "sigma",
                                                "thickness",
                                                "uroughness",
                                                "vroughness",
                                                "brickwidth",
                                                "brickheight",
                                                "brickdepth",
                                                "mortarsize",
                                                "depth",
                                                "exponent",
                                                "repeat_u"};
  static constexpr std::string_view kColor[] = {"Ka", "Kd",  "Kr",  "Ks", "Kt",
                                                "L",  "Ks1", "Ks2", "Ks3"};
  if (is_one_of(parameter, kFloat, any_case)) return TextureKind::kFloat;
  if (is_one_of(parameter, kColor, any_case)) return TextureKind::kColor;
  if (parameter == "fresnel") return TextureKind::kFresnel;
  return otherwise;
}

uint32_t row_count(size_t n) {
  return uint32_t(n);
}

}  // namespace

const ScopedNames::Entry* SceneBuilder::look_up(const ScopedNames& names,
                                                std::string_view name) const {
  return by_yart() ? names.find_any_case(name) : names.find(name);
}

void SceneBuilder::resolve_textures(std::vector<Parameter>& parameters, TextureKind otherwise) {
  for (Parameter& parameter : parameters)
    if (parameter.type == ParameterType::kTexture)
      resolve_texture(parameter, wanted_kind(parameter.name, otherwise, by_yart()));
}

void SceneBuilder::resolve_texture(Parameter& parameter, TextureKind wanted) {
  const std::string& name = parameter.strings[0];
  const ScopedNames::Entry* found = look_up(state_.textures[size_t(wanted)], name);
  // A texture of another kind: the compiler converts it, or says that it cannot.
  for (size_t kind = 0; !found && kind < kTextureKinds; ++kind)
    found = look_up(state_.textures[kind], name);
  parameter.texture = found ? found->row : kNoRow;
  if (found) return;
  std::string hint = state_.textures[size_t(wanted)].hint(name, diagnostics_);
  for (size_t kind = 0; hint.empty() && kind < kTextureKinds; ++kind)
    hint = state_.textures[kind].hint(name, diagnostics_);
  diagnostics_.error(parameter.loc, fmt::format("no texture {}{}, {} keeps its default",
                                                quote(name), hint, quote(parameter.name)));
}

void SceneBuilder::texture(Statement& s) {
  const std::string& name = s.strings[0];
  std::string& kind_word = s.strings[1];
  size_t kind = 0;
  while (kind < kTextureKinds && texture_kind_name(TextureKind(kind)) != kind_word) ++kind;
  if (kind_word == "spectrum") {
    diagnostics_.warning(
        s.loc, fmt::format("texture {}: kind \"spectrum\" is old, write \"color\"", quote(name)));
    kind = size_t(TextureKind::kColor);
  }
  if (kind == kTextureKinds) {
    diagnostics_.error(s.loc, fmt::format("texture {}: unknown kind {}{}, skipped, kinds are "
                                          "float, color and fresnel",
                                          quote(name), quote(kind_word),
                                          did_you_mean(kind_word, {"float", "color", "fresnel"})));
    return;
  }
  resolve_textures(s.parameters, TextureKind(kind));
  if (const auto* earlier = state_.textures[kind].find(name))
    diagnostics_.warning(s.loc, fmt::format("{} texture {} is defined again, the one at {} stays "
                                            "with what used it before",
                                            texture_kind_name(TextureKind(kind)), quote(name),
                                            diagnostics_.place(earlier->loc)));
  state_.textures[kind].define(name, {row_count(description_.textures.size()), s.loc});
  description_.textures.push_back({name, std::string(texture_kind_name(TextureKind(kind))),
                                   plugin(s, std::move(s.strings[2])), state_.ctm});
}

/// What a material is made of are the materials of these names that are visible here.
void SceneBuilder::resolve_materials(std::string_view type, std::vector<Parameter>& parameters) {
  static constexpr std::string_view kMadeOfOthers[] = {"mix", "layered", "doubleside",
                                                       "glossycoating"};
  static constexpr std::string_view kNames[] = {
      "namedmaterial1", "namedmaterial2",     "namedmaterial3",   "namedmaterial4",
      "basematerial",   "frontnamedmaterial", "backnamedmaterial"};
  if (!is_one_of(type, kMadeOfOthers, by_yart())) return;
  for (Parameter& parameter : parameters) {
    if (parameter.type != ParameterType::kString || parameter.strings.empty() ||
        !is_one_of(parameter.name, kNames, by_yart()))
      continue;
    const std::string& name = parameter.strings[0];
    const ScopedNames::Entry* found = look_up(state_.materials, name);
    parameter.material = found ? found->row : kNoRow;
    if (!found)
      diagnostics_.error(parameter.loc, fmt::format("no material {}{}, for {}", quote(name),
                                                    state_.materials.hint(name, diagnostics_),
                                                    quote(parameter.name)));
  }
}

void SceneBuilder::material(Statement& s) {
  resolve_textures(s.parameters, TextureKind::kColor);
  resolve_materials(s.strings[0], s.parameters);
  state_.material = state_.lasting_material = row_count(description_.materials.size());
  description_.materials.push_back({{}, plugin(s, std::move(s.strings[0]))});
}

void SceneBuilder::make_named_material(Statement& s) {
  const std::string& name = s.strings[0];
  std::string type = "matte";
  const auto given = std::find_if(s.parameters.begin(), s.parameters.end(), [&](auto& p) {
    return p.type == ParameterType::kString &&
           (p.name == "type" || (by_yart() && same_but_case(p.name, "type")));
  });
  if (given != s.parameters.end()) {
    type = given->strings[0];
    s.parameters.erase(given);
  } else {
    diagnostics_.warning(
        s.loc, fmt::format("material {} has no \"string type\", taken as matte", quote(name)));
  }
  resolve_textures(s.parameters, TextureKind::kColor);
  resolve_materials(type, s.parameters);
  if (const auto* earlier = state_.materials.find(name))
    diagnostics_.warning(s.loc, fmt::format("material {} is defined again, the one at {} stays "
                                            "with what used it before",
                                            quote(name), diagnostics_.place(earlier->loc)));
  state_.materials.define(name, {row_count(description_.materials.size()), s.loc});
  description_.materials.push_back({name, plugin(s, std::move(type))});
}

void SceneBuilder::named_material(Statement& s) {
  const std::string& name = s.strings[0];
  if (const auto* found = look_up(state_.materials, name)) {
    state_.material = state_.lasting_material = found->row;
    return;
  }
  diagnostics_.error(s.loc, fmt::format("no material {}{}, the current one stays", quote(name),
                                        state_.materials.hint(name, diagnostics_)));
}

void SceneBuilder::make_named_volume(Statement& s) {
  const std::string& name = s.strings[0];
  if (const auto* earlier = state_.volumes.find(name))
    diagnostics_.warning(s.loc, fmt::format("volume {} is defined again, the one at {} stays with "
                                            "what used it before",
                                            quote(name), diagnostics_.place(earlier->loc)));
  resolve_textures(s.parameters, TextureKind::kColor);
  state_.volumes.define(name, {row_count(description_.volumes.size()), s.loc});
  description_.volumes.push_back({name, plugin(s, std::move(s.strings[1]))});
}

void SceneBuilder::current_volume(Statement& s) {
  const std::string& name = s.strings[0];
  uint32_t& current = s.directive == "Interior" ? state_.interior : state_.exterior;
  if (name.empty())
    current = kNoRow;
  else if (const auto* found = state_.volumes.find(name))
    current = found->row;
  else
    diagnostics_.error(s.loc, fmt::format("no volume {}{}, {} is ignored", quote(name),
                                          state_.volumes.hint(name, diagnostics_), s.directive));
}

void SceneBuilder::old_volume(Statement& s) {
  diagnostics_.warning(s.loc, fmt::format("Volume {} is not supported, ignored, use "
                                          "MakeNamedVolume with Interior",
                                          quote(s.strings[0])));
}

void SceneBuilder::light_source(Statement& s) {
  resolve_textures(s.parameters, TextureKind::kColor);
  description_.lights.push_back({plugin(s, std::move(s.strings[0])), state_.ctm});
}

void SceneBuilder::area_light_source(Statement& s) {
  resolve_textures(s.parameters, TextureKind::kColor);
  state_.area_light = row_count(description_.area_lights.size());
  description_.area_lights.push_back({plugin(s, std::move(s.strings[0]))});
}

void SceneBuilder::shape(Statement& s) {
  resolve_textures(s.parameters, TextureKind::kColor);
  hint_at_types(s, s.strings[0]);
  ShapeEntry entry;
  entry.plugin = plugin(s, std::move(s.strings[0]));
  entry.to_world = state_.ctm;
  entry.reverse_orientation = state_.reverse_orientation;
  entry.material = state_.material;
  entry.area_light = state_.area_light;
  entry.object = state_.object;
  entry.interior = state_.interior;
  entry.exterior = state_.exterior;
  description_.shapes.push_back(std::move(entry));
  if (by_yart()) use_up(s);
}

/// YART: the material and the lamp are for one shape.
void SceneBuilder::use_up(const Statement& shape) {
  if (state_.material == kNoRow && state_.lasting_material != kNoRow)
    hint(shape.loc, "material",
         "the material before this shape was used up by an earlier shape, so this one has YART's "
         "default matte: LuxRender keeps a material until the next (--compat luxrender)");
  state_.material = state_.area_light = kNoRow;
}

void SceneBuilder::portal(Statement& s) {
  diagnostics_.warning(s.loc,
                       fmt::format("{} only helps LuxRender to sample, it is ignored", s.directive),
                       s.directive);
}

void SceneBuilder::object_begin(Statement& s) {
  const std::string& name = s.strings[0];
  const uint32_t outer = state_.object;
  state_.begin_block(BlockKind::kObject, s.loc);
  if (by_yart()) return;  // its shapes are drawn where they are
  if (outer != kNoRow) {
    // The block is kept, so that its ObjectEnd ends it and not the outer one.
    diagnostics_.error(s.loc, fmt::format("object {} begins inside object {}, its shapes go to the "
                                          "outer one, end that before",
                                          quote(name), quote(description_.objects[outer].name)));
    return;
  }
  if (const auto* earlier = state_.objects.find(name))
    diagnostics_.warning(s.loc, fmt::format("object {} is defined again, the one at {} stays with "
                                            "its instances so far",
                                            quote(name), diagnostics_.place(earlier->loc)));
  state_.object = row_count(description_.objects.size());
  description_.objects.push_back({name, s.loc});
}

void SceneBuilder::object_end(Statement& s) {
  const uint32_t row = state_.object;
  // Known from here on: an object cannot hold itself.
  if (state_.end_block(BlockKind::kObject, s.loc) && state_.object == kNoRow && row != kNoRow)
    state_.objects.define(description_.objects[row].name, {row, description_.objects[row].loc});
}

void SceneBuilder::place_instance(const Statement& s, std::string_view name) {
  if (by_yart()) {
    diagnostics_.error(s.loc,
                       fmt::format("{} is ignored: YART has no instances, and draws the shapes of "
                                   "an object where it is defined",
                                   s.directive),
                       s.directive);
    hint(s.loc, "instance",
         "the scene has instances, which YART does not know (--compat luxrender)");
    return;
  }
  if (state_.object != kNoRow) {
    diagnostics_.error(
        s.loc, fmt::format("{} inside object {} is ignored, end the object before", s.directive,
                           quote(description_.objects[state_.object].name)));
    return;
  }
  const auto* found = state_.objects.find(name);
  if (!found) {
    diagnostics_.error(s.loc, fmt::format("no object {}{}, nothing is placed", quote(name),
                                          state_.objects.hint(name, diagnostics_)));
    return;
  }
  description_.instances.push_back({found->row, state_.ctm, state_.material, s.loc});
}

void SceneBuilder::object_instance(Statement& s) {
  place_instance(s, s.strings[0]);
}

void SceneBuilder::motion_instance(Statement& s) {
  diagnostics_.warning(s.loc, "motion is not supported, the transform at the first time is used",
                       "motion is not supported");
  place_instance(s, s.strings[0]);
}

}  // namespace yat
