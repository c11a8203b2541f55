// Materials -> parameter tables (lxs 7). What is not yet supported becomes the nearest of what is,
// with one warning; docs/scene-format.md has the table.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/materials/glass.h"
#include "kernels/materials/matte.h"
#include "kernels/materials/mirror.h"
#include "kernels/materials/null.h"
#include "kernels/materials/oren_nayar.h"
#include "scene/compile_parts.h"

namespace yat {

namespace {

/// LuxRender's material types that have no kernel yet: the colour parameter that a matte
/// replacement takes, and its value where it is not given. Empty: always that grey.
struct Replacement {
  std::string_view type, color;
  double fallback;
};
constexpr Replacement kReplacements[] = {
    {"glossy", "Kd", .9},
    {"glossycoating", "", .5},
    {"glossy_lossy", "Kd", .9},
    {"substrate", "Kd", .9},
    {"plastic", "Kd", .9},
    {"glossytranslucent", "Kd", .9},
    {"mattetranslucent", "Kr", .9},
    {"velvet", "Kd", .3},
    {"cloth", "warp_Kd", .5},
    {"carpaint", "Kd", .5},
    {"scatter", "Kd", .9},
    {"metal", "", .5},
    {"metal2", "Kr", .5},
    {"shinymetal", "Kr", .9},
    {"mix", "", .5},
    {"layered", "", .5},
    {"doubleside", "", .5},
};

const std::vector<std::string_view>& material_types() {
  static const std::vector<std::string_view> types = [] {
    std::vector<std::string_view> all = {"matte", "mirror", "glass",
                                         "null",  "glass2", "roughglass"};
    for (const Replacement& r : kReplacements) all.push_back(r.type);
    return all;
  }();
  return types;
}

/// What every material takes.
void accept_common(Parameters& p) {
  p.unsupported({"bumpmap"}, "the surface stays smooth");
  p.accept({"type", "bumpmapsampledistance", "compo_visible_material", "compo_visible_emission",
            "compo_visible_indirect_material", "compo_visible_indirect_emission",
            "compo_override_alpha", "compo_override_alpha_value", "name"});
}

/// Thin films change the colour of reflections.
void accept_film(Parameters& p) {
  if (p.number("film", 0) != 0)
    p.diagnostics().warning(p.loc("film"),
                            "thin films are not yet supported: \"film\" is taken as 0");
  p.accept({"filmindex"});
}

}  // namespace

template <template <template <class> class> class Record>
MaterialRef MaterialCompiler::add(MaterialKind kind, const Record<Value>& record) {
  auto& words = words_[uint32_t(kind)];
  const uint32_t row = rows_[uint32_t(kind)]++;
  words.resize(size_t(row + 1) * row_words<Record>);
  for_each_field(
      [&](auto index, const auto& field) {
        std::memcpy(&words[size_t(row) * row_words<Record> + index], &field, 4);
      },
      record);
  return {kind, row};
}

MaterialRef MaterialCompiler::add_matte(const glm::dvec3& kd, double sigma_degrees) {
  const glm::vec3 c(to_bands(kd, colour_.reflectance));
  if (sigma_degrees == 0) return add<MatteParameters>(MaterialKind::kMatte, {c.x, c.y, c.z});
  return add<OrenNayarParameters>(MaterialKind::kOrenNayar,
                                  {c.x, c.y, c.z, float(sigma_degrees * std::numbers::pi / 180)});
}

MaterialRef MaterialCompiler::add_mirror(const glm::dvec3& kr) {
  const glm::vec3 c(to_bands(kr, colour_.reflectance));
  return add<MirrorParameters>(MaterialKind::kMirror, {c.x, c.y, c.z});
}

MaterialRef MaterialCompiler::add_glass(const glm::dvec3& kr, const glm::dvec3& kt, double index) {
  const glm::vec3 r(to_bands(kr, colour_.reflectance)), t(to_bands(kt, colour_.reflectance));
  return add<GlassParameters>(MaterialKind::kGlass, {r.x, r.y, r.z, t.x, t.y, t.z, float(index)});
}

glm::dvec3 MaterialCompiler::reflectance(Parameters& p, std::string_view name, double fallback) {
  const glm::dvec3 given = color_parameter(p, name, glm::dvec3(fallback), description_);
  // max(0, NaN) is 0 in this order.
  const glm::dvec3 clamped(std::min(std::max(0., given.x), 1.), std::min(std::max(0., given.y), 1.),
                           std::min(std::max(0., given.z), 1.));
  if (clamped != given)
    diagnostics_.warning(p.loc(name),
                         fmt::format("\"{}\" of {} is {:.6g} {:.6g} {:.6g}: clamped to 0..1", name,
                                     p.what(), given.x, given.y, given.z),
                         fmt::format("\"{}\" of {}: clamped", name, p.what()));
  return clamped;
}

MaterialRef MaterialCompiler::build(const Plugin& plugin) {
  Parameters p(plugin, "material \"" + plugin.type + "\"", diagnostics_);
  MaterialRef made;
  if (plugin.type == "matte") {
    const glm::dvec3 kd = reflectance(p, "Kd", .9);
    const double sigma = float_parameter(p, "sigma", 0, description_);
    const double clamped = std::min(std::max(0., sigma), 90.);
    if (clamped != sigma)
      diagnostics_.warning(p.loc("sigma"),
                           fmt::format("\"sigma\" is {:.6g} degrees: clamped to 0..90", sigma));
    made = add_matte(kd, clamped);
  } else if (plugin.type == "mirror") {
    made = add_mirror(reflectance(p, "Kr", 1));
    accept_film(p);
  } else if (plugin.type == "glass" || plugin.type == "roughglass" || plugin.type == "glass2") {
    const bool rough = plugin.type == "roughglass", volumes = plugin.type == "glass2";
    const glm::dvec3 kr = volumes ? glm::dvec3(1.) : reflectance(p, "Kr", 1);
    const glm::dvec3 kt = volumes ? glm::dvec3(1.) : reflectance(p, "Kt", 1);
    double index = volumes ? 1.5 : float_parameter(p, "index", 1.5, description_);
    if (!(index > 0) || !std::isfinite(index)) {
      diagnostics_.warning(p.loc("index"),
                           fmt::format("\"index\" is {}, but must be above 0: 1.5 is used", index));
      index = 1.5;
    }
    const double cauchy_b = volumes ? 0 : float_parameter(p, "cauchyb", 0, description_);
    if (cauchy_b != 0) {
      diagnostics_.warning(p.loc("cauchyb"),
                           "dispersion is not supported: one index is used for all colours");
      index += 1e6 * cauchy_b / (720. * 380.);
    }
    if (p.flag("architectural", false))
      diagnostics_.warning(p.loc("architectural"),
                           "\"architectural\" is not yet supported: light is refracted");
    if (rough) {
      diagnostics_.warning(
          plugin.loc, "material \"roughglass\" is not yet supported: rendered as smooth glass");
      p.accept({"uroughness", "vroughness", "dispersion"});
    } else if (volumes) {
      diagnostics_.warning(
          plugin.loc, "material \"glass2\" is not yet supported: rendered as glass of index 1.5");
      p.accept({"dispersion"});
    } else {
      accept_film(p);
    }
    made = add_glass(kr, kt, index);
  } else if (plugin.type == "null") {
    made = add<NullParameters>(MaterialKind::kNull, {0u});
  } else {
    made = build_unsupported(p);
  }
  accept_common(p);
  p.report_unused();
  return made;
}

MaterialRef MaterialCompiler::build_unsupported(Parameters& p) {
  const std::string& type = p.plugin().type;
  for (const Replacement& r : kReplacements) {
    if (r.type != type) continue;
    const glm::dvec3 color =
        r.color.empty() ? glm::dvec3(r.fallback) : reflectance(p, r.color, r.fallback);
    diagnostics_.warning(
        p.plugin().loc,
        fmt::format("material \"{}\" is not yet supported: rendered as matte with Kd {:.3g} {:.3g} "
                    "{:.3g}",
                    type, color.x, color.y, color.z),
        fmt::format("material \"{}\" is not yet supported", type));
    p.accept_all();
    return add_matte(color, 0);
  }
  diagnostics_.error(p.plugin().loc, fmt::format("unknown material \"{}\"{}: matte with Kd 0.9 is "
                                                 "used",
                                                 type, did_you_mean(type, material_types())));
  p.accept_all();
  return add_matte(glm::dvec3(.9), 0);
}

MaterialRef MaterialCompiler::compile(uint32_t entry) {
  const bool is_default = entry >= description_.materials.size();
  auto& done = done_[is_default ? description_.materials.size() : entry];
  if (!done)
    done = is_default ? add_matte(glm::dvec3(.9), 0) : build(description_.materials[entry].plugin);
  return *done;
}

void MaterialCompiler::finish(Scene& scene) {
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind) {
    scene.parameters[kind] = AlignedArray<uint32_t>(std::span<const uint32_t>(words_[kind]));
    scene.parameter_rows[kind] = rows_[kind];
  }
}

}  // namespace yat
