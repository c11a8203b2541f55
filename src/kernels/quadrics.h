#pragma once
// Analytic shapes: few per scene, so every ray is tested against each, W rays at a time.

#include "kernels/table.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

/// Row `r` of a table as plain values.
template <template <template <class> class> class Record>
YAT_INLINE Record<Value> read_row(const Rows<Record>& rows, uint32_t r) {
  Record<Value> out;
  const uint32_t* const words = rows.words + size_t(r) * row_words<Record>;
  for_each_field([words](auto field, auto& to) { __builtin_memcpy(&to, words + field, 4); }, out);
  return out;
}

template <class A>
struct RayLines {
  Float<A> org_x, org_y, org_z, dir_x, dir_y, dir_z;
};

template <class A, class Columns>
YAT_INLINE RayLines<A> load_lines(const Columns& rays, uint32_t row) {
  return {load<A>(rays.org_x, row), load<A>(rays.org_y, row), load<A>(rays.org_z, row),
          load<A>(rays.dir_x, row), load<A>(rays.dir_y, row), load<A>(rays.dir_z, row)};
}

/// Smallest t > 0 where the line meets the sphere; negative or NaN where it does not.
///
/// The discriminant comes from the distance of the line to the centre, not from b^2 - ac, and the
/// roots from q, so that nothing cancels (Haines, Guenther, Akenine-Moeller 2019, Ray Tracing Gems
/// chapter 7). Whether the origin is outside is the sign of |org - centre|^2 - radius^2, which is
/// off by 4 roundings; Surface::offset keeps spawned rays 32 ulp off, so that sign is right for
/// them: a ray that leaves outwards meets nothing, one that enters meets the far side.
template <class A>
YAT_INLINE Float<A> sphere_distance(const SphereRow<Value>& sphere, const RayLines<A>& ray) {
  const Float<A> zero(0.f), radius(sphere.radius);
  const Float<A> fx = ray.org_x - Float<A>(sphere.center_x);
  const Float<A> fy = ray.org_y - Float<A>(sphere.center_y);
  const Float<A> fz = ray.org_z - Float<A>(sphere.center_z);
  const Float<A> a = (ray.dir_x * ray.dir_x + ray.dir_y * ray.dir_y) + ray.dir_z * ray.dir_z;
  const Float<A> b = -((fx * ray.dir_x + fy * ray.dir_y) + fz * ray.dir_z);
  const Float<A> nearest = b / a;
  const Float<A> px = fx + nearest * ray.dir_x, py = fy + nearest * ray.dir_y,
                 pz = fz + nearest * ray.dir_z;
  const Float<A> distance2 = (px * px + py * py) + pz * pz;
  const Float<A> discriminant = radius * radius - distance2;
  const Float<A> c = ((fx * fx + fy * fy) + fz * fz) - radius * radius;
  const Float<A> root = xsimd::sqrt(a * xsimd::max(discriminant, zero));
  const Mask<A> forward = b >= zero;
  const Float<A> q = select<A>(forward, b + root, b - root);
  const Float<A> t0 = c / q, t1 = q / a;
  // Outside (c > 0) the roots have one sign, and t0 is the nearer; inside they differ in sign.
  const Float<A> inside = select<A>(forward, t1, t0);
  const Float<A> t = select<A>(c > zero, t0, inside);
  return select<A>(discriminant >= zero, t, Float<A>(-1.f));
}

template <class A>
YAT_INLINE Float<A> plane_distance(const PlaneRow<Value>& plane, const RayLines<A>& ray) {
  const Float<A> nx(plane.normal_x), ny(plane.normal_y), nz(plane.normal_z);
  const Float<A> height =
      Float<A>(plane.distance) - ((nx * ray.org_x + ny * ray.org_y) + nz * ray.org_z);
  const Float<A> speed = (nx * ray.dir_x + ny * ray.dir_y) + nz * ray.dir_z;
  return select<A>(speed != Float<A>(0.f), height / speed, Float<A>(-1.f));
}

/// Brings the nearer of the given hits and the hits at `row` back to `hits`.
template <class A>
YAT_INLINE void keep_nearer(const Float<A>& t, uint32_t prim, const Hit<Column>& hits,
                            uint32_t row) {
  const Float<A> t_old = load<A>(hits.t, row);
  const UInt<A> prim_old = load<A>(hits.prim, row), prim_new(prim);
  const Mask<A> nearer =
      (t > Float<A>(0.f)) & ((t < t_old) | ((t == t_old) & mask_of<A>(prim_new < prim_old)));
  store<A>(select<A>(nearer, t, t_old), hits.t, row);
  store<A>(select<A>(nearer, Float<A>(0.f), load<A>(hits.u, row)), hits.u, row);
  store<A>(select<A>(nearer, Float<A>(0.f), load<A>(hits.v, row)), hits.v, row);
  store<A>(select<A>(nearer, prim_new, prim_old), hits.prim, row);
}

/// See KernelTable. t in (0, hits.t]; u = v = 0 for these shapes.
template <class A>
void intersect_spheres(const Rows<SphereRow>& spheres, uint32_t first_prim,
                       const Ray<ConstColumn>& rays, const Hit<Column>& hits, uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const RayLines<A> ray = load_lines<A>(rays, row);
    for (uint32_t s = 0; s < spheres.count; ++s)
      keep_nearer<A>(sphere_distance<A>(read_row(spheres, s), ray), first_prim + s, hits, row);
  }
}

template <class A>
void intersect_planes(const Rows<PlaneRow>& planes, uint32_t first_prim,
                      const Ray<ConstColumn>& rays, const Hit<Column>& hits, uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const RayLines<A> ray = load_lines<A>(rays, row);
    for (uint32_t p = 0; p < planes.count; ++p)
      keep_nearer<A>(plane_distance<A>(read_row(planes, p), ray), first_prim + p, hits, row);
  }
}

template <class A>
YAT_INLINE void add_occlusion(const Float<A>& t, uint32_t* occluded, uint32_t row) {
  const Mask<A> hit = (t > Float<A>(0.f)) & (t < Float<A>(1.f));
  store<A>(load<A>(occluded, row) | select<A>(hit, UInt<A>(1u), UInt<A>(0u)), occluded, row);
}

template <class A>
void shadow_spheres(const Rows<SphereRow>& spheres, const ShadowRay<ConstColumn>& rays,
                    uint32_t* occluded, uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const RayLines<A> ray = load_lines<A>(rays, row);
    for (uint32_t s = 0; s < spheres.count; ++s) {
      const SphereRow<Value> sphere = read_row(spheres, s);
      if (sphere.occludes) add_occlusion<A>(sphere_distance<A>(sphere, ray), occluded, row);
    }
  }
}

template <class A>
void shadow_planes(const Rows<PlaneRow>& planes, const ShadowRay<ConstColumn>& rays,
                   uint32_t* occluded, uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const RayLines<A> ray = load_lines<A>(rays, row);
    for (uint32_t p = 0; p < planes.count; ++p) {
      const PlaneRow<Value> plane = read_row(planes, p);
      if (plane.occludes) add_occlusion<A>(plane_distance<A>(plane, ray), occluded, row);
    }
  }
}

}  // namespace yat::YAT_ISA
