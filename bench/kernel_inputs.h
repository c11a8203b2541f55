#pragma once
// Columns as a render's stages see them, recorded from one turn of a small scene: camera rays,
// their hits and surfaces, the rays that leave those, and the shadow rays.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernels/dispatch.h"
#include "scene/compile.h"
#include "wavefront/plan.h"

namespace yat::bench {

/// Which lights the room has: a bit per LightKind; of those after the first ones, sun and sky.
using LightMask = uint32_t;
inline constexpr LightMask kAllLights = (1u << kPlainLightKinds) - 1;
inline constexpr LightMask kSkyLights = 1u << uint32_t(LightKind::kSky);

/// A room with every material and every kind of shape, and the lights asked for, as .lxs text.
std::string room_text(LightMask lights);

/// A room of 432 small balls, of two objects that are stored once: one of 220 triangles, one of
/// 1012 with vertex normals. As .lxs text.
std::string instances_text();

/// Rows that one kernel call gets.
inline constexpr uint32_t kRows = 8192;

/// Dense rows of one bin, with everything that a shade kernel reads.
struct ShadingRows {
  Bin bin;
  bool sample_lights = false;  ///< as the plan says
  uint32_t count = 0;
  AlignedArray<uint32_t> order;  ///< rows of the camera rays, with room for kRows
  Table<Surface> surfaces;
  Table<PathState> paths;
  Table<Randoms> randoms;
  Table<LightSample> lights;
};

/// All recorded columns for one kernel table. Recording goes as far as the table's kernels allow;
/// what it could not reach stays empty.
struct KernelInputs {
  Scene scene;
  SceneView view;
  Plan plan;
  const KernelTable* kernels = nullptr;

  Table<CameraSample> camera_samples;
  AlignedArray<float> film_u, film_v, lens_u, lens_v;
  Table<Ray> camera_rays, bounce_rays;
  Table<PathState> camera_paths;
  Table<Hit> camera_hits;
  AlignedArray<uint32_t> bin;
  AlignedArray<uint32_t> instance;  ///< of the camera hits, where the scene has instances
  uint32_t camera_count = 0, bounce_count = 0, shadow_count = 0;
  std::vector<ShadingRows> bins;  ///< those with rows
  Table<ShadowRay> shadow_rays;
  AlignedArray<uint32_t> occluded;

  /// Rows of the first bin that has this material, one that does not emit if there is one; or null.
  const ShadingRows* rows_of(MaterialKind material) const;
  const ShadingRows* emissive_rows() const;
  const ShadingRows* rows_of(GeometryKind geometry, bool instanced = false) const;
  /// Rows of a bin that is lit: its material is not a delta one.
  const ShadingRows* lit_rows() const;
};

/// Recorded once per table and light mask.
const KernelInputs& inputs_for(const KernelTable& kernels, LightMask lights);

/// The same of the scene with instances.
const KernelInputs& instance_inputs_for(const KernelTable& kernels);

/// The recorded turn's rows are as sparse in the batch as the share says: every row of a bin that
/// holds a quarter of the batch lies four rows from the next.
AlignedArray<uint32_t> sparse_order(const ShadingRows& rows, uint32_t share, uint32_t& n);

/// Memory for the traversal kernels over this scene and its instances, for kRows rays.
Scratch scratch_for(const KernelInputs& inputs);

}  // namespace yat::bench
