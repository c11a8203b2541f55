#pragma once
// The only thing that crosses from code built for one instruction set to the rest: a table of
// functions over columns. dispatch.h chooses one at start.
//
// Every kernel is noexcept, allocates nothing and knows no threads. Rows are independent
// (invariant 1); n = 0 is fine and touches nothing. Output columns must not overlap inputs, must be
// padded to kRowPad rows, and padding rows may be overwritten.

#include <cstddef>
#include <cstdint>

#include "kernels/texture_step.h"
#include "scene/compiled.h"
#include "scene/registry.h"
#include "soa/records.h"

namespace yat {

/// What a call did, for lane occupancy: rows / (steps * lanes) is the mean share of active lanes.
struct LaneCount {
  uint64_t rows = 0;   ///< lanes that did useful work
  uint64_t steps = 0;  ///< register-wide steps
};

/// Why a contribution or path was dropped (invariant 6).
enum class DropCause : uint32_t {
  kBsdf,
  kPdf,
  kLight,
  kTexture,
  kCamera,
  kCrossings,
  kOther,
  kCount
};
inline constexpr uint32_t kDropCauses = uint32_t(DropCause::kCount);

/// Dropped contributions of one worker, and the first few that can be replayed.
struct DropLog {
  static constexpr uint32_t kKept = 8;
  uint64_t count[kDropCauses] = {};
  uint32_t kept = 0;
  struct Entry {
    uint32_t pixel, sample, cause;
  } entry[kKept] = {};
  void add(DropCause cause, uint32_t pixel, uint32_t sample) noexcept {
    ++count[uint32_t(cause)];
    if (kept < kKept) entry[kept++] = {pixel, sample, uint32_t(cause)};
  }
};

/// Work memory of the traversal kernels, one per worker; see KernelTable::traversal_scratch_bytes.
struct Scratch {
  std::byte* memory = nullptr;  ///< aligned to 64
  size_t bytes = 0;
};

enum class SamplerKind : uint32_t {
  kIndependent,
  kSobol,
  kRegular,
  kJittered,
  kNRooks,
  kMultiJittered,
  kCorrelatedMultiJittered,
  kZSobol,
  kCount
};

/// What all random numbers of a render have in common. A bare seed will do for samplers without
/// sets.
struct DrawKey {
  uint32_t seed;
  /// Stratified samplers: columns x rows samples are spread together. zsobol: columns samples of a
  /// pixel follow each other, a power of two.
  uint32_t columns, rows;
  constexpr DrawKey(uint32_t s, uint32_t c = 8, uint32_t r = 8) : seed(s), columns(c), rows(r) {}
};

/// Named random dimensions, each a pair of numbers (kernels/rng.h says how they are spread).
/// Camera dimensions are drawn once per path, the others at every scattering vertex.
/// kChild, which child of a material that is made of others, also at surfaces that are only
/// crossed; kShadow, whether a faint shadow ray is traced, by hashing with every sampler.
enum class Dimension : uint32_t {
  kFilm,
  kLens,
  kLight,
  kChoice,
  kBsdf,
  kRoulette,
  kChild,
  kShadow,
  kCount
};
/// The dimension of light number `light` where every light is sampled; number 0 has the named one.
constexpr Dimension of_light(Dimension dimension, uint32_t light) {
  return Dimension(uint32_t(dimension) + light * uint32_t(Dimension::kCount));
}

/// Russian roulette: a path goes on with the chance min(1, kRouletteChance * largest channel of its
/// throughput), so that only paths below a third of the light that they began with play
/// (docs/decisions.md).
inline constexpr float kRouletteChance = 3;

/// How paths go, decided once per render.
struct TransportOptions {
  uint32_t max_depth = 16;  ///< vertex at which a path ends (lxs 4.7: 0 sees emitters only)
  uint32_t least_depth_after_scatter = 0;  ///< `direct` integrator: max_depth, so that a path goes
                                           ///< on through delta bounces only; else 0
  uint32_t roulette_depth = 1;    ///< first vertex at which Russian roulette may end a path
  bool hide_environment = false;  ///< from the camera; what it lights shows it
  uint32_t seed = 0;
  /// Shadow rays that may bring less than this [radiance, largest band] are traced with the chance
  /// min(1, what they may bring / shadow_bound), at least kLeastShadowChance; 0: all are traced.
  float shadow_bound = 0;
};
/// 4096 values of 24-bit numbers lie below it, so that the chance is known to 2.5e-4 of itself.
inline constexpr float kLeastShadowChance = 0x1p-12f;

/// Columns that a shade kernel appends to; each `*_count` is the next free row.
struct ShadeOutput {
  Ray<Column> rays;
  PathState<Column> paths;
  uint32_t path_count = 0;
  ShadowRay<Column> shadow_rays;
  uint32_t shadow_count = 0;
  uint32_t* finished = nullptr;  ///< slots whose path ended here
  uint32_t finished_count = 0;
};

/// Read-only inputs of a shade kernel: n dense rows of one bin.
struct ShadeInput {
  Surface<ConstColumn> surfaces;
  PathState<ConstColumn> paths;
  Randoms<ConstColumn> randoms;
  LightSample<ConstColumn> lights;  ///< null columns: no light is sampled in this bin
  ParameterView parameters;
  Tangent<ConstColumn> tangents = {};  ///< null columns: materials see any frame about the normal
  Coat<ConstColumn> coats = {};        ///< null columns: nothing lies over the material
  uint32_t light = 0;                  ///< number of the light, where every light is sampled
};

enum class GeometryKind : uint32_t {
  kTriangleFlat,
  kTriangleVertex,
  kSphere,
  kPlane,
  kQuadric,  ///< kQuadric + ShapeKind from here on
  kDisk,
  kTorus,
  kCount
};

/// Light kinds that have a sampling kernel of their own: the first ones, which most scenes have.
inline constexpr uint32_t kPlainLightKinds = 5;
inline constexpr uint32_t kPlainLights = kPlainLightKinds, kAnyLights = kPlainLightKinds + 1;
inline constexpr uint32_t kLightKernels = kAnyLights + 1;

struct KernelTable {
  const char* isa;  ///< "avx512"
  uint32_t lanes;   ///< W

