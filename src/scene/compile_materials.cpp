// Which material types there are, and what all of them take (lxs 7). What is not yet supported
// becomes the nearest of what is, with one warning; docs/scene-format.md has the table.

#include "scene/compile_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kernels/materials/null.h"
#include "kernels/textures/clamp.h"

namespace yat {

namespace {

MaterialRef build_null(MaterialCompiler& compiler, Parameters&) {
  return compiler.add<NullParameters>(MaterialKind::kNull, {0u});
}

struct MaterialType {
  std::string_view name;
  BuildMaterial build;
};
constexpr MaterialType kTypes[] = {
    {"matte", &build_matte},
    {"mirror", &build_mirror},
    {"glass", &build_glass},
    {"null", &build_null},
    {"glass2", &build_glass2},
    {"roughglass", &build_roughglass},
    {"glossy", &build_glossy},
    {"glossycoating", &build_glossycoating},
    {"glossy_lossy", &build_glossy_lossy},
    {"substrate", &build_glossy_lossy},
    {"plastic", &build_glossy_lossy},
    {"glossytranslucent", &build_glossytranslucent},
    {"mattetranslucent", &build_mattetranslucent},
    {"velvet", &build_velvet},
    {"cloth", &build_cloth},
    {"carpaint", &build_carpaint},
    {"scatter", &build_scatter},
    {"metal", &build_metal},
    {"metal2", &build_metal2},
    {"shinymetal", &build_shinymetal},
    {"mix", &build_mix},
    {"layered", &build_layered},
    {"doubleside", &build_doubleside},
};

const std::vector<std::string_view>& material_types() {
  static const std::vector<std::string_view> types = [] {
    std::vector<std::string_view> all;
    for (const MaterialType& type : kTypes) all.push_back(type.name);
    return all;
  }();
  return types;
}

/// Surfaces without a material: LuxRender's Kd; YART's colour .75 times its diffuse share .5.
constexpr double kDefaultKd = .9, kYartDefaultKd = .375;

/// What every material takes.
void accept_common(Parameters& p) {
  p.accept({"type", "compo_visible_material", "compo_visible_emission",
            "compo_visible_indirect_material", "compo_visible_indirect_emission",
            "compo_override_alpha", "compo_override_alpha_value", "name"});
}

/// Whether what the material becomes depends on the volumes around its shape.
bool sees_volumes(std::string_view type) {
  return type.starts_with("glass") || type == "mix" || type == "doubleside" || type == "layered" ||
         type == "glossycoating";
}

/// Whether its lobe may differ along the surface's axes.
bool has_two_roughnesses(MaterialKind kind) {
  const TexturedFields fields = material_traits(kind).textured;
  return std::any_of(fields.begin(), fields.end(),
                     [](const TexturedField& f) { return f.parameter == "vroughness"; });
}

}  // namespace

glm::dvec3 MaterialCompiler::reflectance(Parameters& p, std::string_view name, double fallback) {
  const glm::dvec3 given = color_parameter(p, name, glm::dvec3(fallback), textures_);
  // max(0, NaN) is 0 in this order.
  const glm::dvec3 clamped(std::min(std::max(0., given.x), 1.), std::min(std::max(0., given.y), 1.),
                           std::min(std::max(0., given.z), 1.));
  // What varies is clamped where it is evaluated.
  if (clamped != given && !varies(name))
    diagnostics_.warning(p.loc(name),
                         fmt::format("\"{}\" of {} is {:.6g} {:.6g} {:.6g}: clamped to 0..1", name,
                                     p.what(), given.x, given.y, given.z),
                         fmt::format("\"{}\" of {}: clamped", name, p.what()));
  return clamped;
}

glm::vec3 MaterialCompiler::reflectance_bands(Parameters& p, std::string_view name,
                                              double fallback) {
  return bands(reflectance(p, name, fallback));
}

glm::vec3 MaterialCompiler::bands(const glm::dvec3& rgb) const {
  return glm::vec3(to_bands(rgb, colour_.reflectance));
}

double MaterialCompiler::clamped(Parameters& p, std::string_view name, double fallback,
                                 double least, double most) {
  const double given = float_parameter(p, name, fallback, textures_);
  const double clamped = std::min(std::max(least, given), most);  // least for a NaN
  if (clamped != given && !varies(name))
    diagnostics_.warning(p.loc(name),
                         fmt::format("\"{}\" of {} is {:.6g}: clamped to {:.6g}..{:.6g}", name,
                                     p.what(), given, least, most));
  return clamped;
}

bool MaterialCompiler::varies(std::string_view name) {
  const auto& varying = textures_.varying();
  return std::any_of(varying.begin(), varying.end(),
                     [&](const auto& v) { return v.parameter == name; });
}

MaterialRef MaterialCompiler::bind_textures(Parameters& p, const MaterialRef& made) {
  std::vector<TexturePrograms::Binding> bindings;
  for (const TextureCompiler::Varying& v : textures_.varying()) {
    bool bound = false;
    for (const TexturedField& field : material_traits(made.kind).textured) {
      if (field.parameter != v.parameter) continue;
      bound = true;
      TextureGraph::Input input = textures_.node(v.value);
      if (v.value.least < double(field.least) || v.value.most > double(field.most) ||
          field.unit != 1)
        input = {textures_.graph().add<ClampParameters>(
                     StepKind::kClamp, 0, {field.least, field.most, field.unit}, {input},
                     textures_.graph()[input.node].outputs),
                 0};
      bindings.push_back({field.field, field.channels, input});
    }
    if (!bound)
      diagnostics_.warning(
          p.loc(v.parameter),
          fmt::format("\"{}\" of {} cannot vary over a surface yet: about the mean of its texture "
                      "is used",
                      v.parameter, p.what()));
  }
  // A lobe is the same all around where one texture gives both roughnesses.
  const auto given_by = [&](std::string_view parameter) {
    for (const TexturedField& field : material_traits(made.kind).textured)
      for (const TexturePrograms::Binding& b : bindings)
        if (field.parameter == parameter && field.field == b.field) return b.input;
    return TextureGraph::Input{};
  };
  const bool brushed =
      !(given_by("uroughness") == given_by("vroughness")) && has_two_roughnesses(made.kind);
  const TexturePrograms::Bump bump = read_bump(p);
  if (bindings.empty() && bump.input.node == kNone) return made;
  // The row that was made for it moves from the kind's table to the program's.
  auto& words = words_[uint32_t(made.kind)];
  const RecordSize record = parameters_size(made.kind);
  const auto* first = words.data() + size_t(made.row) * record.row_words;
  const std::vector<uint32_t> parameters(first, first + record.row_words);
  if (made.row + 1 == rows_[uint32_t(made.kind)]) {
    words.resize(words.size() - record.row_words);
    --rows_[uint32_t(made.kind)];
  }
  const TexturePrograms::Ref ref =
      programs_.add(made.kind, parameters, bindings, bump, textures_.graph());
  MaterialRef textured = made;
  textured.row = ref.row;
  textured.program = ref.program;
  textured.tangents = made.tangents || brushed;
  textured.uv = std::max(made.uv, programs_.uv(ref.program));
  return textured;
}

TexturePrograms::Bump MaterialCompiler::read_bump(Parameters& p) {
  TexturePrograms::Bump bump;
  bump.distance = p.number("bumpmapsampledistance", .001f);
  if (!(bump.distance > 0)) {
    diagnostics_.warning(p.loc("bumpmapsampledistance"),
                         fmt::format("\"bumpmapsampledistance\" is {}, but must be above 0: 0.001 "
                                     "is used",
                                     bump.distance));
    bump.distance = .001f;
  }
  const Parameter* texture = p.texture("bumpmap");
  if (!texture) return bump;
  const std::optional<TextureValue> map = textures_.bump(*texture);
  // One height everywhere is a smooth surface.
  if (!map || !map->varies()) return bump;
  bump.input = textures_.node(*map);
  bump.normal_map = map->normal_map;
  return bump;
}

MaterialRef MaterialCompiler::build(const Plugin& plugin) {
  // A material may be built while another is: what varies belongs to one of them.
  std::vector<TextureCompiler::Varying> outer = std::exchange(textures_.varying(), {});
  const MaterialRef made = build_plugin(plugin);
  textures_.varying() = std::move(outer);
  return made;
}

MaterialRef MaterialCompiler::build_plugin(const Plugin& plugin) {
  Parameters p(plugin, "material \"" + plugin.type + "\"", diagnostics_);
  const auto type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                 [&](const MaterialType& t) { return t.name == plugin.type; });
  if (type == std::end(kTypes)) {
    diagnostics_.error(
        plugin.loc, fmt::format("unknown material \"{}\"{}: matte with Kd 0.9 is used", plugin.type,
                                did_you_mean(plugin.type, material_types())));
    p.accept_all();
    return add_matte(*this, glm::dvec3(.9), 0);
  }
  const MaterialRef made = type->build(*this, p);
  accept_common(p);
  const MaterialRef textured = bind_textures(p, made);
  p.report_unused();
  return textured;
}

