#pragma once
// Images (lxs 8.3): (gain * interpolated texel)^gamma.
//
// In 0: s, t; t = 0 is the top row of the image, texel (i, j) covers [i, i+1) / w x [j, j+1) / h.
// In 1, filter 2 only: width of the footprint along s and t; the level is the one whose texels are
// as wide as the longer of the two in texels, linear in between (Williams 1983).
// Out: r, g, b; or a number, the weighted sum of the interpolated channels before gain and gamma.
//
// Form: texel format (2 bits), filter (2 bits: 0 nearest, 1 bilinear, 2 trilinear), 16: a number.
// Flags of the variant from bit 8: wrap (2 bits), 4: gamma is 1.

#include "kernels/texture.h"
#if defined(YAT_ISA)
#include "kernels/power.h"
#endif

namespace yat {

enum class ImageWrap : uint32_t { kRepeat, kBlack, kWhite, kClamp };
inline constexpr uint32_t kImageNumber = 16;       ///< bit of the form
inline constexpr uint32_t kImageLinear = 4u << 8;  ///< flag: gamma is 1
constexpr uint32_t image_variant(TexelFormat format, uint32_t filter, ImageWrap wrap) {
  return uint32_t(format) | filter << 2 | uint32_t(wrap) << 8;
}

template <template <class> class Of>
struct ImageParameters {
  Of<uint32_t> texels;         ///< word of TexelView where the finest level begins
  Of<uint32_t> width, height;  ///< of the finest level, > 0
  Of<uint32_t> image;          ///< row of TexelView::levels; trilinear
  Of<float> last_level;        ///< number of the coarsest; trilinear
  Of<float> gain;              ///< times the texel's stored number
  Of<float> gamma;
  Of<float> r, g, b, a;  ///< weights of the channels in a number
  YAT_FIELDS(texels, width, height, image, last_level, gain, gamma, r, g, b, a)
};
static_assert(all_fields_listed<ImageParameters>);

inline constexpr TextureTraits kImageTraits{.name = "image", .forms = 32};

#if defined(YAT_ISA)
namespace YAT_ISA {

/// Four channels as stored: 0..255, or the number itself. Formats of one channel use the first.
template <class A>
struct Texel {
  Float<A> c[4];
};

/// Texel (x, y) of a level whose tiles of 4 x 4 texels lie row by row, `across` of them in each.
template <class A, TexelFormat kFormat>
YAT_INLINE Texel<A> fetch(const uint32_t* words, const UInt<A>& texels, const UInt<A>& across,
                          const UInt<A>& x, const UInt<A>& y) {
  const UInt<A> three(3u);
  const UInt<A> number = ((((y >> 2) * across + (x >> 2)) << 4) | ((y & three) << 2)) | (x & three);
  Texel<A> texel{};
  if constexpr (kFormat == TexelFormat::kByte1) {
    const UInt<A> word = gather<A>(words, texels + (number >> 2));
    const UInt<A> byte = (word >> ((number & three) << 3)) & UInt<A>(255u);
    texel.c[0] = xsimd::to_float(xsimd::bitwise_cast<int32_t>(byte));
  } else if constexpr (kFormat == TexelFormat::kByte4) {
    const UInt<A> word = gather<A>(words, texels + number);
    for (int k = 0; k < 4; ++k)
      texel.c[k] = xsimd::to_float(
          xsimd::bitwise_cast<int32_t>(k < 3 ? (word >> (8 * k)) & UInt<A>(255u) : word >> 24));
  } else if constexpr (kFormat == TexelFormat::kFloat1) {
    texel.c[0] = as_float<A>(gather<A>(words, texels + number));
  } else {
    const UInt<A> at = texels + (number << 2);
    for (uint32_t k = 0; k < 4; ++k) texel.c[k] = as_float<A>(gather<A>(words, at + UInt<A>(k)));
  }
  return texel;
}

template <TexelFormat kFormat>
inline constexpr bool kOneChannel =
    kFormat == TexelFormat::kByte1 || kFormat == TexelFormat::kFloat1;
/// What white is as stored.
template <TexelFormat kFormat>
inline constexpr float kStoredOne =
    kFormat == TexelFormat::kByte1 || kFormat == TexelFormat::kByte4 ? 255.f : 1.f;

/// A texel's column or row, brought into the image.
template <class A>
struct Wrapped {
  UInt<A> index;  ///< below size, whatever the coordinate was
  Mask<A> outside;
};
template <class A>
YAT_INLINE Wrapped<A> wrap_index(const Int<A>& i, const UInt<A>& size, ImageWrap wrap) {
  const Int<A> zero(0), n = xsimd::bitwise_cast<int32_t>(size);
  Int<A> inside = i;
  if (wrap == ImageWrap::kRepeat) {
    // Coordinates are within one period.
    inside = xsimd::select(inside < zero, inside + n, inside);
    inside = xsimd::select(inside >= n, inside - n, inside);
  } else {
    inside = xsimd::max(inside, zero);
  }
  const UInt<A> last = size - UInt<A>(1u);
  return {xsimd::min(xsimd::bitwise_cast<uint32_t>(inside), last),
          mask_of<A>((i < zero) | (i >= n))};
}

/// A coordinate in texels of a level, for one axis: repeated into [0, size) or kept near it, so
/// that it fits an integer.
template <class A>
YAT_INLINE Float<A> texel_coordinate(const Float<A>& s, const Float<A>& size, ImageWrap wrap) {
  const Float<A> near = wrap == ImageWrap::kRepeat
                            ? s - xsimd::floor(s)
                            : xsimd::min(xsimd::max(s, Float<A>(-2.f)), Float<A>(3.f));
  return near * size;
}

template <class A>
struct Image {
  using Parameters = ImageParameters<Lanes<A>::template Of>;