  // -- generate ---------------------------------------------------------------------------------
  /// Two random numbers in [0,1) per row for `dimension` of the vertex path depth (low 16 bits of
  /// depth, for kChild all of it; null = 0). `second` may be null.
  void (*draw[uint32_t(SamplerKind::kCount)])(DrawKey sets, Dimension dimension,
                                              const uint32_t* pixel, const uint32_t* sample,
                                              const uint32_t* depth, float* first, float* second,
                                              uint32_t n) noexcept;
  /// Camera rays and fresh path states. film_u/v: position in the filter; lens_u/v may be null for
  /// a camera without a lens.
  void (*generate_camera_rays[uint32_t(CameraKind::kCount)])(
      const SceneView&, const CameraSample<ConstColumn>&, const float* film_u, const float* film_v,
      const float* lens_u, const float* lens_v, const Ray<Column>&, const PathState<Column>&,
      uint32_t n) noexcept;

  // -- intersect --------------------------------------------------------------------------------
  size_t (*traversal_scratch_bytes)(const TreeView&, uint32_t max_rays) noexcept;
  LaneCount (*intersect_closest)(const TreeView&, const Ray<ConstColumn>&, const Hit<Column>&,
                                 uint32_t n, const Scratch&) noexcept;
  /// The same answers to the bit, for rays of which 64 in a row lie close together, as camera rays
  /// do: each 64 go through the tree as one beam. Rays that do not are served slowly.
  LaneCount (*intersect_tiles)(const TreeView&, const Ray<ConstColumn>&, const Hit<Column>&,
                               uint32_t n, const Scratch&) noexcept;
  /// Analytic shapes: hits is in and out (the nearer one stays). `first_prim` is their first row.
  void (*intersect_spheres)(const Rows<SphereRow>&, uint32_t first_prim, const Ray<ConstColumn>&,
                            const Hit<Column>&, uint32_t n) noexcept;
  void (*intersect_planes)(const Rows<PlaneRow>&, uint32_t first_prim, const Ray<ConstColumn>&,
                           const Hit<Column>&, uint32_t n) noexcept;
  /// occluded[i] = 1 or 0. [1] honours block_occluders, [0] takes every triangle as an occluder.
  LaneCount (*intersect_shadow[2])(const TreeView&, const ShadowRay<ConstColumn>&,
                                   uint32_t* occluded, uint32_t n, const Scratch&) noexcept;
  /// Analytic occluders: occluded is in and out.
  void (*shadow_spheres)(const Rows<SphereRow>&, const ShadowRay<ConstColumn>&, uint32_t* occluded,
                         uint32_t n) noexcept;
  void (*shadow_planes)(const Rows<PlaneRow>&, const ShadowRay<ConstColumn>&, uint32_t* occluded,
                        uint32_t n) noexcept;