MaterialRef MaterialCompiler::compile(uint32_t entry, const VolumesAround& volumes,
                                      const Matrix& shape) {
  textures_.set_shape(shape);
  MaterialRef made = compile_known(entry, volumes);
  made.id = entry < description_.materials.size() ? entry + 1 : 0;
  return made;
}

MaterialRef MaterialCompiler::compile_known(uint32_t entry, const VolumesAround& volumes) {
  const bool by_yart = description_.dialect == Dialect::kYart;
  // In YART a null surface is there: it has the default matte.
  const bool is_default = entry >= description_.materials.size() ||
                          (by_yart && description_.materials[entry].plugin.type == "null");
  // Only glass, and what may be made of it, looks at volumes: the others stay one row.
  const VolumesAround of_caller = volumes_;
  volumes_ = !is_default && sees_volumes(description_.materials[entry].plugin.type)
                 ? volumes
                 : VolumesAround{};
  const std::pair key(is_default ? kNone : entry, volumes_);
  const bool is_new = done_.try_emplace(key).second;
  if (is_new && !is_default) {
    const MaterialRef made = build(description_.materials[entry].plugin);
    done_[key] = made;
  } else if (!done_[key]) {
    // A scene's text cannot name what comes after; a description made otherwise may.
    if (!is_default)
      diagnostics_.error(description_.materials[entry].plugin.loc, "a material is made of itself");
    done_[key] = add_matte(*this, glm::dvec3(by_yart ? kYartDefaultKd : kDefaultKd), 0);
  }
  volumes_ = of_caller;
  const MaterialRef made = *done_[key];
  // On the next shape it is another material.
  if (textures_.saw_shape()) done_.erase(key);
  return made;
}

