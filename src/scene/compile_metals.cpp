// Mirrors and metals (lxs 7.2).

#include <algorithm>

#include "kernels/materials/cook_torrance.h"
#include "kernels/materials/metal.h"
#include "kernels/materials/metal_colour.h"
#include "kernels/materials/metal_index.h"
#include "kernels/materials/mirror.h"
#include "kernels/materials/mirror_film.h"
#include "kernels/materials/shiny_metal.h"
#include "scene/compile_fresnel.h"

namespace yat {

namespace {

struct Roughness {
  float u, v;
};
Roughness roughness(MaterialCompiler& compiler, Parameters& p) {
  const double u = compiler.clamped(p, "uroughness", .1, 0, 1);
  return {float(u), float(compiler.clamped(p, "vroughness", .1, 0, 1))};
}

template <template <template <class> class> class Record>
MaterialRef add_index(MaterialCompiler& compiler, MaterialKind kind, const IndexBands& i,
                      const Roughness& rough) {
  return compiler.add_rough<Record>(
      kind, {float(i.n[0]), float(i.n[1]), float(i.n[2]), float(i.k[0]), float(i.k[1]),
             float(i.k[2]), rough.u, rough.v});
}

/// YART's metal2 (lxs 12.6): Cook and Torrance's model, of which YART's own sum of an energy-losing
/// lobe and a fading diffuse part falls short. "fresnel" is its reflectance head-on.
MaterialRef build_yart_metal2(MaterialCompiler& compiler, Parameters& p) {
  const auto m = float(compiler.clamped(p, "uroughness", .001, 0, 1));
  p.accept({"vroughness", "Kr"});  // YART reads neither
  glm::vec3 kr;
  if (has_fresnel_texture(compiler, p)) {
    const Fresnel fresnel = fresnel_parameter(compiler, p);
    if (const auto* colour = std::get_if<FresnelColour>(&fresnel)) {
      kr = compiler.bands(colour->kr);
    } else {
      const IndexBands& index = std::get<IndexBands>(fresnel);
      for (size_t b = 0; b < 3; ++b)
        kr[int(b)] = float(reflectance_head_on(index.n[b], index.k[b]));
    }
  } else {
    kr = compiler.reflectance_bands(p, "fresnel", .5);
  }
  if (compiler.compensates())
    return compiler.add<CookTorranceParameters>(MaterialKind::kCookTorrance, {kr.x, kr.y, kr.z, m});
  return compiler.add<CookTorranceSingleParameters>(MaterialKind::kCookTorranceSingle,
                                                    {kr.x, kr.y, kr.z, m});
}

}  // namespace

Film read_film(MaterialCompiler& compiler, Parameters& p) {
  const double thickness = compiler.clamped(p, "film", 0, 0, 1e6);
  return {float(thickness), float(compiler.clamped(p, "filmindex", 1.5, 1, 10))};
}

MaterialRef build_mirror(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  const Film film = read_film(compiler, p);
  if (film.thickness > 0)
    return compiler.add<MirrorFilmParameters>(MaterialKind::kMirrorFilm,
                                              {kr.x, kr.y, kr.z, film.thickness, film.index});
  return compiler.add<MirrorParameters>(MaterialKind::kMirror, {kr.x, kr.y, kr.z});
}

MaterialRef build_metal(MaterialCompiler& compiler, Parameters& p) {
  const IndexBands index = named_metal(compiler, p);
  return add_index<MetalParameters>(compiler, MaterialKind::kMetal, index, roughness(compiler, p));
}

MaterialRef build_metal2(MaterialCompiler& compiler, Parameters& p) {
  if (compiler.description().dialect == Dialect::kYart) return build_yart_metal2(compiler, p);
  const Fresnel fresnel = fresnel_parameter(compiler, p);
  const Roughness rough = roughness(compiler, p);
  if (const auto* colour = std::get_if<FresnelColour>(&fresnel)) {
    const glm::vec3 kr = compiler.bands(colour->kr);
    return compiler.add_rough<MetalColourParameters>(MaterialKind::kMetalColour,
                                                     {kr.x, kr.y, kr.z, rough.u, rough.v});
  }
  // LuxRender takes the simpler formula where k is not below n everywhere.
  const IndexBands& index = std::get<IndexBands>(fresnel);
  const bool conductor =
      index.n[0] <= index.k[0] || index.n[1] <= index.k[1] || index.n[2] <= index.k[2];
  return conductor
             ? add_index<MetalParameters>(compiler, MaterialKind::kMetal, index, rough)
             : add_index<MetalIndexParameters>(compiler, MaterialKind::kMetalIndex, index, rough);
}

MaterialRef build_shinymetal(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kr = compiler.reflectance_bands(p, "Kr", 1);
  const glm::vec3 ks = compiler.reflectance_bands(p, "Ks", 1);
  const Roughness rough = roughness(compiler, p);
  const Film film = read_film(compiler, p);
  return compiler.add_rough<ShinyMetalParameters>(
      MaterialKind::kShinyMetal,
      {kr.x, kr.y, kr.z, ks.x, ks.y, ks.z, rough.u, rough.v, film.thickness, film.index});
}

}  // namespace yat
