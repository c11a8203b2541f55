#include <stdexcept>

#include "kernels/materials/all.h"
#include "kernels/textures/all.h"
#include "scene/registry.h"
#include "soa/columns.h"

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

TextureTraits texture_traits(StepKind kind) {
  switch (kind) {
#define YAT_TEXTURE(file, Type) \
  case StepKind::k##Type:       \
    return k##Type##Traits;
    YAT_TEXTURES(YAT_TEXTURE)
#undef YAT_TEXTURE
    case StepKind::kCount:
      break;
  }
  throw std::logic_error("texture_traits: no such texture kind");
}

RecordSize parameters_size(MaterialKind kind) {
  switch (kind) {
#define YAT_MATERIAL(file, Type) \
  case MaterialKind::k##Type:    \
    return {field_count<Type##Parameters>, row_words<Type##Parameters>};
    YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
    case MaterialKind::kCount:
      break;
  }
  throw std::logic_error("parameters_size: no such material kind");
}

RecordSize parameters_size(StepKind kind) {
  switch (kind) {
#define YAT_TEXTURE(file, Type) \
  case StepKind::k##Type:       \
    return {field_count<Type##Parameters>, row_words<Type##Parameters>};
    YAT_TEXTURES(YAT_TEXTURE)
#undef YAT_TEXTURE
    case StepKind::kCount:
      break;
  }
  throw std::logic_error("parameters_size: no such texture kind");
}

}  // namespace yat
