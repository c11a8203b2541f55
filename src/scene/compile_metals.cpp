// Mirrors and metals (lxs 7.2).

#include "kernels/materials/mirror.h"
#include "scene/compile_materials.h"

namespace yat {

MaterialRef build_mirror(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  accept_film(p);
  return compiler.add<MirrorParameters>(MaterialKind::kMirror, {kr.x, kr.y, kr.z});
}

MaterialRef build_metal(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "", .5);
}

MaterialRef build_metal2(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kr", .5);
}

MaterialRef build_shinymetal(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kr", .9);
}

}  // namespace yat