  // -- other analytic shapes --------------------------------------------------------------------
  /// Rows shapes.kinds[k], of kind k, one after the other: as
  /// intersect_spheres and shadow_spheres. `first_prim` is the primitive row of shape row 0.
  void (*intersect_shapes[kShapeKinds])(const ShapesView&, uint32_t first_prim,
                                        const Ray<ConstColumn>&, const Hit<Column>&,
                                        uint32_t n) noexcept;
  void (*shadow_shapes[kShapeKinds])(const ShapesView&, const ShadowRay<ConstColumn>&,
                                     uint32_t* occluded, uint32_t n) noexcept;
  /// Spheres and shapes by a tree over them: all of the scene, or its veils. Shadow rays take the
  /// scene's.
  size_t (*shape_scratch_bytes)(const TreeView&, uint32_t max_rays) noexcept;
  LaneCount (*intersect_shape_tree)(const GeometryView&, const TreeView&, const Ray<ConstColumn>&,
                                    const Hit<Column>&, uint32_t n, const Scratch&) noexcept;
  LaneCount (*shadow_shape_tree)(const GeometryView&, const ShadowRay<ConstColumn>&,
                                 uint32_t* occluded, uint32_t n, const Scratch&) noexcept;

  // -- instances: for scenes that have shared objects ---------------------------------------------
  size_t (*instance_scratch_bytes)(const InstancesView&, uint32_t max_rays) noexcept;
  /// Hits is in and out, as for analytic shapes; prim of a hit here is a row of
  /// InstancesView::triangles, and instance[i] the instance row, or kNone where the hit stays.
  LaneCount (*intersect_instances)(const InstancesView&, const Ray<ConstColumn>&,
                                   const Hit<Column>&, uint32_t* instance, uint32_t n,
                                   const Scratch&) noexcept;
  /// occluded is in and out. [1] honours block_occluders.
  LaneCount (*shadow_instances[2])(const InstancesView&, const ShadowRay<ConstColumn>&,
                                   uint32_t* occluded, uint32_t n, const Scratch&) noexcept;
  /// classify_hits where instance[i] says that the hit is in an instance.
  void (*classify_instance_hits)(const InstancesView&, const uint32_t* prim_bin,
                                 uint32_t first_lasting, uint32_t max_depth,
                                 const Hit<ConstColumn>&, const uint32_t* instance,
                                 const uint32_t* depth, uint32_t* bin, uint32_t n) noexcept;
  /// make_surfaces for bins of instanced triangles; [1] with vertex data.
  void (*make_instance_surfaces[2])(const SceneView&, const uint32_t* order,
                                    const Ray<ConstColumn>&, const Hit<ConstColumn>&,
                                    const uint32_t* instance, const PathState<ConstColumn>&,
                                    const Surface<Column>&, const PathState<Column>&,
                                    uint32_t n) noexcept;

