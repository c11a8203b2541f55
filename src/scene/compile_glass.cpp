// Glass of all kinds (lxs 7.3).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <optional>

#include "kernels/materials/absorbing_glass.h"
#include "kernels/materials/architectural_glass.h"
#include "kernels/materials/glass.h"
#include "kernels/materials/glass_film.h"
#include "kernels/materials/rough_glass.h"
#include "scene/compile_fresnel.h"

namespace yat {

namespace {

/// Facets of glass cannot be told from a smooth surface where the index is as near to 1 as this,
/// and the half vector of refraction is lost in rounding.
constexpr double kLeastIndexStep = 1e-3;

double refractive_index(MaterialCompiler& compiler, Parameters& p) {
  double index = float_parameter(p, "index", 1.5, compiler.textures());
  if (!(index > 0) || !std::isfinite(index)) {
    p.diagnostics().warning(
        p.loc("index"), fmt::format("\"index\" is {}, but must be above 0: 1.5 is used", index));
    index = 1.5;
  }
  const double cauchy_b = float_parameter(p, "cauchyb", 0, compiler.textures());
  if (cauchy_b != 0) {
    p.diagnostics().warning(p.loc("cauchyb"),
                            "dispersion is not supported: one index is used for all colours");
    index += 1e6 * cauchy_b / (720. * 380.);
  }
  return index;
}

MaterialRef add_glass(MaterialCompiler& compiler, const glm::vec3& kr, const glm::vec3& kt,
                      double index) {
  return compiler.add<GlassParameters>(MaterialKind::kGlass,
                                       {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index)});
}

/// Parameters of smooth glass.
struct GlassColours {
  glm::vec3 kr, kt;  ///< bands
  double index;
  Film film;
};

/// "fresnel" of a volume; 1 where there is none.
double volume_index(MaterialCompiler& compiler, uint32_t volume) {
  if (volume == kNone) return 1;
  const VolumeEntry& entry = compiler.description().volumes[volume];
  Parameters p(entry.plugin, fmt::format("volume \"{}\"", entry.name), compiler.diagnostics());
  const double index = index_parameter(compiler, p, "fresnel", 1.5);
  if (index > 0 && std::isfinite(index)) return index;
  compiler.diagnostics().warning(
      p.loc("fresnel"),
      fmt::format("the index of {} is {}, but must be above 0: 1.5 is used", p.what(), index));
  return 1.5;
}

/// -ln(Kt) / depth of a colordepth texture (lxs 8.6), per channel [1/m]; empty if `parameter` is
/// not one.
std::optional<glm::dvec3> depth_absorption(MaterialCompiler& compiler, const Parameter* parameter) {
  const Description& description = compiler.description();
  if (!parameter || parameter->texture >= description.textures.size()) return std::nullopt;
  const TextureEntry& entry = description.textures[parameter->texture];
  if (entry.plugin.type != "colordepth") return std::nullopt;
  Parameters p(entry.plugin, fmt::format("texture \"{}\"", entry.name), compiler.diagnostics());
  const glm::dvec3 kt = color_parameter(p, "Kt", glm::dvec3(0.), description);
  const double depth = std::max(.001, double(p.number("depth", 1)));
  p.report_unused();
  return -glm::log(glm::clamp(kt, 1e-9, 1.)) / depth;
}

/// Absorption of the volume inside, in bands [1/m].
glm::dvec3 volume_absorption(MaterialCompiler& compiler, uint32_t volume) {
  if (volume == kNone) return glm::dvec3(0.);
  const VolumeEntry& entry = compiler.description().volumes[volume];
  Diagnostics& diagnostics = compiler.diagnostics();
  Parameters p(entry.plugin, fmt::format("volume \"{}\"", entry.name), diagnostics);
  p.accept({"fresnel", "g", "stepsize", "name"});
  const bool is_clear = entry.plugin.type == "clear";
  if (!is_clear && entry.plugin.type != "homogeneous" && entry.plugin.type != "heterogeneous")
    diagnostics.error(
        entry.plugin.loc,
        fmt::format("unknown volume \"{}\"{}: taken as homogeneous", entry.plugin.type,
                    did_you_mean(entry.plugin.type, {"clear", "homogeneous", "heterogeneous"})));
  const std::string_view name = is_clear ? "absorption" : "sigma_a";
  const std::optional<glm::dvec3> by_depth = depth_absorption(compiler, p.texture(name));
  const glm::dvec3 given =
      by_depth ? *by_depth : color_parameter(p, name, glm::dvec3(0.), compiler.description());
  if (!is_clear &&
      color_parameter(p, "sigma_s", glm::dvec3(0.), compiler.description()) != glm::dvec3(0.))
    diagnostics.warning(p.loc("sigma_s"),
                        "scattering in volumes is not supported: they absorb "
                        "only");
  p.report_unused();
  const glm::dvec3 sigma = glm::max(given, 0.);
  const double mean = (sigma.x + sigma.y + sigma.z) / 3;
  if (!(mean > 0) || !std::isfinite(mean)) return glm::dvec3(0.);
  // What remains after 1 / mean is a colour, which bands know.
  return -mean * glm::log(glm::max(glm::dvec3(compiler.bands(glm::exp(-sigma / mean))), 1e-30));
}

/// All smooth glass: the kernel that has what is asked for.
MaterialRef add_smooth(MaterialCompiler& compiler, Parameters& p, const GlassColours& c) {
  const auto& [kr, kt, index, film] = c;
  const glm::dvec3 sigma = volume_absorption(compiler, compiler.volumes().interior);
  const bool absorbs = sigma != glm::dvec3(0.), architectural = p.flag("architectural", false);
  if (absorbs && (architectural || film.thickness > 0))
    compiler.diagnostics().warning(p.plugin().loc,
                                   "glass that is architectural or has a thin film: the "
                                   "absorption of the volume inside is left out");
  if (architectural)
    return compiler.add<ArchitecturalGlassParameters>(
        MaterialKind::kArchitecturalGlass,
        {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index), film.thickness, film.index});
  if (film.thickness > 0)
    return compiler.add<GlassFilmParameters>(
        MaterialKind::kGlassFilm,
        {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index), film.thickness, film.index});
  if (absorbs)
    return compiler.add<AbsorbingGlassParameters>(MaterialKind::kAbsorbingGlass,
                                                  {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index),
                                                   float(sigma.x), float(sigma.y), float(sigma.z)});
  return add_glass(compiler, kr, kt, index);
}

}  // namespace

