#pragma once
// Perlin's gradient noise and sums of it (lxs 8.5, A.5).

#include "kernels/math.h"
#include "kernels/textures/noise_table.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

template <class A>
YAT_INLINE UInt<A> permuted(const UInt<A>& i) {
  return gather<A>(kNoisePermutation, i & UInt<A>(255u));
}

/// The gradient of a lattice point, times the way from it.
template <class A>
YAT_INLINE Float<A> lattice_gradient(const UInt<A>& hash, const Float<A>& x, const Float<A>& y,
                                     const Float<A>& z) {
  const UInt<A> h = hash & UInt<A>(15u);
  const auto tail = (h == UInt<A>(12u)) | (h == UInt<A>(13u));
  const Float<A> a = xsimd::select(mask_of<A>((h < UInt<A>(8u)) | tail), x, y);
  const Float<A> b = xsimd::select(mask_of<A>((h < UInt<A>(4u)) | tail), y, z);
  // Bits 0 and 1 are the signs.
  return as_float<A>(as_uint<A>(a) ^ (h << 31)) +
         as_float<A>(as_uint<A>(b) ^ ((h & UInt<A>(2u)) << 30));
}

/// Noise at p, about -1..1, 0 at lattice points; of period 256. |p| below 2^22 keeps its precision.
template <class A>
YAT_INLINE Float<A> gradient_noise(const Vec3<A>& p) {
  const Float<A> one(1.f);
  // A whole number in float modulo 256: exact, and an integer whatever p is.
  const auto cell = [](const Float<A>& whole) {
    const Float<A> wrapped = whole - Float<A>(256.f) * xsimd::floor(whole * Float<A>(1.f / 256));
    return xsimd::bitwise_cast<uint32_t>(xsimd::to_int(wrapped));
  };
  const Float<A> fx = xsimd::floor(p.x), fy = xsimd::floor(p.y), fz = xsimd::floor(p.z);
  const UInt<A> ix = cell(fx), iy = cell(fy), iz = cell(fz), next(1u);
  const Float<A> x = p.x - fx, y = p.y - fy, z = p.z - fz;
  const Float<A> x1 = x - one, y1 = y - one, z1 = z - one;

  const UInt<A> a = permuted<A>(ix) + iy, b = permuted<A>(ix + next) + iy;
  const UInt<A> aa = permuted<A>(a) + iz, ab = permuted<A>(a + next) + iz;
  const UInt<A> ba = permuted<A>(b) + iz, bb = permuted<A>(b + next) + iz;
  const auto smooth = [](const Float<A>& t) {
    return t * t * t * (t * (t * Float<A>(6.f) - Float<A>(15.f)) + Float<A>(10.f));
  };
  const auto lerp = [](const Float<A>& t, const Float<A>& from, const Float<A>& to) {
    return xsimd::fma(t, to - from, from);
  };
  const Float<A> u = smooth(x), v = smooth(y), w = smooth(z);
  const Float<A> near = lerp(v,
                             lerp(u, lattice_gradient<A>(permuted<A>(aa), x, y, z),
                                  lattice_gradient<A>(permuted<A>(ba), x1, y, z)),
                             lerp(u, lattice_gradient<A>(permuted<A>(ab), x, y1, z),
                                  lattice_gradient<A>(permuted<A>(bb), x1, y1, z)));
  const Float<A> far = lerp(v,
                            lerp(u, lattice_gradient<A>(permuted<A>(aa + next), x, y, z1),
                                 lattice_gradient<A>(permuted<A>(ba + next), x1, y, z1)),
                            lerp(u, lattice_gradient<A>(permuted<A>(ab + next), x, y1, z1),
                                 lattice_gradient<A>(permuted<A>(bb + next), x1, y1, z1)));
  return lerp(w, near, far);
}

/// Sum over octaves k < octaves of roughness^k noise(1.99^k p), or of its magnitudes. The largest
/// number of octaves in any lane runs; a lane's own end earlier by weight 0.
template <class A, bool kMagnitudes>
YAT_INLINE Float<A> noise_octaves(Vec3<A> p, const Float<A>& roughness, const Float<A>& octaves) {
  Float<A> sum(0.f), weight(1.f), k(0.f);
  const Float<A> one(1.f), zero(0.f), step(1.99f);
  for (;;) {
    const Mask<A> on = k < octaves;
    if (!any<A>(on)) return sum;
    const Float<A> n = gradient_noise<A>(p);
    sum = sum + xsimd::select(on, weight * (kMagnitudes ? xsimd::abs(n) : n), zero);
    weight = weight * roughness;
    p = step * p;
    k = k + one;
  }
}

}  // namespace yat::YAT_ISA