  /// make_tangents for bins of instanced triangles; [1] with vertex data.
  void (*make_instance_tangents[2])(const SceneView&, const uint32_t* order,
                                    const uint32_t* instance, const Surface<ConstColumn>&,
                                    const Tangent<Column>&, uint32_t n) noexcept;

  // -- sort -------------------------------------------------------------------------------------
  /// bin[i] of each hit: prim_bin[prim]; 0 for a miss, and for a path at max_depth whose bin is
  /// below `first_lasting` (Scene::first_lasting_bin).
  void (*classify_hits)(const uint32_t* prim_bin, uint32_t first_lasting, uint32_t max_depth,
                        const Hit<ConstColumn>&, const uint32_t* depth, uint32_t* bin,
                        uint32_t n) noexcept;

  // -- shade ------------------------------------------------------------------------------------
  /// Surfaces and path states of rows order[0..n), dense.
  void (*make_surfaces[uint32_t(GeometryKind::kCount)])(
      const SceneView&, const uint32_t* order, const Ray<ConstColumn>&, const Hit<ConstColumn>&,
      const PathState<ConstColumn>&, const Surface<Column>&, const PathState<Column>&,
      uint32_t n) noexcept;
  /// Tangents of dense surfaces, for bins that need them.
  void (*make_tangents[uint32_t(GeometryKind::kCount)])(const SceneView&,
                                                        const Surface<ConstColumn>&,
                                                        const Tangent<Column>&,
                                                        uint32_t n) noexcept;
  /// Adds emission seen at surfaces with a light row, MIS-weighted against light sampling.
  void (*add_emission)(const SceneView&, const Surface<ConstColumn>&, const PathState<ConstColumn>&,
                       const SampleSum<Column>&, DropLog&, uint32_t n) noexcept;
  /// What rows order[0..n) that missed everything see of the environment: the rows' hits say which
  /// did, the others are left alone. MIS-weighted against light sampling.
  void (*add_environment)(const SceneView&, const uint32_t* order, const Ray<ConstColumn>&,
                          const Hit<ConstColumn>&, const PathState<ConstColumn>&,
                          const TransportOptions&, const SampleSum<Column>&, DropLog&,
                          uint32_t n) noexcept;
  /// Textured bins. `order` and `instance` are as for make_instance_surfaces; null for others.
  void (*make_derivatives)(const SceneView&, GeometryKind, const uint32_t* order,
                           const uint32_t* instance, const Surface<ConstColumn>&,
                           const PathState<ConstColumn>&, const SurfaceDerivatives<Column>&,
                           uint32_t n) noexcept;
  /// One step of a texture program.
  void (*run_texture[kStepKinds])(const TextureInput&, const TextureStepView&, uint32_t n) noexcept;
  /// Fields of parameter rows row[0..n) as columns, where columns[f] is not null; the table's rows
  /// are row_words apart.
  void (*spread_parameters)(const ParameterView&, uint32_t row_words, const uint32_t* row,
                            uint32_t* const* columns, uint32_t fields, uint32_t n) noexcept;
  /// Bump maps; constants are rows of BumpParameters by Surface::parameter. First surfaces a step
  /// further along dp/du (axis 0) or dp/dv (1) of each: pos, u and v of `moved` are written.
  void (*move_surfaces)(const Surface<ConstColumn>&, const SurfaceDerivatives<ConstColumn>&,
                        const ParameterView& bump, uint32_t axis, const Surface<Column>& moved,
                        uint32_t n) noexcept;
  /// Then shading normals bent by the heights [scene units] at the surfaces and a step further.
  void (*bend_normals)(const Surface<Column>&, const SurfaceDerivatives<ConstColumn>&,
                       const ParameterView& bump, const float* height, const float* height_u,
                       const float* height_v, uint32_t n) noexcept;
  /// Normal maps: shading normals from colours, 2 rgb - 1 along dp/du, dp/dv and the old normal.
  void (*map_normals)(const Surface<Column>&, const SurfaceDerivatives<ConstColumn>&,
                      const ParameterView& bump, const float* r, const float* g, const float* b,
                      uint32_t n) noexcept;
  /// One light per surface. [k < kPlainLightKinds]: scenes whose lights are all of kind k;
  /// [kPlainLights]: any mixture of those kinds; [kAnyLights]: of all kinds.
  void (*sample_lights[kLightKernels])(const SceneView&, const Surface<ConstColumn>&,
                                       const Randoms<ConstColumn>&, const LightSample<Column>&,
                                       uint32_t n) noexcept;
  /// The same three where the scene has a light tree; of the kernels for one kind of light, only
  /// that of triangles is there. all_around: lights on the other side of a surface count like those
  /// on wo's.
  void (*add_tree_emission)(const SceneView&, const Surface<ConstColumn>&,
                            const PathState<ConstColumn>&, const SampleSum<Column>&, DropLog&,
                            uint32_t n) noexcept;
  void (*add_tree_environment)(const SceneView&, const uint32_t* order, const Ray<ConstColumn>&,
                               const Hit<ConstColumn>&, const PathState<ConstColumn>&,
                               const TransportOptions&, const SampleSum<Column>&, DropLog&,
                               uint32_t n) noexcept;
  void (*sample_tree_lights[kLightKernels])(const SceneView&, const Surface<ConstColumn>&,
                                            const Randoms<ConstColumn>&, bool all_around,
                                            const LightSample<Column>&, uint32_t n) noexcept;