  struct Level {
    UInt<A> texels, width, height;
  };

  template <TexelFormat kFormat>
  static YAT_INLINE Texel<A> fetch_wrapped(const TextureRow<A>& row, const Level& level,
                                           const Wrapped<A>& x, const Wrapped<A>& y,
                                           ImageWrap wrap) {
    const UInt<A> across = (level.width + UInt<A>(3u)) >> 2;
    Texel<A> texel =
        fetch<A, kFormat>(row.input.texels.words, level.texels, across, x.index, y.index);
    if (wrap == ImageWrap::kBlack || wrap == ImageWrap::kWhite) {
      const Float<A> border(wrap == ImageWrap::kWhite ? kStoredOne<kFormat> : 0.f);
      for (int k = 0; k < (kOneChannel<kFormat> ? 1 : 4); ++k)
        texel.c[k] = xsimd::select(x.outside | y.outside, border, texel.c[k]);
    }
    return texel;
  }

  template <TexelFormat kFormat>
  static YAT_INLINE Texel<A> nearest(const TextureRow<A>& row, const Level& level,
                                     const Float<A>& s, const Float<A>& t, ImageWrap wrap) {
    const Float<A> w = xsimd::to_float(xsimd::bitwise_cast<int32_t>(level.width));
    const Float<A> h = xsimd::to_float(xsimd::bitwise_cast<int32_t>(level.height));
    const Int<A> x = xsimd::to_int(xsimd::floor(texel_coordinate<A>(s, w, wrap)));
    const Int<A> y = xsimd::to_int(xsimd::floor(texel_coordinate<A>(t, h, wrap)));
    return fetch_wrapped<kFormat>(row, level, wrap_index<A>(x, level.width, wrap),
                                  wrap_index<A>(y, level.height, wrap), wrap);
  }

  template <TexelFormat kFormat>
  static YAT_INLINE Texel<A> bilinear(const TextureRow<A>& row, const Level& level,
                                      const Float<A>& s, const Float<A>& t, ImageWrap wrap) {
    const Float<A> half(.5f);
    const Float<A> w = xsimd::to_float(xsimd::bitwise_cast<int32_t>(level.width));
    const Float<A> h = xsimd::to_float(xsimd::bitwise_cast<int32_t>(level.height));
    const Float<A> x = texel_coordinate<A>(s, w, wrap) - half;
    const Float<A> y = texel_coordinate<A>(t, h, wrap) - half;
    const Float<A> x_floor = xsimd::floor(x), y_floor = xsimd::floor(y);
    const Float<A> fx = x - x_floor, fy = y - y_floor;
    const Int<A> x0 = xsimd::to_int(x_floor), y0 = xsimd::to_int(y_floor), one(1);
    const Wrapped<A> left = wrap_index<A>(x0, level.width, wrap);
    const Wrapped<A> right = wrap_index<A>(x0 + one, level.width, wrap);
    const Wrapped<A> top = wrap_index<A>(y0, level.height, wrap);
    const Wrapped<A> bottom = wrap_index<A>(y0 + one, level.height, wrap);
    const Texel<A> a = fetch_wrapped<kFormat>(row, level, left, top, wrap);
    const Texel<A> b = fetch_wrapped<kFormat>(row, level, right, top, wrap);
    const Texel<A> c = fetch_wrapped<kFormat>(row, level, left, bottom, wrap);
    const Texel<A> d = fetch_wrapped<kFormat>(row, level, right, bottom, wrap);
    Texel<A> texel{};
    for (int k = 0; k < (kOneChannel<kFormat> ? 1 : 4); ++k) {
      const Float<A> upper = xsimd::fma(fx, b.c[k] - a.c[k], a.c[k]);
      const Float<A> lower = xsimd::fma(fx, d.c[k] - c.c[k], c.c[k]);
      texel.c[k] = xsimd::fma(fy, lower - upper, upper);
    }
    return texel;
  }

