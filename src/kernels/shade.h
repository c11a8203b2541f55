#pragma once
// Shading: direct light through the BSDF, and the next ray. One kernel per material.
//
// Order of decisions for a row at vertex `depth`:
//   1. see-through materials: the path goes on behind the surface, whatever its depth. So do the
//      samples of veils that pass; 3 to 6 are for the others.
//   2. depth >= max_depth: the path ends (it came here for its emission).
//   3. light sampling (not for delta materials): a shadow ray, if it can bring anything. Faint
//      ones play roulette (TransportOptions::shadow_bound), by numbers that are hashes.
//   4. the next direction; a path of no weight ends.
//   5. Russian roulette from roulette_depth on: survival with q = min(1, kRouletteChance * largest
//      channel of the throughput), so that a survivor's throughput never grows above 1 /
//      kRouletteChance by it, and no colour is favoured.
//   6. the next ray, at vertex depth + 1 (or least_depth_after_scatter, if that is more).
// The throughput may be negative throughout (pixel filter with negative lobes): weights are judged
// before they meet it.

#include "kernels/coat.h"
#include "kernels/draw.h"
#include "kernels/drop.h"
#include "kernels/material.h"
#include "kernels/math.h"
#include "kernels/table.h"

namespace yat::YAT_ISA {

template <class A>
using PathStateW = PathState<Lanes<A>::template Of>;

/// The frame that materials see, and the side that the path is on.
template <class A>
struct ShadingFrame {
  Frame<A> frame;  ///< z: shading normal on wo's side
  Vec3<A> ng;      ///< geometric normal on wo's side
  BsdfView<A> view;

  static YAT_INLINE ShadingFrame of(const Vec3<A>& ng, const Vec3<A>& ns, const Vec3<A>& wo) {
    const Float<A> zero(0.f);
    ShadingFrame f;
    f.view.outside = dot(ng, wo) > zero;
    f.ng = select(f.view.outside, ng, -ng);
    const Vec3<A> turned = select(f.view.outside, ns, -ns);
    const Mask<A> above = dot(turned, wo) > zero;
    f.frame = Frame<A>::about(select(above, turned, f.ng));
    f.view.wo = f.frame.to_local(wo);
    // Rounding only: wo lies on the side of ng.
    f.view.wo.z = xsimd::max(f.view.wo.z, zero);
    return f;
  }

