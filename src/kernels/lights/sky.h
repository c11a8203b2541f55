#pragma once
// A clear sky by its formula, drawn by the cells of a map that tabulates it.
//
// Source  Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", 1999, as in lxs 6.5.

#include "kernels/exponential.h"
#include "kernels/lights/map.h"

namespace yat::YAT_ISA {

template <class A>
struct SkyLight {
  using Row = SkyRow<Lanes<A>::template Of>;

  static YAT_INLINE ShadedPick<A> sample(const LightView& lights, const LightRowW<A>& row,
                                         const Mask<A>& of_kind, const Vec3<A>& receiver,
                                         const Float<A>& far, const Float<A>& u,
                                         const Float<A>& v) {
    const LightMapW<A> map = load_map<A>(lights, row, of_kind);
    const CellPick<A> drawn = pick_by_cells<A>(lights, map, of_kind, receiver, far, u, v);
    return {drawn.pick, colour(lights, load_sky(lights, row, of_kind), drawn.local)};
  }
  static YAT_INLINE SeenEnvironment<A> see(const LightView& lights, const LightRowW<A>& row,
                                           const Mask<A>& of_kind, const Vec3<A>& w, bool asked) {
    const LightMapW<A> map = load_map<A>(lights, row, of_kind);
    const MappedDirection<A> found = to_map<A>(map, w);
    return {colour(lights, load_sky(lights, row, of_kind), found.unit),
            asked ? pdf_by_cells<A>(lights, map, found) : Float<A>(0.f)};
  }

 private:
  static YAT_INLINE Row load_sky(const LightView& lights, const LightRowW<A>& row,
                                 const Mask<A>& of_kind) {
    if (lights.skies.count == 1) return broadcast<A>(lights.skies, 0);
    return gather<A>(lights.skies, only<A>(of_kind, as_uint<A>(row.b_x)));
  }

  /// Bands of the sky in a direction of light space.
  static YAT_INLINE ColourTriple<Float<A>> colour(const LightView& lights, const Row& sky,
                                                  const Vec3<A>& l) {
    const Float<A> zero(0.f), one(1.f), most(kSkyExponent);
    const Vec3<A> sun{sky.sun_x, sky.sun_y, sky.sun_z};
    const Float<A> over_cos = one / xsimd::max(l.z, Float<A>(kSkyHorizon));
    const Float<A> cos_gamma = dot(l, sun);
    // From sine and cosine: exact near the sun too.
    const Float<A> gamma = Float<A>(kTwoPi) * angle_in_turns<A>(cos_gamma, length(cross(l, sun)));
    const auto perez = [&](const Float<A>& scale, const Float<A>& a, const Float<A>& b,
                           const Float<A>& c, const Float<A>& d, const Float<A>& e) {
      return scale * (one + a * exponential<A>(xsimd::min(b * over_cos, most))) *
             (one + c * exponential<A>(xsimd::min(d * gamma, most)) + e * cos_gamma * cos_gamma);
    };
    const Float<A> luminance =
        xsimd::max(perez(sky.scale_l, sky.a_l, sky.b_l, sky.c_l, sky.d_l, sky.e_l), zero);
    const Float<A> x = perez(sky.scale_x, sky.a_x, sky.b_x, sky.c_x, sky.d_x, sky.e_x);
    const Float<A> y = perez(sky.scale_y, sky.a_y, sky.b_y, sky.c_y, sky.d_y, sky.e_y);
    const Float<A> over_y = luminance / y;
    const Float<A> big_x = x * over_y, big_z = (one - x - y) * over_y;
    // XYZ to Rec.709 (lxs 9); what lies outside its gamut is brought to the rim.
    const auto channel = [&](float of_x, float of_y, float of_z) {
      const Float<A> sum =
          Float<A>(of_x) * big_x + Float<A>(of_y) * luminance + Float<A>(of_z) * big_z;
      return xsimd::max(sum, zero);
    };
    const ColourTriple<Float<A>> rgb{channel(3.24097f, -1.53738f, -.49861f),
                                     channel(-.96924f, 1.87597f, .04156f),
                                     channel(.05563f, -.20398f, 1.05697f)};
    return bands_of<Float<A>>(
        rgb, lights.basis, [](const Float<A>& p, const Float<A>& q) { return xsimd::min(p, q); });
  }
};

}  // namespace yat::YAT_ISA
