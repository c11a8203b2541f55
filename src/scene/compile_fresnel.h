#pragma once
// Fresnel textures and metal data -> what the kernels of metals take (lxs 8.7, A.3).

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "scene/compile_materials.h"

namespace yat {

/// Refractive index and extinction of the three bands.
struct IndexBands {
  std::array<double, 3> n{}, k{};
};
/// The colour of a fresnelcolor texture: linear Rec.709, 0..1.
struct FresnelColour {
  glm::dvec3 kr{0.};
};
using Fresnel = std::variant<IndexBands, FresnelColour>;

/// A metal by LuxRender's preset name; empty if there is none. n is that of the band's wavelength;
/// k is chosen so that the metal, lit by white, has the preset's colour head-on.
std::optional<IndexBands> metal_preset(std::string_view name, const MaterialCompiler& compiler);
/// n and k from the text of a SOPRA or Luxpop file at the bands' wavelengths, linear between
/// samples, constant beyond them. Empty, with the reason in `problem`, if it has no samples.
std::optional<IndexBands> read_metal_data(std::string_view text, std::string& problem);
/// Parameters "name" or "filename" of a metal or of a fresnel texture: the preset or file. Unknown
/// names and files that cannot be read: aluminium, with a warning.
IndexBands named_metal(MaterialCompiler& compiler, Parameters& parameters);
/// "fresnel" of metal2: a fresnel texture, a number (a dielectric's index), or a colour; "Kr" in
/// its place is taken likewise (lxs 7.4). Otherwise a dielectric of index 5.
Fresnel fresnel_parameter(MaterialCompiler& compiler, Parameters& parameters);
/// Whether "fresnel" is a texture of the class fresnel.
bool has_fresnel_texture(const MaterialCompiler& compiler, const Parameters& parameters);
/// ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
double reflectance_head_on(double n, double k);
/// A fresnel texture whose index is wanted (volumes): n at the middle of the spectrum.
double index_parameter(MaterialCompiler& compiler, Parameters& parameters, std::string_view name,
                       double fallback);

}  // namespace yat