  /// Turns the frame so that x is along the tangent, as far as that lies across z.
  YAT_INLINE void align(const Vec3<A>& tangent, const Vec3<A>& wo) {
    const Vec3<A> x = normalize(tangent - dot(tangent, frame.z) * frame.z);
    const Mask<A> usable = is_finite<A>(sum_of_magnitudes(x));
    frame.x = select(usable, x, frame.x);
    frame.y = cross(frame.z, frame.x);
    view.wo = {dot(frame.x, wo), dot(frame.y, wo), view.wo.z};
  }
};

/// Where to start from a surface on the side of ng (unit, either side), `offset` off it.
template <class A>
YAT_INLINE Vec3<A> spawn_point(const Vec3<A>& pos, const Float<A>& offset, const Vec3<A>& ng,
                               const Mask<A>& same_side) {
  return pos + xsimd::select(same_side, offset, -offset) * ng;
}

/// How far a ray that starts there has come already on its own line since it crossed the surface,
/// whose normal it leaves at the cosine `cos` (either sign). Seen edge-on a plane would be
/// infinitely far; a curved surface is where it bends by as much as the offset.
template <class A>
YAT_INLINE Float<A> way_to_spawn(const Float<A>& offset, const Float<A>& cos) {
  constexpr float kLeastCos = 1.4e-3f;  // Root of the 32 roundings of an offset.
  return offset / xsimd::max(xsimd::abs(cos), Float<A>(kLeastCos));
}

template <class A>
YAT_INLINE Mask<A> is_finite_positive(const Spectrum<A>& c) {
  return is_finite_positive<A>(c.r) & is_finite_positive<A>(c.g) & is_finite_positive<A>(c.b);
}
template <class A>
YAT_INLINE Mask<A> is_finite(const Spectrum<A>& c) {
  return is_finite<A>(c.r) & is_finite<A>(c.g) & is_finite<A>(c.b);
}
template <class A>
YAT_INLINE Mask<A> is_not_black(const Spectrum<A>& c) {
  const Float<A> zero(0.f);
  return (c.r != zero) | (c.g != zero) | (c.b != zero);
}

/// Rows of a parameter table; one row is the same for all. `first` is the first of the chunk's rows
/// that they are for: where the view has columns, those are read from there on.
template <class A, template <template <class> class> class Record>
YAT_INLINE Record<Lanes<A>::template Of> load_parameters(const ParameterView& view,
                                                         const UInt<A>& row, uint32_t first = 0) {
  if (view.columns) {
    Record<Lanes<A>::template Of> out;
    for_each_field(
        [&](auto field, auto& to) {
          using T = typename std::remove_reference_t<decltype(to)>::value_type;
          to = xsimd::bitwise_cast<T>(load<A>(view.columns[field], first));
        },
        out);
    return out;
  }
  const Rows<Record> rows{view.words, view.count};
  return view.count == 1 ? broadcast<A>(rows, 0) : gather<A>(rows, row);
}

/// Appends rows of `active` lanes as next rays, the other lanes of `present` as finished slots.
template <class A>
YAT_INLINE void append_paths(const Vec3<A>& org, const Vec3<A>& dir, const PathStateW<A>& path,
                             const Mask<A>& alive, const Mask<A>& present, ShadeOutput& out) {
  Ray<Lanes<A>::template Of> ray;
  ray.org_x = org.x;
  ray.org_y = org.y;
  ray.org_z = org.z;
  ray.dir_x = dir.x;
  ray.dir_y = dir.y;
  ray.dir_z = dir.z;
  ray.t_max = Float<A>(kRayFar);
  store_packed<A>(ray, alive, out.rays, out.path_count);
  store_packed<A>(path, alive, out.paths, out.path_count);
  out.path_count += count_true<A>(alive);
  const Mask<A> ended = present & !alive;
  if (any<A>(ended)) {
    store_packed<A>(path.slot, ended, out.finished, out.finished_count);
    out.finished_count += count_true<A>(ended);
  }
}

/// Rows from i on as a material that scatters sees them.
template <class A, template <template <class> class> class Record>
struct ShadedRows {
  Mask<A> present, scatters;  ///< scatters: vertices below max_depth
  PathStateW<A> path;
  UInt<A> vertex;
  Vec3<A> pos, wo;
  Float<A> offset;
  Record<Lanes<A>::template Of> parameters;
  ShadingFrame<A> shading;

