#pragma once
// Area lights that do not shine evenly: an L that is a texture, "mapname", "iesname".
//
//   AreaLightSource ─> EmissionCompiler ─> EmissionLook ─> EmissionRows ─> Scene::emission
//                              └> Scene::emission_programs

#include <vector>

#include "scene/compile_parts.h"
#include "scene/light_compiler.h"

namespace yat {

/// What varies of all area lights. The radiance of their light rows is a grey, of about the mean of
/// L; programs make L divided by that.
class EmissionCompiler {
 public:
  /// images: of the scene's textures.
  EmissionCompiler(const Description& description, const ColourModel& colour,
                   Diagnostics& diagnostics, ImageStore& images);

  /// See TextureCompiler.
  void set_shape(const Matrix& to_world) { textures_.set_shape(to_world); }
  bool saw_shape() const { return textures_.saw_shape(); }

  /// "L" and "gain". Where L varies over the surface: about its mean, as a grey, and the program in
  /// `look`.
  LightColor color(Parameters& p, EmissionLook& look);
  /// What the light says of directions: a number of distributions(), or kNone.
  uint32_t distribution(Parameters& p);

  const std::vector<LightPicture>& distributions() const { return distributions_; }
  /// Moves the programs into the scene, whose centre must be known. Before the textures of
  /// materials.
  void finish(Scene& scene);

 private:
  const Description& description_;
  const ColourModel colour_;  ///< lights' basis in place of reflectances'
  const BandBasis pictures_;  ///< of pictures over directions
  Diagnostics& diagnostics_;
  TextureCompiler textures_;
  TexturePrograms programs_;
  std::vector<LightPicture> distributions_;
};

}  // namespace yat