std::optional<MaterialRef> MaterialCompiler::child(Parameters& p, std::string_view name) {
  const uint32_t row = p.material(name);
  if (row < description_.materials.size()) {
    const MaterialRef made = compile_known(row, volumes_);
    if (split_depth(form_of(made)) < kMaxSplitDepth) return made;
    diagnostics_.error(p.loc(name),
                       fmt::format("materials are made of others more than {} times over: {} is "
                                   "matte with Kd 0.9",
                                   kMaxSplitDepth, p.what()));
  } else if (!p.given(name)) {
    diagnostics_.error(p.plugin().loc,
                       fmt::format("{} has no \"{}\": matte with Kd 0.9 is used", p.what(), name));
  } else {
    diagnostics_.error(p.loc(name), fmt::format("\"{}\" of {} names no material: matte with Kd 0.9 "
                                                "is used",
                                                name, p.what()));
  }
  return std::nullopt;
}

uint32_t MaterialCompiler::split_row(const MaterialSplit& split) {
  const auto known = std::find(splits_.begin(), splits_.end(), split);
  if (known != splits_.end()) return uint32_t(known - splits_.begin());
  splits_.push_back(split);
  return uint32_t(splits_.size() - 1);
}

uint32_t MaterialCompiler::split_depth(const MaterialForm& form) const {
  if (form.split == kNone) return 0;
  const MaterialSplit& split = splits_[form.split];
  return 1 + std::max(split_depth(split.child[0]), split_depth(split.child[1]));
}

bool MaterialCompiler::has_coating(const MaterialForm& form) const {
  if (form.split == kNone) return false;
  const MaterialSplit& split = splits_[form.split];
  return form.kind == MaterialKind::kCoating || has_coating(split.child[0]) ||
         has_coating(split.child[1]);
}

void MaterialCompiler::finish(Scene& scene) {
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind) {
    scene.parameters[kind] = AlignedArray<uint32_t>(std::span<const uint32_t>(words_[kind]));
    scene.parameter_rows[kind] = rows_[kind];
  }
  scene.splits = std::move(splits_);
  ImageStore& images = textures_.images();
  if (images.left_out())
    diagnostics_.note({},
                      fmt::format("{} mip levels of images are left out, so that texels take no "
                                  "more than {} MB (--texture-cache)",
                                  images.left_out(), images.limit() >> 20));
  scene.programs = programs_.finish(textures_.graph(), scene.center, images);
  scene.texels = images.take();
}

}  // namespace yat