  YAT_INLINE ShadedRows(const ShadeInput& in, const TransportOptions& options, uint32_t i,
                        uint32_t n) {
    present = tail_mask<A>(i, n);
    path = load<A>(in.paths, i);
    vertex = path.depth & UInt<A>(0xffffu);
    scatters = present & mask_of<A>(vertex < UInt<A>(options.max_depth));
    pos = {load<A>(in.surfaces.pos_x, i), load<A>(in.surfaces.pos_y, i),
           load<A>(in.surfaces.pos_z, i)};
    const Vec3<A> ng{load<A>(in.surfaces.ng_x, i), load<A>(in.surfaces.ng_y, i),
                     load<A>(in.surfaces.ng_z, i)};
    const Vec3<A> ns{load<A>(in.surfaces.ns_x, i), load<A>(in.surfaces.ns_y, i),
                     load<A>(in.surfaces.ns_z, i)};
    wo = {load<A>(in.surfaces.wo_x, i), load<A>(in.surfaces.wo_y, i), load<A>(in.surfaces.wo_z, i)};
    offset = load<A>(in.surfaces.offset, i);
    parameters = load_parameters<A, Record>(in.parameters,
                                            only<A>(present, load<A>(in.surfaces.parameter, i)), i);
    shading = ShadingFrame<A>::of(ng, ns, wo);
    shading.view.distance = load<A>(in.surfaces.distance, i);
    if (in.tangents.x)
      shading.align(
          {load<A>(in.tangents.x, i), load<A>(in.tangents.y, i), load<A>(in.tangents.z, i)}, wo);
  }
};

/// Roulette of shadow rays below options.shadow_bound: survivors are as much brighter.
template <class A>
YAT_INLINE void drop_faint(const ShadeInput& in, const TransportOptions& options, uint32_t i,
                           const UInt<A>& depth, Mask<A>& active, Spectrum<A>& add) {
  const Float<A> most =
      largest<A>(Spectrum<A>{xsimd::abs(add.r), xsimd::abs(add.g), xsimd::abs(add.b)});
  const Float<A> bound(options.shadow_bound);
  const Mask<A> faint = active & (most < bound);
  if (!any<A>(faint)) return;
  const Float<A> chance = xsimd::max(most / bound, Float<A>(kLeastShadowChance));
  // Crossings count: every surface that a path crosses at a vertex may have a shadow ray.
  const UInt<A> key = random_key(options.seed, uint32_t(of_light(Dimension::kShadow, in.light)),
                                 UInt<A>(load<A>(in.paths.pixel, i)), depth);
  const Float<A> u =
      unit_float<A>(independent_words(key, UInt<A>(load<A>(in.paths.sample, i))).first);
  active = active & !(faint & (u >= chance));
  add = xsimd::select(faint, Float<A>(1.f) / chance, Float<A>(1.f)) * add;
}

/// Direct light of the rows: f |cos| L / pdf, weighted against the BSDF's own chance of finding
/// the light (power heuristic; lights without density count in full).
template <class A, template <class> class Material, template <template <class> class> class Record>
YAT_INLINE void append_shadow_rays(const ShadeInput& in, const TransportOptions& options,
                                   const ShadedRows<A, Record>& rows, uint32_t i, ShadeOutput& out,
                                   DropLog& log) {
  const Float<A> zero(0.f), one(1.f);
  const uint32_t *pixel = in.paths.pixel + i, *sample = in.paths.sample + i;
  const ShadingFrame<A>& shading = rows.shading;
  const PathStateW<A>& path = rows.path;
  Mask<A> active = rows.scatters;
  const LightSample<Lanes<A>::template Of> light = load<A>(in.lights, i);
  const Spectrum<A> arriving{light.weight_r, light.weight_g, light.weight_b};
  active = active & is_not_black<A>(arriving);
  const Vec3<A> wi{light.wi_x, light.wi_y, light.wi_z};
  const Vec3<A> wi_local = shading.frame.to_local(wi);
  const Float<A> geometric = dot(shading.ng, wi);
  // Reflection or transmission is for the geometric normal to say: where the shading normal says
  // otherwise, nothing arrives.
  const Mask<A> same_side = geometric > zero;
  active = active & !(geometric * wi_local.z <= zero);
  if (!any<A>(active)) return;

  Spectrum<A> f =
      xsimd::abs(wi_local.z) * Material<A>::evaluate(rows.parameters, shading.view, wi_local);
  if (in.coats.outside) f = f * coat_passes<A>(in.coats, i, shading.view.wo, wi_local);
  const Float<A> scattered = Material<A>::pdf(rows.parameters, shading.view, wi_local);
  const Float<A> share =
      xsimd::select(light.pdf > zero, power_heuristic<A>(light.pdf, scattered), one);
  drop_lanes<A>(active, !(is_finite_positive<A>(arriving) & is_finite_positive<A>(light.pdf)),
                DropCause::kLight, pixel, sample, log);
  drop_lanes<A>(active, !is_finite_positive<A>(f), DropCause::kBsdf, pixel, sample, log);
  drop_lanes<A>(active, !is_finite_positive<A>(scattered), DropCause::kPdf, pixel, sample, log);
  Spectrum<A> add =
      share * (f * arriving) * Spectrum<A>{path.throughput_r, path.throughput_g, path.throughput_b};
  active = active & is_not_black<A>(add);
  drop_lanes<A>(active, !is_finite<A>(add), DropCause::kOther, pixel, sample, log);
  drop_faint<A>(in, options, i, path.depth, active, add);

  const Vec3<A> org = spawn_point<A>(rows.pos, rows.offset, shading.ng, same_side);
  ShadowRay<Lanes<A>::template Of> ray;
  ray.org_x = org.x;
  ray.org_y = org.y;
  ray.org_z = org.z;
  ray.dir_x = light.to_x - org.x;
  ray.dir_y = light.to_y - org.y;
  ray.dir_z = light.to_z - org.z;
  ray.add_r = add.r;
  ray.add_g = add.g;
  ray.add_b = add.b;
  ray.slot = path.slot;
  store_packed<A>(ray, active, out.shadow_rays, out.shadow_count);
  out.shadow_count += count_true<A>(active);
}

/// See KernelTable::connect.
template <class A, template <class> class Material, template <template <class> class> class Record>
void connect(const ShadeInput& in, const TransportOptions& options, ShadeOutput& out, DropLog& log,
             uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>)
    append_shadow_rays<A, Material, Record>(in, options, ShadedRows<A, Record>(in, options, i, n),
                                            i, out, log);
}