  // -- emission that varies over a light (kernels/varying_emission.h); only scenes with such lights
  /// As sample_lights[kAnyLights], [1] as sample_tree_lights[kAnyLights]; and the row of each
  /// light.
  void (*sample_varying_lights[2])(const SceneView&, const Surface<ConstColumn>&,
                                   const Randoms<ConstColumn>&, bool all_around,
                                   const LightSample<Column>&, uint32_t* light,
                                   uint32_t n) noexcept;
  /// Sampled points order[0..n) of lights whose emission a program makes, dense: pos, ns, u, v,
  /// prim and parameter (of the program) are written.
  void (*make_light_points)(const SceneView&, const uint32_t* light, const uint32_t* order,
                            const LightSample<ConstColumn>&, const Surface<Column>&,
                            uint32_t n) noexcept;
  /// Multiplies factor[0..2] by what the maps of the lights send out in the directions sign *
  /// direction[0..2] (unit); rows whose light has none are left alone, and may have the light
  /// kNone.
  void (*apply_emission_maps)(const SceneView&, const uint32_t* light,
                              const float* const* direction, float sign, float* const* factor,
                              uint32_t n) noexcept;
  /// out[c] = a[c] b[c] for three columns each.
  void (*multiply_colours)(const float* const* a, const float* const* b, float* const* out,
                           uint32_t n) noexcept;

  /// Direct light (if input.lights is given) and the next ray.
  void (*shade[kMaterialKinds])(const ShadeInput&, const TransportOptions&, ShadeOutput&, DropLog&,
                                uint32_t n) noexcept;
  /// Direct light alone, where several lights are sampled: of `output` only shadow rays are
  /// written. Null for materials that have no use for light samples.
  void (*connect[kMaterialKinds])(const ShadeInput&, const TransportOptions&, ShadeOutput&,
                                  DropLog&, uint32_t n) noexcept;

  // -- split: materials made of two others (kernels/split.h); null for other kinds --------------
  /// Per row: share[i] in [0,1], with which the second child is there, and the parameter rows of
  /// both. turned: the surfaces are seen from the other side.
  void (*split[kMaterialKinds])(const ParameterView&, const Surface<ConstColumn>&, bool turned,
                                float* share, uint32_t* first, uint32_t* second,
                                uint32_t n) noexcept;
  /// Rows of mixtures with unequal children: chance[i] in [0,1], with which the second is chosen.
  void (*chances)(const ParameterView&, const Surface<ConstColumn>&, const float* share,
                  float* chance, uint32_t n) noexcept;
  /// child[i] = 0 or 1, the second with this chance, by the number u[i] in [0,1), and the number
  /// that is left, in [0,1) again.
  void (*choose_child)(const float* chance, const float* u, uint32_t* child, float* left,
                       uint32_t n) noexcept;
  /// Rows order[0..n), dense; normals point to the other side where turned.
  void (*take_rows)(const Surface<ConstColumn>&, const PathState<ConstColumn>&, const float* u,
                    const uint32_t* order, bool turned, const Surface<Column>&,
                    const PathState<Column>&, float* u_out, uint32_t n) noexcept;

