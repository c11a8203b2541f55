// Diffuse bases under a glossy coat (lxs 7.3).

#include "scene/compile_materials.h"

namespace yat {

MaterialRef build_glossy(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kd", .9);
}

MaterialRef build_glossycoating(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "", .5);
}

MaterialRef build_glossy_lossy(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kd", .9);
}

MaterialRef build_glossytranslucent(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kd", .9);
}

MaterialRef build_carpaint(MaterialCompiler& compiler, Parameters& p) {
  return compiler.stand_in(p, "Kd", .5);
}

}  // namespace yat