/// See KernelTable::shade: materials that scatter.
template <class A, template <class> class Material, template <template <class> class> class Record,
          bool kDelta, bool kNeedsLobe, bool kNeedsDirection, bool kVeil>
void shade_scattering(const ShadeInput& in, const TransportOptions& options, ShadeOutput& out,
                      DropLog& log, uint32_t n) noexcept {
  const Float<A> zero(0.f), one(1.f);
  const bool sample_lights = !kDelta && in.lights.wi_x;
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const ShadedRows<A, Record> rows(in, options, i, n);
    const uint32_t *pixel = in.paths.pixel + i, *sample = in.paths.sample + i;
    const Mask<A>& present = rows.present;
    const Mask<A>& scatters = rows.scatters;
    const UInt<A>& vertex = rows.vertex;
    const ShadingFrame<A>& shading = rows.shading;
    PathStateW<A> path = rows.path;

    if constexpr (!kDelta)
      if (sample_lights) append_shadow_rays<A, Material, Record>(in, options, rows, i, out, log);

    const Float<A> lobe = kNeedsLobe ? load<A>(in.randoms.lobe, i) : zero;
    const Float<A> u = kNeedsDirection ? load<A>(in.randoms.bsdf_u, i) : zero;
    const Float<A> v = kNeedsDirection ? load<A>(in.randoms.bsdf_v, i) : zero;
    BsdfSample<A> next = Material<A>::sample(rows.parameters, shading.view, lobe, u, v);
    if (in.coats.outside)
      next.weight = next.weight * coat_passes<A>(in.coats, i, shading.view.wo, next.wi);
    Vec3<A> wi = shading.frame.to_scene(next.wi);
    // Repeated reflection would let rounding pile up in the length.
    if constexpr (kDelta) wi = normalize(wi);
    // Rows that go straight on, as through see-through surfaces.
    Mask<A> alive = scatters, passes(false);
    if constexpr (kVeil) {
      passes = next.wi.z < zero;
      wi = select(passes, -rows.wo, wi);
      alive = present & (scatters | passes);
      drop_lanes<A>(alive, passes & mask_of<A>(path.depth >= UInt<A>(0xffff0000u)),
                    DropCause::kCrossings, pixel, sample, log);
    }
    const Float<A> geometric = dot(shading.ng, wi);
    drop_lanes<A>(alive, ~(is_finite_positive<A>(next.weight) & is_finite<A>(geometric)),
                  DropCause::kBsdf, pixel, sample, log);
    drop_lanes<A>(alive, !is_finite_positive<A>(next.pdf), DropCause::kPdf, pixel, sample, log);
    alive = alive & (geometric * next.wi.z > zero);

    Spectrum<A> throughput =
        next.weight * Spectrum<A>{path.throughput_r, path.throughput_g, path.throughput_b};
    if (in.randoms.roulette) {
      const Mask<A> plays = mask_of<A>(vertex >= UInt<A>(options.roulette_depth)) & !passes;
      if (any<A>(plays & alive)) {
        const Float<A> brightest = largest<A>(Spectrum<A>{
            xsimd::abs(throughput.r), xsimd::abs(throughput.g), xsimd::abs(throughput.b)});
        const Float<A> chance =
            xsimd::select(plays, xsimd::min(Float<A>(kRouletteChance) * brightest, one), one);
        // A path without weight (chance 0) dies; a NaN lives on to be counted.
        alive = alive & !(load<A>(in.randoms.roulette, i) >= chance);
        throughput = (one / chance) * throughput;
      }
    }
    alive = alive & is_not_black<A>(throughput);
    drop_lanes<A>(alive, !is_finite<A>(throughput), DropCause::kOther, pixel, sample, log);

    [[maybe_unused]] const PathStateW<A> before = path;
    path.throughput_r = throughput.r;
    path.throughput_g = throughput.g;
    path.throughput_b = throughput.b;
    path.pdf = next.pdf;
    path.passed = zero;
    // What absorbs does so from the surface on.
    if constexpr (requires { Material<A>::kFilled; })
      path.passed = way_to_spawn<A>(rows.offset, geometric);
    UInt<A> next_vertex = vertex + UInt<A>(1u);
    if constexpr (!kDelta)
      next_vertex = xsimd::max(next_vertex, UInt<A>(options.least_depth_after_scatter));
    next_vertex = (path.depth & UInt<A>(0xffff0000u)) | next_vertex;
    if constexpr (kVeil) {
      // Density and distance stay those of the last vertex, from where shadow rays come too.
      path.pdf = xsimd::select(passes, before.pdf, path.pdf);
      path.passed = only<A>(passes, shading.view.distance);
      next_vertex = select<A>(passes, before.depth + UInt<A>(0x10000u), next_vertex);
    }
    path.depth = next_vertex;
    append_paths<A>(spawn_point<A>(rows.pos, rows.offset, shading.ng, geometric > zero), wi, path,
                    alive, present, out);
  }
}

