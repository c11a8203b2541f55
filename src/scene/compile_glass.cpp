// Glass of all kinds (lxs 7.3).

#include <fmt/format.h>

#include <cmath>

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
  double index = float_parameter(p, "index", 1.5, compiler.description());
  if (!(index > 0) || !std::isfinite(index)) {
    p.diagnostics().warning(
        p.loc("index"), fmt::format("\"index\" is {}, but must be above 0: 1.5 is used", index));
    index = 1.5;
  }
  const double cauchy_b = float_parameter(p, "cauchyb", 0, compiler.description());
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

/// The option "architectural".
bool is_architectural(Parameters& p) {
  const bool is = p.flag("architectural", false);
  if (is)
    p.diagnostics().note(
        p.loc("architectural"),
        "architectural glass: paths go straight through it, shadow rays not yet; lamps behind it "
        "are found by chance only");
  return is;
}

}  // namespace

MaterialRef build_glass(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  const glm::vec3 kt = compiler.reflectance_bands(p, "Kt", 1);
  const double index = refractive_index(compiler, p);
  const Film film = read_film(compiler, p);
  if (is_architectural(p))
    return compiler.add<ArchitecturalGlassParameters>(
        MaterialKind::kArchitecturalGlass,
        {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index), film.thickness, film.index});
  if (film.thickness > 0)
    return compiler.add<GlassFilmParameters>(
        MaterialKind::kGlassFilm,
        {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index), film.thickness, film.index});
  return add_glass(compiler, kr, kt, index);
}

MaterialRef build_roughglass(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  const glm::vec3 kt = compiler.reflectance_bands(p, "Kt", 1);
  const double index = refractive_index(compiler, p);
  const double u = compiler.clamped(p, "uroughness", .001, 0, 1);
  const double v = compiler.clamped(p, "vroughness", .001, 0, 1);
  p.accept({"dispersion"});
  if (std::abs(index - 1) < kLeastIndexStep) return add_glass(compiler, kr, kt, index);
  return compiler.add<RoughGlassParameters>(
      MaterialKind::kRoughGlass,
      {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index), float(u), float(v)});
}

MaterialRef build_glass2(MaterialCompiler& compiler, Parameters& p) {
  p.diagnostics().warning(
      p.plugin().loc, "material \"glass2\" is not yet supported: rendered as glass of index 1.5");
  p.accept({"dispersion", "architectural"});
  return add_glass(compiler, glm::vec3(1), glm::vec3(1), 1.5);
}

}  // namespace yat
