#pragma once
// The records that stages exchange. Positions and directions are in scene space: world axes, origin
// moved to the scene's centre (Scene::center), unit as in the scene file ("m" below). Colours are
// in the three transport bands of the scene (scene/colour_model.h): _r, _g, _b.
//
//   generate ─> Ray, PathState ─> intersect ─> Hit ─> [per bin: surface ─> Surface,
//   sample_lights ─> LightSample, shade ─> Ray, PathState, ShadowRay] ─> intersect_shadow
//   ─> accumulate ─> SampleSum ─> film

#include "soa/fields.h"

namespace yat {

/// A ray to find the nearest hit of, in (0, t_max].
template <template <class> class Of>
struct Ray {
  Of<float> org_x, org_y, org_z;  ///< origin, scene space [m], already off the surface it leaves
  Of<float> dir_x, dir_y, dir_z;  ///< unit direction
  Of<float> t_max;                ///< farthest hit wanted [m]; kRayFar when there is no limit
  YAT_FIELDS(org_x, org_y, org_z, dir_x, dir_y, dir_z, t_max)
};
static_assert(all_fields_listed<Ray>);

/// t_max of a ray without end: finite, so that arithmetic on it stays finite.
inline constexpr float kRayFar = 1e30f;

/// The nearest hit of a ray. On a miss prim = kNone and t = the ray's t_max.
template <template <class> class Of>
struct Hit {
  Of<float> t;        ///< distance along dir [m]
  Of<float> u, v;     ///< triangle: weights of vertices 1 and 2; analytic shapes: see their kernel
  Of<uint32_t> prim;  ///< primitive row, or kNone
  YAT_FIELDS(t, u, v, prim)
};
static_assert(all_fields_listed<Hit>);

/// What a path carries from vertex to vertex, beside its ray.
template <template <class> class Of>
struct PathState {
  Of<float> throughput_r, throughput_g,
      throughput_b;  ///< product of f cos / pdf, roulette included
  /// Solid-angle pdf with which the last scattering vertex chose this direction; 0 where the choice
  /// had no density (camera, mirror, glass): emission then counts in full.
  Of<float> pdf;
  /// Distance [m] from the last scattering vertex to this ray's origin, along the ray. 0 but after
  /// the path has crossed see-through (null) surfaces, which do not scatter, and within what
  /// absorbs, where the little counts by which rays start off their surface.
  Of<float> passed;
  Of<uint32_t> slot;    ///< row of SampleSum that this path adds to
  Of<uint32_t> pixel;   ///< y << 16 | x in the full image: key of the random numbers
  Of<uint32_t> sample;  ///< sample index in the pixel: key of the random numbers
  /// Low 16 bits: scattering vertices so far (0 on the camera ray). High 16: surfaces crossed.
  Of<uint32_t> depth;
  YAT_FIELDS(throughput_r, throughput_g, throughput_b, pdf, passed, slot, pixel, sample, depth)
};
static_assert(all_fields_listed<PathState>);

/// A hit made ready for shading. Rows are dense: row i belongs to the i-th row of the run.
template <template <class> class Of>
struct Surface {
  Of<float> pos_x, pos_y, pos_z;  ///< position, scene space [m], from barycentrics
  Of<float> ng_x, ng_y, ng_z;     ///< geometric normal, unit, the shape's outside (lxs 2.5)
  Of<float> ns_x, ns_y,
      ns_z;  ///< shading normal, unit; = ng where the mesh has none; same side as ng
  Of<float> wo_x, wo_y, wo_z;  ///< unit direction back along the ray
  /// How far [m] along the geometric normal a ray that leaves here must start: bounds the error of
  /// pos and of the next hit distance (docs/architecture.md, invariant 4).
  Of<float> offset;
  Of<float> distance;      ///< from the last scattering vertex [m] (hit.t + path.passed)
  Of<float> u, v;          ///< texture coordinates
  Of<uint32_t> prim;       ///< primitive row
  Of<uint32_t> parameter;  ///< row of this material kind's parameter table
  Of<uint32_t> light;      ///< row of the light table, or kNone
  YAT_FIELDS(pos_x, pos_y, pos_z, ng_x, ng_y, ng_z, ns_x, ns_y, ns_z, wo_x, wo_y, wo_z, offset,
             distance, u, v, prim, parameter, light)
};
static_assert(all_fields_listed<Surface>);

/// The direction of dp/du at a Surface row, for materials that are not the same all around the
/// normal. Only there where the bin needs it.
template <template <class> class Of>
struct Tangent {
  Of<float> x, y, z;  ///< unit, across ns, scene space
  YAT_FIELDS(x, y, z)
};
static_assert(all_fields_listed<Tangent>);

/// A coat over the material of a Surface row (kernels/coat.h). Only there below coatings.
template <template <class> class Of>
struct Coat {
  Of<float> r0_r, r0_g, r0_b;                 ///< reflectance head-on, 0..1
  Of<float> absorbs_r, absorbs_g, absorbs_b;  ///< optical thickness head-on, >= 0
  Of<uint32_t> outside;                       ///< 1: seen from the side of the coat; 0: from behind
  YAT_FIELDS(r0_r, r0_g, r0_b, absorbs_r, absorbs_g, absorbs_b, outside)
};
static_assert(all_fields_listed<Coat>);

/// Random numbers of one bounce, each in [0, 1). Columns that a plan does not need stay null.
template <template <class> class Of>
struct Randoms {
  Of<float> light_u, light_v;  ///< point on the light
  Of<float> light_choice;      ///< which light
  Of<float> lobe;              ///< which lobe of the BSDF
  Of<float> bsdf_u, bsdf_v;    ///< direction
  Of<float> roulette;          ///< Russian roulette
  YAT_FIELDS(light_u, light_v, light_choice, lobe, bsdf_u, bsdf_v, roulette)
};
static_assert(all_fields_listed<Randoms>);

/// A light chosen and sampled for a surface row.
template <template <class> class Of>
struct LightSample {
  Of<float> wi_x, wi_y, wi_z;  ///< unit direction towards the light
  Of<float> to_x, to_y, to_z;  ///< end point of the shadow ray, scene space [m], off the light
  Of<float> weight_r, weight_g,
      weight_b;   ///< emitted radiance / pdf; 0 where there is nothing to gain
  Of<float> pdf;  ///< solid angle, choice included; 0 for delta lights (no MIS)
  YAT_FIELDS(wi_x, wi_y, wi_z, to_x, to_y, to_z, weight_r, weight_g, weight_b, pdf)
};
static_assert(all_fields_listed<LightSample>);

/// A segment to test for occlusion, t in (0, 1) along (dir), and what it brings if it is free.
template <template <class> class Of>
struct ShadowRay {
  Of<float> org_x, org_y, org_z;  ///< start, scene space [m]
  Of<float> dir_x, dir_y, dir_z;  ///< end - start, not normalised [m]
  Of<float> add_r, add_g, add_b;  ///< radiance to add to the sample if nothing is in the way
  Of<uint32_t> slot;              ///< row of SampleSum
  YAT_FIELDS(org_x, org_y, org_z, dir_x, dir_y, dir_z, add_r, add_g, add_b, slot)
};
static_assert(all_fields_listed<ShadowRay>);

/// The radiance of one sample while its path is under way. Indexed by slot.
template <template <class> class Of>
struct SampleSum {
  Of<float> r, g, b;   ///< radiance [W/m2/sr], bands
  Of<uint32_t> pixel;  ///< film row (tile-local, chosen by the schedule)
  YAT_FIELDS(r, g, b, pixel)
};
static_assert(all_fields_listed<SampleSum>);

/// What the camera needs to start a path.
template <template <class> class Of>
struct CameraSample {
  Of<uint32_t> pixel;   ///< y << 16 | x in the full image
  Of<uint32_t> sample;  ///< sample index in the pixel
  Of<uint32_t> slot;    ///< row of SampleSum given to the path
  YAT_FIELDS(pixel, sample, slot)
};
static_assert(all_fields_listed<CameraSample>);

}  // namespace yat