/// See KernelTable::shade: see-through surfaces. The path keeps direction, pdf and vertex; the
/// distance so far is kept for MIS, and the crossings are counted.
template <class A>
void shade_see_through(const ShadeInput& in, const TransportOptions&, ShadeOutput& out,
                       DropLog& log, uint32_t n) noexcept {
  const Float<A> zero(0.f);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Mask<A> present = tail_mask<A>(i, n);
    PathStateW<A> path = load<A>(in.paths, i);
    Mask<A> alive = present;
    drop_lanes<A>(alive, mask_of<A>(path.depth >= UInt<A>(0xffff0000u)), DropCause::kCrossings,
                  in.paths.pixel + i, in.paths.sample + i, log);
    const Vec3<A> pos{load<A>(in.surfaces.pos_x, i), load<A>(in.surfaces.pos_y, i),
                      load<A>(in.surfaces.pos_z, i)};
    const Vec3<A> ng{load<A>(in.surfaces.ng_x, i), load<A>(in.surfaces.ng_y, i),
                     load<A>(in.surfaces.ng_z, i)};
    const Vec3<A> dir{-load<A>(in.surfaces.wo_x, i), -load<A>(in.surfaces.wo_y, i),
                      -load<A>(in.surfaces.wo_z, i)};
    path.passed = load<A>(in.surfaces.distance, i);
    path.depth = path.depth + UInt<A>(0x10000u);
    append_paths<A>(spawn_point<A>(pos, load<A>(in.surfaces.offset, i), ng, dot(ng, dir) > zero),
                    dir, path, alive, present, out);
  }
}

}  // namespace yat::YAT_ISA