  /// The coats of a coating's rows.
  void (*coats)(const ParameterView&, const Surface<ConstColumn>&, const Coat<Column>&,
                uint32_t n) noexcept;
  /// Rows order[0..n) of them, dense.
  void (*take_coats)(const Coat<ConstColumn>&, const uint32_t* order, const Coat<Column>&,
                     uint32_t n) noexcept;
  /// Throughput of row i, which was order[i] and went to child 0 or 1, over the chance of that,
  /// times the child's share. share: of the second; null where both children are there in full.
  void (*weigh_child)(const float* share, const float* chance, const uint32_t* order,
                      uint32_t child, const PathState<Column>&, uint32_t n) noexcept;

  // -- veils: shadow rays through what lets a part of the light pass (kernels/veil.h) -----------
  /// Packs the shadow rays that are free so far; returns their number.
  uint32_t (*start_veils)(const ShadowRay<ConstColumn>&, const uint32_t* occluded,
                          const Ray<Column>&, const PathState<Column>&, uint32_t n) noexcept;
  /// The weights of two children: weight (1 - share), weight share.
  void (*share_weight)(const float* weight, const float* share, float* first, float* second,
                       uint32_t n) noexcept;
  /// Adds weight[i] times what the material lets pass unturned to r, g, b. Null where nothing does.
  void (*veil[kMaterialKinds])(const ParameterView&, const Surface<ConstColumn>&, bool turned,
                               const float* weight, float* r, float* g, float* b,
                               uint32_t n) noexcept;
  /// Appends from row `count` on what is left of the rays behind their veil; returns the new count.
  uint32_t (*pass_veils)(const Surface<ConstColumn>&, const PathState<ConstColumn>&, const float* r,
                         const float* g, const float* b, const Ray<Column>&,
                         const PathState<Column>&, uint32_t count, uint32_t n) noexcept;
  /// Adds rows of bin 0, which met no further veil, to their samples. A slot occurs at most once.
  void (*end_veils)(const uint32_t* bin, const PathState<ConstColumn>&, const SampleSum<Column>&,
                    uint32_t n) noexcept;

  // -- accumulate -------------------------------------------------------------------------------
  /// Adds shadow rays that are not occluded to their samples. A slot occurs at most once per call.
  void (*add_unoccluded)(const ShadowRay<ConstColumn>&, const uint32_t* occluded,
                         const SampleSum<Column>&, uint32_t n) noexcept;

  // -- for tests and benchmarks: the BSDF alone, per material, in the local frame (z = normal) ---
  struct BsdfBatch {
    const float *wo_x, *wo_y, *wo_z;  ///< unit, towards the viewer
    float *wi_x, *wi_y, *wi_z;        ///< unit, towards the light: in for evaluate, out for sample
    const float *u_lobe, *u, *v;      ///< in [0,1), sample only
    const uint32_t* parameter;        ///< parameter rows
    float *f_r, *f_g, *f_b;           ///< evaluate: f; sample: f |cos| / pdf (weight)
    float* pdf;                       ///< solid angle; 0 for delta lobes
  };
  void (*bsdf_evaluate[kMaterialKinds])(const ParameterView&, const BsdfBatch&,
                                        uint32_t n) noexcept;
  void (*bsdf_sample[kMaterialKinds])(const ParameterView&, const BsdfBatch&, uint32_t n) noexcept;
};

}  // namespace yat
