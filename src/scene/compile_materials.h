#pragma once
// Materials -> parameter tables (lxs 7). compile_materials.cpp knows which types there are; a
// family of types is one file with a function for each of them.

#include <array>
#include <compare>
#include <cstring>
#include <glm/vec3.hpp>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/compile_parts.h"

namespace yat {

/// Rows of Description::volumes on both sides of a shape, or kNone.
struct VolumesAround {
  uint32_t interior = kNone, exterior = kNone;
  auto operator<=>(const VolumesAround&) const = default;
};

/// About what a material gives back of the light that it gets, seen head-on, in bands, by a row of
/// its kind; half of what passes unturned; 1 where nothing is known, and of what is made of others.
glm::vec3 about_albedo(MaterialKind kind, const uint32_t* row);
/// The same of a coat with the reflectance ks head-on, or ks times that of a refractive index above
/// 0, over a base of this albedo.
glm::vec3 coated_albedo(const glm::vec3& ks, float index, const glm::vec3& base);
/// One number for that, by which children are chosen: that of the brightest band, at least an
/// eighth, as it may be wrong, and at most 1.
float brightness(const MaterialRef& material);

/// Turns material entries into parameter rows, each once.
class MaterialCompiler {
 public:
  MaterialCompiler(const Description& description, const ColourModel& colour,
                   const CompileOptions& options, Diagnostics& diagnostics)
      : description_(description),
        colour_(colour),
        compensates_(options.compensation != EnergyCompensation::kOff),
        diagnostics_(diagnostics),
        textures_(description, colour, diagnostics, options.image_bytes) {}

  /// entry: row of Description::materials, or kNone for the default matte. One material in several
  /// volumes is several rows if it looks at them.
  /// `shape`: object to world of the shape, which YART's textures are mapped by.
  MaterialRef compile(uint32_t entry, const VolumesAround& volumes = {},
                      const Matrix& shape = Matrix(1.));
  /// Moves the tables into the scene, whose centre must be known.
  void finish(Scene& scene);

  // -- For the families ---------------------------------------------------------------------------
  // A parameter may be a texture. Of one that varies over the surface these give about the mean;
  // where the traits of the kind that the material becomes name the parameter (MaterialTraits::
  // textured), its fields come from the texture instead. Elsewhere the mean stays, with a warning.

  /// Appends a row to the kind's table.
  template <template <template <class> class> class Record>
  MaterialRef add(MaterialKind kind, const Record<Value>& record) {
    auto& words = words_[uint32_t(kind)];
    const uint32_t row = rows_[uint32_t(kind)]++;
    words.resize(size_t(row + 1) * row_words<Record>);
    for_each_field(
        [&](auto index, const auto& field) {
          std::memcpy(&words[size_t(row) * row_words<Record> + index], &field, 4);
        },
        record);
    const MaterialTraits traits = material_traits(kind);
    const Passing passing = traits.see_through ? Passing::kAll
                            : traits.veil      ? Passing::kVeil
                                               : Passing::kSolid;
    return {.kind = kind,
            .row = row,
            .passing = passing,
            .albedo = about_albedo(kind, &words[size_t(row) * row_words<Record>])};
  }
  /// The same for a material with a lobe of two roughnesses.
  template <template <template <class> class> class Record>
  MaterialRef add_rough(MaterialKind kind, const Record<Value>& record) {
    MaterialRef ref = add(kind, record);
    ref.tangents = record.uroughness != record.vroughness;
    return ref;
  }
  /// A colour parameter in linear Rec.709, clamped to 0..1 with one warning.
  glm::dvec3 reflectance(Parameters& parameters, std::string_view name, double fallback);
  /// The same in the scene's bands.
  glm::vec3 reflectance_bands(Parameters& parameters, std::string_view name, double fallback);
  /// A colour of linear Rec.709 in the scene's bands.
  glm::vec3 bands(const glm::dvec3& rgb) const;
  /// A float parameter, clamped to [least, most] with one warning. Not a number: least.
  double clamped(Parameters& parameters, std::string_view name, double fallback, double least,
                 double most);
  /// The material that a string parameter names. Empty, and an error, if there is none.
  std::optional<MaterialRef> child(Parameters& parameters, std::string_view name);
  /// A material of `kind`, made of two others; `turned`, `unequal`: see MaterialSplit. Its albedo
  /// is the caller's.
  template <template <template <class> class> class Record>
  MaterialRef add_split(MaterialKind kind, const Record<Value>& record, const MaterialRef& first,
                        const MaterialRef& second, bool first_turned, bool second_turned,
                        bool unequal = false) {
    MaterialRef made = add<Record>(kind, record);
    made.split =
        split_row({{form_of(first), form_of(second)}, {first_turned, second_turned}, unequal});
    made.passing = first.passing == second.passing ? first.passing : Passing::kVeil;
    made.tangents = first.tangents || second.tangents;
    made.uv = std::max(first.uv, second.uv);
    return made;
  }

