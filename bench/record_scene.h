#pragma once
// The rays of a scene file, as yat's own stages make them.

#include <string>
#include <vector>

#include "base/error.h"
#include "ray_sets.h"

namespace yat::bench {

enum class RecordMaterials {
  kMatte,  ///< every surface white and matte: sets "diffuse 1", "diffuse 2", ...
  kScene,  ///< as the scene says: sets "path 1", "path 2", ...
};

struct RecordOptions {
  uint32_t width = 0, height = 0;  ///< 0: as the film says
  uint32_t samples = 0;   ///< per pixel; 0: as many as make about 512 x 512 rays, at least 1
  uint32_t vertices = 3;  ///< along a path; the last one has no shadow rays
  uint32_t seed = 0;
  RecordMaterials materials = RecordMaterials::kMatte;
  uint64_t camera_rays = 512 * 512;
};

/// What a ray file holds: triangles, in the frame of the rays, and the sets.
struct Recording {
  BenchScene scene;
  std::vector<RaySet> sets;
};

/// Compiles a scene and follows the paths of its camera, in wavefront order: as a
/// render lists them (wavefront/work.h), then by bins. Sets:
///   camera            the camera rays, those that miss everything included
///   mirror            reflected by the geometric normal at the first vertex
///   shadow k          from vertex k to a light, if the scene has any that can add something
///   diffuse k, path k from vertex k on
/// Sets without rays are left out. Spheres and planes are part of the paths, not of the triangles;
/// see-through triangles count as any others. Throws Error.
Recording record_scene(const std::string& path, const KernelTable& kernels,
                       const RecordOptions& options, Diagnostics& diagnostics);

}  // namespace yat::bench
