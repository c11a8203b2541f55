#pragma once
// What texture kernels read and write: plain views. A program is a list of steps over a chunk of
// surfaces; a step reads columns that earlier ones wrote and constants of the material, and writes
// columns (docs/architecture.md, "Textures").

#include <cstdint>

#include "kernels/colour_bands.h"
#include "scene/compiled.h"
#include "soa/records.h"

namespace yat {

inline constexpr uint32_t kTextureInputs = 5;   ///< most inputs of a step
inline constexpr uint32_t kTextureOutputs = 4;  ///< most columns that a step writes

/// One step. Columns hold a float per row of the chunk.
struct TextureStepView {
  /// Low byte: which form of the kind runs. Above: flags that a form reads once per call.
  uint32_t variant = 0;
  ParameterView constants;                  ///< rows by Surface::parameter, or one row for all
  const float* in[kTextureInputs][3] = {};  ///< a number stands in all three
  float* out[kTextureOutputs] = {};         ///< null: not wanted (the last ones only)
};

/// How a surface lies in texture space and how widely it is seen; for mip levels and bump maps.
template <template <class> class Of>
struct SurfaceDerivatives {
  Of<float> du_x, du_y, du_z;  ///< dp/du [scene units per unit of u]; 0 where there is no uv
  Of<float> dv_x, dv_y, dv_z;
  Of<float> width;  ///< diameter of what the ray stands for on the surface [scene units], >= 0
  YAT_FIELDS(du_x, du_y, du_z, dv_x, dv_y, dv_z, width)
};
static_assert(all_fields_listed<SurfaceDerivatives>);

/// How heights are turned into slopes, per material.
template <template <class> class Of>
struct BumpParameters {
  Of<float> distance;        ///< between lookups of the height along the surface [scene units], > 0
  Of<float> step_u, step_v;  ///< instead of it, in texture coordinates, where > 0: images
  YAT_FIELDS(distance, step_u, step_v)
};
static_assert(all_fields_listed<BumpParameters>);

/// What all steps of a program see: n dense rows of one bin. Surface::parameter is the row of the
/// program's constants.
struct TextureInput {
  Surface<ConstColumn> surfaces;
  SurfaceDerivatives<ConstColumn> derivatives;  ///< null columns: no step of the program asks
  TexelView texels;
  BandBasis basis;  ///< of reflectances: what kBands converts to
};

}  // namespace yat
