#pragma once
// Materials of the oracle. For each record NAMEParameters there are overloads
//
//   Vec evaluate(const NAMEParameters<Value>&, const LocalView&, const Vec& wi)   f, no cosine
//   double pdf(const NAMEParameters<Value>&, const LocalView&, const Vec& wi)
//   Bounce sample(const NAMEParameters<Value>&, const LocalView&, double lobe, double u, double v)
//
// of which delta materials have the last one only. Formulas are those of textbooks and of the scene
// format, not those of the kernels.

#include <cstring>

#include "kernels/materials/all.h"
#include "wavefront/reference_parts.h"

namespace yat::reference {

/// A row of a material's table.
template <template <template <class> class> class Record>
Record<Value> parameters(const Scene& scene, MaterialKind kind, uint32_t row) {
  const uint32_t* words = scene.parameters[uint32_t(kind)].data() + size_t(row) * row_words<Record>;
  Record<Value> out;
  for_each_field([&](auto index, auto& field) { std::memcpy(&field, words + index, 4); }, out);
  return out;
}

double largest(const Vec& c);
/// Oren, Nayar 1994 as in lxs 7.2: f pi / Kd; sigma in degrees, both directions above the surface.
double oren_nayar(double sigma, const Vec& wo, const Vec& wi);
Vec mirrored(const Vec& wo);

/// The microfacet lobe of lxs 7.1, for whom it is a part (reference_microfacet.cpp): without R F.
double lobe_value(double u, double v, const Vec& wo, const Vec& wi);
double lobe_distribution(double u, double v, const Vec& h);
double lobe_shadowing(double u, double v, double cos);
double lobe_pdf(double u, double v, const Vec& wo, const Vec& wi);
Vec lobe_direction(double u, double v, const Vec& wo, double x, double y);

// reference_materials.cpp
Bounce sample(const MirrorParameters<Value>&, const LocalView&, double, double, double);
Bounce sample(const GlassParameters<Value>&, const LocalView&, double lobe, double, double);
Bounce sample(const NullParameters<Value>&, const LocalView&, double, double, double);
// reference_microfacet.cpp
Bounce sample(const MirrorFilmParameters<Value>&, const LocalView&, double, double, double);
Bounce sample(const GlassFilmParameters<Value>&, const LocalView&, double lobe, double, double);
Bounce sample(const AbsorbingGlassParameters<Value>&, const LocalView&, double lobe, double,
              double);
Bounce sample(const ArchitecturalGlassParameters<Value>&, const LocalView&, double lobe, double,
              double);

/// What architectural glass lets pass, seen at this cosine of the shading normal.
Vec transmittance(const ArchitecturalGlassParameters<Value>&, double cos, bool outside);

// reference_diffuse.cpp
#define YAT_REFERENCE(Type)                                                      \
  Vec evaluate(const Type##Parameters<Value>&, const LocalView&, const Vec& wi); \
  double pdf(const Type##Parameters<Value>&, const LocalView&, const Vec& wi);   \
  Bounce sample(const Type##Parameters<Value>&, const LocalView&, double lobe, double u, double v);
YAT_REFERENCE(Matte)
YAT_REFERENCE(OrenNayar)
YAT_REFERENCE(MatteTranslucent)
YAT_REFERENCE(Velvet)
YAT_REFERENCE(Scatter)
// reference_coated.cpp
YAT_REFERENCE(Glossy)
YAT_REFERENCE(GlossySingle)
YAT_REFERENCE(GlossyLossy)
YAT_REFERENCE(GlossyTranslucent)
YAT_REFERENCE(CarPaint)
// reference_microfacet.cpp
YAT_REFERENCE(Metal)
YAT_REFERENCE(MetalIndex)
YAT_REFERENCE(MetalColour)
YAT_REFERENCE(ShinyMetal)
YAT_REFERENCE(RoughGlass)
YAT_REFERENCE(CookTorrance)
YAT_REFERENCE(CookTorranceSingle)
#undef YAT_REFERENCE

}  // namespace yat::reference
