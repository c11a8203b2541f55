#pragma once
// What imagemap is by either dialect.

#include <array>

#include "kernels/textures/image.h"
#include "scene/compile_textures.h"

namespace yat {

enum class ImageFilter : uint32_t { kNearest, kBilinear, kTrilinear };

/// How an image's texels become a texture's value: (gain texel)^gamma.
struct ImageLook {
  ImageFilter filter = ImageFilter::kNearest;
  ImageWrap wrap = ImageWrap::kRepeat;
  double gain = 1, gamma = 1;
  bool colour = true;  ///< else a number, by the weights of r, g, b, a
  std::array<float, 4> weights = {};
  bool normal_map = false;  ///< its colours are numbers: no bands
};

/// The image that "filename" names, at s and t (and the footprint, for kTrilinear). White, and an
/// error, if it cannot be read.
TextureValue image_texture(TextureContext& c, const ImageLook& look, TextureGraph::Input at);

/// "color imagemap" as YART reads it (lxs 12.7).
TextureValue yart_imagemap(TextureContext& c);

}  // namespace yat
