#pragma once
// Recorded rays for the traversal benchmarks.

#include <string>
#include <vector>

#include "bench_scenes.h"
#include "kernels/table.h"

namespace yat::bench {

/// Rays of one kind. Closest-hit rays have a unit direction; shadow rays are segments, t in (0, 1).
struct RaySet {
  std::string name;
  bool shadow = false;
  bool camera() const { return name == "camera"; }
  std::vector<Ray<Value>> rays;
};

/// The sets of a scene seen from its viewpoint, every surface white and matte, rows in wavefront
/// order:
///   camera              width x height pixels, one jittered sample each, in 8x8 tiles by 4x4
///                       quarters, as a render lists them
///   mirror              the camera rays reflected at their first hit
///   shadow 1, shadow 2  from the first and second hit to a point of the lamp, where it is in front
///   diffuse 1, 2, 3     cosine-distributed rays that leave the first, second and third hit
/// Sets without rays are left out. Deterministic: a fixed seed.
std::vector<RaySet> record_rays(const BenchScene& scene, const KernelTable& kernels,
                                const TreeView& tree, uint32_t width, uint32_t height);

}  // namespace yat::bench
