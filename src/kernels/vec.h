#pragma once
// Three-vectors of SIMD words.

#include "soa/simd.h"

namespace yat::YAT_ISA {

template <class A>
struct Vec3 {
  Float<A> x, y, z;
};

template <class A>
YAT_INLINE Vec3<A> operator+(const Vec3<A>& a, const Vec3<A>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A>
YAT_INLINE Vec3<A> operator-(const Vec3<A>& a, const Vec3<A>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A>
YAT_INLINE Vec3<A> operator-(const Vec3<A>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class A>
YAT_INLINE Vec3<A> operator*(const Float<A>& s, const Vec3<A>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class A>
YAT_INLINE Float<A> dot(const Vec3<A>& a, const Vec3<A>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A>
YAT_INLINE Vec3<A> cross(const Vec3<A>& a, const Vec3<A>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class A>
YAT_INLINE Float<A> length(const Vec3<A>& a) {
  return xsimd::sqrt(dot(a, a));
}
/// NaN for a zero vector.
template <class A>
YAT_INLINE Vec3<A> normalize(const Vec3<A>& a) {
  return (Float<A>(1.f) / length(a)) * a;
}
template <class A>
YAT_INLINE Vec3<A> select(const Mask<A>& m, const Vec3<A>& a, const Vec3<A>& b) {
  return {xsimd::select(m, a.x, b.x), xsimd::select(m, a.y, b.y), xsimd::select(m, a.z, b.z)};
}
/// |x| + |y| + |z|.
template <class A>
YAT_INLINE Float<A> sum_of_magnitudes(const Vec3<A>& a) {
  return xsimd::abs(a.x) + xsimd::abs(a.y) + xsimd::abs(a.z);
}
template <class A>
YAT_INLINE Float<A> largest_magnitude(const Vec3<A>& a) {
  return xsimd::max(xsimd::max(xsimd::abs(a.x), xsimd::abs(a.y)), xsimd::abs(a.z));
}

/// Unit normal of the triangle with edges e1, e2 at one corner: towards e1 x e2. The edges are
/// scaled by their largest coordinate first, so that triangles of any size have one.
template <class A>
YAT_INLINE Vec3<A> triangle_normal(const Vec3<A>& e1, const Vec3<A>& e2) {
  const Float<A> scale = Float<A>(1.f) / xsimd::max(largest_magnitude(e1), largest_magnitude(e2));
  return normalize(cross(scale * e1, scale * e2));
}

/// A right-handed orthonormal frame about z. Source: Duff, Burgess, Christensen, Hery, Kensler,
/// Liani, Villemin, "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
template <class A>
struct Frame {
  Vec3<A> x, y, z;

  YAT_INLINE static Frame about(const Vec3<A>& n) {
    const Float<A> one(1.f);
    const Float<A> sign = xsimd::copysign(one, n.z);
    const Float<A> a = Float<A>(-1.f) / (sign + n.z);
    const Float<A> b = n.x * n.y * a;
    return {
        {one + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }
  YAT_INLINE Vec3<A> to_local(const Vec3<A>& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  YAT_INLINE Vec3<A> to_scene(const Vec3<A>& v) const {
    return {x.x * v.x + y.x * v.y + z.x * v.z, x.y * v.x + y.y * v.y + z.y * v.z,
            x.z * v.x + y.z * v.y + z.z * v.z};
  }
};

}  // namespace yat::YAT_ISA
