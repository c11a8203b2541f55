#include <stdexcept>

#include "kernels/materials/all.h"
#include "scene/registry.h"

namespace yat {

MaterialTraits material_traits(MaterialKind kind) {
  switch (kind) {
#define YAT_MATERIAL(file, Type) \
  case MaterialKind::k##Type:    \
    return k##Type##Traits;
    YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
    case MaterialKind::kCount:
      break;
  }
  throw std::logic_error("material_traits: no such material kind");
}

}  // namespace yat
