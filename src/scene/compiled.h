#pragma once
// What kernels read: plain views of the compiled scene. Rows, not pointers; read-only while
// rendering; no containers here, so that kernel sources may include it.

#include <cstdint>

#include "scene/camera_view.h"
#include "scene/geometry_view.h"
#include "scene/instances_view.h"
#include "scene/light_rows.h"

namespace yat {

// ---- Textures --------------------------------------------------------------------------------

/// How a level's texels are stored: tiles of 4 x 4 texels, row by row, rows and columns padded to
/// whole tiles. Channels are r, g, b, a from the low byte or the first word on.
enum class TexelFormat : uint32_t {
  kByte1,   ///< four texels a word
  kByte4,   ///< a word a texel
  kFloat1,  ///< a word a texel
  kFloat4,  ///< four words a texel
};

inline constexpr uint32_t kTexelLevels = 16;

/// All images of the scene.
struct TexelView {
  const uint32_t* words = nullptr;
  const uint32_t* levels = nullptr;  ///< kTexelLevels a row: word where each level begins
};

// ---- Everything ------------------------------------------------------------------------------

/// A parameter table of one material kind; its record type is the kind's (kernels/materials).
struct ParameterView {
  const uint32_t* words = nullptr;
  uint32_t count = 0;
  /// Not null: field f of row i of the chunk is columns[f][i], and `words` is not read. What
  /// textures have made for a chunk comes so.
  const uint32_t* const* columns = nullptr;
};

inline constexpr uint32_t kMaxMaterialKinds = 64;

struct SceneView {
  GeometryView geometry;
  VeilView veils;
  InstancesView instances;  ///< rows.count = 0: none
  LightView lights;
  CameraView camera;
  FilterView filter;
  /// Of a sphere about the scene-space origin that holds the camera and everything but planes [m]:
  /// shadow rays to distant lights end far outside it.
  float radius = 1;
  TexelView texels;
  ParameterView parameters[kMaxMaterialKinds];  ///< indexed by MaterialKind
};

}  // namespace yat