  /// Whether rough lobes that are not LuxRender's get back what their facets lose to each other.
  bool compensates() const { return compensates_; }
  static MaterialForm form_of(const MaterialRef& material) {
    return {material.kind, material.split, material.program};
  }
  /// Whether there is a coating in what the material is made of.
  bool has_coating(const MaterialForm& form) const;

  /// Of the shape that the material is built for.
  const VolumesAround& volumes() const { return volumes_; }

  /// Whether the parameter, read before, varies over the surface.
  bool varies(std::string_view name);

  const Description& description() const { return description_; }
  TextureCompiler& textures() { return textures_; }
  const ColourModel& colour() const { return colour_; }
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  MaterialRef compile_known(uint32_t entry, const VolumesAround& volumes);
  MaterialRef build(const Plugin& plugin);
  uint32_t split_row(const MaterialSplit& split);
  uint32_t split_depth(const MaterialForm& form) const;
  MaterialRef build_plugin(const Plugin& plugin);
  TexturePrograms::Bump read_bump(Parameters& parameters);
  /// The material with the fields that its traits name taken from what varies.
  MaterialRef bind_textures(Parameters& parameters, const MaterialRef& made);

  const Description& description_;
  const ColourModel& colour_;
  bool compensates_;
  Diagnostics& diagnostics_;
  TextureCompiler textures_;
  TexturePrograms programs_;
  VolumesAround volumes_;
  /// Empty: under way.
  std::map<std::pair<uint32_t, VolumesAround>, std::optional<MaterialRef>> done_;
  std::vector<MaterialSplit> splits_;
  std::array<std::vector<uint32_t>, kMaterialKinds> words_;
  std::array<uint32_t, kMaterialKinds> rows_{};
};

/// Lambert (sigma 0) or Oren-Nayar. kd: linear Rec.709, 0..1; sigma in degrees, 0..90.
MaterialRef add_matte(MaterialCompiler& compiler, const glm::dvec3& kd, double sigma_degrees);

/// Thin film on a mirror or glass.
struct Film {
  float thickness;  ///< [nm]; 0: none
  float index;      ///< >= 1
};
Film read_film(MaterialCompiler& compiler, Parameters& parameters);

// One function per type: reads the parameters, adds the row. What every material takes (bump maps,
// compositing switches) is read by the caller.
using BuildMaterial = MaterialRef (*)(MaterialCompiler&, Parameters&);

// compile_diffuse.cpp
MaterialRef build_matte(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_mattetranslucent(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_velvet(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_cloth(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_scatter(MaterialCompiler& compiler, Parameters& parameters);
// compile_coated.cpp
MaterialRef build_glossy(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_glossycoating(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_glossy_lossy(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_glossytranslucent(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_carpaint(MaterialCompiler& compiler, Parameters& parameters);
// compile_composite.cpp
MaterialRef build_mix(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_doubleside(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_layered(MaterialCompiler& compiler, Parameters& parameters);
// compile_metals.cpp
MaterialRef build_mirror(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_metal(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_metal2(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_shinymetal(MaterialCompiler& compiler, Parameters& parameters);
// compile_glass.cpp
MaterialRef build_glass(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_glass2(MaterialCompiler& compiler, Parameters& parameters);
MaterialRef build_roughglass(MaterialCompiler& compiler, Parameters& parameters);

}  // namespace yat
