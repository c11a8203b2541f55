#pragma once
// Lights that do not shine evenly (kernels/varying_emission.h), for a chunk of rows: what a path
// sees of such a light, and what a light sample brings.

#include <vector>

#include "wavefront/textures.h"

namespace yat {

class EmissionStage {
 public:
  /// Memory is taken only where some light of the scene does not shine evenly.
  EmissionStage(const Scene& scene, const KernelTable& kernels, uint32_t chunk_rows);

  /// The chunk's paths, their throughput times what its surfaces emit over the radiance of their
  /// light row. Holds until the next call.
  PathState<ConstColumn> tint(const Bin& bin, const TextureStage::Chunk& chunk);

  /// Where sample_varying_lights writes the row of each light.
  uint32_t* lights() { return light_.data(); }
  /// Multiplies the weights of its samples by what their lights emit over the radiance of their
  /// rows. Images are looked up in their finest level.
  void scale(const SceneView& scene, const LightSample<Column>& samples, uint32_t n);

  size_t bytes() const {
    return textures_.bytes() + light_.bytes() + parameter_.bytes() + order_.bytes() +
           factor_.bytes() + tinted_.bytes() + points_.bytes() + at_a_point_.bytes();
  }

 private:
  /// Three columns of `of`.
  struct Columns {
    float* c[3];
  };
  Columns columns(AlignedArray<float>& of) const {
    return {{of.data(), of.data() + stride_, of.data() + 2 * size_t(stride_)}};
  }
  void fill_ones(uint32_t n);

  const KernelTable& kernels_;
  TextureStage textures_;
  uint32_t programs_;
  uint32_t stride_;
  bool by_direction_ = false;
  AlignedArray<uint32_t> light_;          ///< of each sample
  AlignedArray<uint32_t> parameter_;      ///< of each surface: row of its program's constants
  AlignedArray<uint32_t> order_;          ///< samples that one program works on
  AlignedArray<float> factor_, tinted_;   ///< three columns each
  Table<Surface> points_;                 ///< of the samples in order_
  Table<SurfaceDerivatives> at_a_point_;  ///< zeros: nothing is averaged over
};

}  // namespace yat