  /// Level `number` (a whole float) of the image.
  static YAT_INLINE Level level(const TextureRow<A>& row, const Parameters& p,
                                const Float<A>& number) {
    const UInt<A> n = xsimd::bitwise_cast<uint32_t>(xsimd::to_int(number)), one(1u);
    const UInt<A> at = only<A>(row.present, (p.image * UInt<A>(kTexelLevels)) + n);
    return {gather<A>(row.input.texels.levels, at), xsimd::max(p.width >> n, one),
            xsimd::max(p.height >> n, one)};
  }

  template <TexelFormat kFormat>
  static YAT_INLINE Texel<A> trilinear(const TextureRow<A>& row, const Parameters& p,
                                       const Float<A>& s, const Float<A>& t, ImageWrap wrap) {
    const Float<A> zero(0.f), one(1.f);
    const Float<A> w = xsimd::to_float(xsimd::bitwise_cast<int32_t>(p.width));
    const Float<A> h = xsimd::to_float(xsimd::bitwise_cast<int32_t>(p.height));
    const Float<A> wide = xsimd::max(row.in(1, 0) * w, row.in(1, 1) * h);
    // Narrower than a texel, or not a number: the finest level.
    const Mask<A> coarse = wide > one;
    Float<A> place = log2_positive<A>(xsimd::select(coarse, wide, one));
    place = xsimd::min(xsimd::max(place, zero), p.last_level);
    const Float<A> below = xsimd::floor(place), f = place - below;
    const Texel<A> fine = bilinear<kFormat>(row, level(row, p, below), s, t, wrap);
    if (!any<A>(f > zero)) return fine;
    const Texel<A> next =
        bilinear<kFormat>(row, level(row, p, xsimd::min(below + one, p.last_level)), s, t, wrap);
    Texel<A> texel{};
    for (int k = 0; k < (kOneChannel<kFormat> ? 1 : 4); ++k)
      texel.c[k] = xsimd::fma(f, next.c[k] - fine.c[k], fine.c[k]);
    return texel;
  }

  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const Parameters& p, const TextureRow<A>& row) {
    constexpr auto kFormat = TexelFormat(kForm & 3);
    constexpr uint32_t kFilter = kForm >> 2 & 3;
    const auto wrap = ImageWrap(row.step.variant >> 8 & 3);
    const bool linear = (row.step.variant & kImageLinear) != 0;
    const Float<A> s = row.in(0, 0), t = row.in(0, 1);
    Texel<A> texel;
    if constexpr (kFilter == 0)
      texel = nearest<kFormat>(row, {p.texels, p.width, p.height}, s, t, wrap);
    else if constexpr (kFilter == 1)
      texel = bilinear<kFormat>(row, {p.texels, p.width, p.height}, s, t, wrap);
    else
      texel = trilinear<kFormat>(row, p, s, t, wrap);
    const auto decode = [&](const Float<A>& x) {
      const Float<A> scaled = xsimd::max(p.gain * x, Float<A>(0.f));
      return linear ? scaled : power<A>(scaled, p.gamma);
    };
    if constexpr ((kForm & kImageNumber) != 0) {
      if constexpr (kOneChannel<kFormat>)
        row.out(0, decode(texel.c[0]));
      else
        row.out(0,
                decode(p.r * texel.c[0] + p.g * texel.c[1] + p.b * texel.c[2] + p.a * texel.c[3]));
    } else if constexpr (kOneChannel<kFormat>) {
      row.out(0, decode(texel.c[0]));
    } else {
      row.out(Spectrum<A>{decode(texel.c[0]), decode(texel.c[1]), decode(texel.c[2])});
    }
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat
