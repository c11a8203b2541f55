// Glass of all kinds (lxs 7.3).

#include <fmt/format.h>

#include <cmath>

#include "kernels/materials/glass.h"
#include "scene/compile_materials.h"

namespace yat {

namespace {

MaterialRef add_glass(MaterialCompiler& compiler, const glm::vec3& kr, const glm::vec3& kt,
                      double index) {
  return compiler.add<GlassParameters>(MaterialKind::kGlass,
                                       {kr.x, kr.y, kr.z, kt.x, kt.y, kt.z, float(index)});
}

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

void accept_architectural(Parameters& p) {
  if (p.flag("architectural", false))
    p.diagnostics().warning(p.loc("architectural"),
                            "\"architectural\" is not yet supported: light is refracted");
}

}  // namespace

MaterialRef build_glass(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  const glm::vec3 kt = compiler.reflectance_bands(p, "Kt", 1);
  const double index = refractive_index(compiler, p);
  accept_architectural(p);
  accept_film(p);
  return add_glass(compiler, kr, kt, index);
}

MaterialRef build_roughglass(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  const glm::vec3 kt = compiler.reflectance_bands(p, "Kt", 1);
  const double index = refractive_index(compiler, p);
  p.diagnostics().warning(p.plugin().loc,
                          "material \"roughglass\" is not yet supported: rendered as smooth glass");
  p.accept({"uroughness", "vroughness", "dispersion"});
  return add_glass(compiler, kr, kt, index);
}

MaterialRef build_glass2(MaterialCompiler& compiler, Parameters& p) {
  accept_architectural(p);
  p.diagnostics().warning(
      p.plugin().loc, "material \"glass2\" is not yet supported: rendered as glass of index 1.5");
  p.accept({"dispersion"});
  return add_glass(compiler, glm::vec3(1), glm::vec3(1), 1.5);
}

}  // namespace yat