MaterialRef build_glass(MaterialCompiler& compiler, Parameters& p) {
  GlassColours c{compiler.reflectance_bands(p, "Kr", 1), compiler.reflectance_bands(p, "Kt", 1),
                 refractive_index(compiler, p), read_film(compiler, p)};
  return add_smooth(compiler, p, c);
}

MaterialRef build_roughglass(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  const glm::vec3 kt = compiler.reflectance_bands(p, "Kt", 1);
  const double index = refractive_index(compiler, p);
  const double u = compiler.clamped(p, "uroughness", .001, 0, 1);
  const double v = compiler.clamped(p, "vroughness", .001, 0, 1);
  p.accept({"dispersion"});
  if (std::abs(index - 1) < kLeastIndexStep) return add_glass(compiler, kr, kt, index);
  return compiler.add_rough<RoughGlassParameters>(
      MaterialKind::kRoughGlass,
      {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index), float(u), float(v)});
}

MaterialRef build_glass2(MaterialCompiler& compiler, Parameters& p) {
  p.accept({"dispersion"});
  const auto [interior, exterior] = compiler.volumes();
  if (interior == kNone && exterior == kNone)
    compiler.diagnostics().note(
        p.plugin().loc, "material \"glass2\" of a shape without Interior or Exterior: index 1");
  const double index = volume_index(compiler, interior) / volume_index(compiler, exterior);
  return add_smooth(compiler, p, {glm::vec3(1), glm::vec3(1), index, {0, 1}});
}

}  // namespace yat
