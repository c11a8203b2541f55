// Materials that scatter diffusely (lxs 7.2).

#include <fmt/format.h>

#include <algorithm>

#include "kernels/materials/matte.h"
#include "kernels/materials/matte_translucent.h"
#include "kernels/materials/oren_nayar.h"
#include "kernels/materials/scatter.h"
#include "kernels/materials/velvet.h"
#include "scene/compile_materials.h"

namespace yat {

MaterialRef add_matte(MaterialCompiler& compiler, const glm::dvec3& kd, double sigma_degrees) {
  const glm::vec3 c = compiler.bands(kd);
  if (sigma_degrees == 0 && !compiler.varies("sigma"))
    return compiler.add<MatteParameters>(MaterialKind::kMatte, {c.x, c.y, c.z});
  return compiler.add<OrenNayarParameters>(MaterialKind::kOrenNayar,
                                           {c.x, c.y, c.z, float(sigma_degrees)});
}

MaterialRef build_matte(MaterialCompiler& compiler, Parameters& p) {
  const glm::dvec3 kd = compiler.reflectance(p, "Kd", .9);
  return add_matte(compiler, kd, compiler.clamped(p, "sigma", 0, 0, 90));
}

MaterialRef build_mattetranslucent(MaterialCompiler& compiler, Parameters& p) {
  const glm::dvec3 kr = compiler.reflectance(p, "Kr", 1), kt = compiler.reflectance(p, "Kt", 1);
  const double sigma = compiler.clamped(p, "sigma", 0, 0, 90);
  const bool conserve = p.flag("energyconserving", false);
  const glm::dvec3 sum = kr + kt;
  if (!conserve && std::max({sum.x, sum.y, sum.z}) > 1)
    p.diagnostics().note(
        p.plugin().loc,
        fmt::format("\"Kr\" and \"Kt\" of {} are {:.3g} {:.3g} {:.3g} together: it scatters more "
                    "light than it gets, as in LuxRender without \"energyconserving\"",
                    p.what(), sum.x, sum.y, sum.z));
  const glm::vec3 r = compiler.bands(kr), t = compiler.bands(kt);
  return compiler.add<MatteTranslucentParameters>(
      MaterialKind::kMatteTranslucent,
      {r.x, r.y, r.z, t.x, t.y, t.z, float(sigma), conserve ? 1.f : 0.f});
}

MaterialRef build_velvet(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kd = compiler.reflectance_bands(p, "Kd", .3);
  const auto p1 = float(float_parameter(p, "p1", -2, compiler.textures()));
  const auto p2 = float(float_parameter(p, "p2", 20, compiler.textures()));
  const auto p3 = float(float_parameter(p, "p3", 2, compiler.textures()));
  const auto thickness = float(compiler.clamped(p, "thickness", .1, 0, 1));
  return compiler.add<VelvetParameters>(MaterialKind::kVelvet,
                                        {kd.x, kd.y, kd.z, p1, p2, p3, thickness});
}

/// The weave is left out.
MaterialRef build_cloth(MaterialCompiler& compiler, Parameters& p) {
  const glm::dvec3 kd =
      .5 * (compiler.reflectance(p, "warp_Kd", .5) + compiler.reflectance(p, "weft_Kd", .5));
  p.accept({"presetname", "warp_Ks", "weft_Ks", "repeat_u", "repeat_v"});
  p.diagnostics().warning(
      p.plugin().loc,
      fmt::format("material \"cloth\" has no weave: rendered as matte with the mean of \"warp_Kd\" "
                  "and \"weft_Kd\", {:.3g} {:.3g} {:.3g}",
                  kd.x, kd.y, kd.z),
      "material \"cloth\" has no weave");
  return add_matte(compiler, kd, 0);
}

MaterialRef build_scatter(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kd = compiler.reflectance_bands(p, "Kd", .9);
  const glm::dvec3 g = color_parameter(p, "g", glm::dvec3(0.), compiler.textures());
  const double mean = (g.x + g.y + g.z) / 3;
  if (g.x != g.y || g.x != g.z)
    p.diagnostics().warning(
        p.loc("g"), fmt::format("\"g\" is one number for all colours here: {:.3g} is used", mean));
  return compiler.add<ScatterParameters>(MaterialKind::kScatter, {kd.x, kd.y, kd.z, float(mean)});
}

}  // namespace yat
