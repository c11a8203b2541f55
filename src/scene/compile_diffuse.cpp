// matte and what stands in for its kin (lxs 7.2).

#include <numbers>

#include "kernels/materials/matte.h"
#include "kernels/materials/oren_nayar.h"
#include "scene/compile_materials.h"

namespace yat {

MaterialRef add_matte(MaterialCompiler& compiler, const glm::dvec3& kd, double sigma_degrees) {
  const glm::vec3 c = compiler.bands(kd);
  if (sigma_degrees == 0)
    return compiler.add<MatteParameters>(MaterialKind::kMatte, {c.x, c.y, c.z});
  return compiler.add<OrenNayarParameters>(
      MaterialKind::kOrenNayar, {c.x, c.y, c.z, float(sigma_degrees * std::numbers::pi / 180)});
}

MaterialRef build_matte(MaterialCompiler& compiler, Parameters& p) {
  const glm::dvec3 kd = compiler.reflectance(p, "Kd", .9);
  return add_matte(compiler, kd, compiler.clamped(p, "sigma", 0, 0, 90));
}

MaterialRef build_mattetranslucent(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kr", .9);
}

MaterialRef build_velvet(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kd", .3);
}

MaterialRef build_cloth(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "warp_Kd", .5);
}

MaterialRef build_scatter(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kd", .9);
}

}  // namespace yat
