#pragma once
// The texture stage: from a chunk of surfaces to the parameters that shading reads.
//
//   constants, Surface ─> [steps of the bin's program] ─> columns ─> ParameterView
//
// Fields that no texture gives are spread into columns beside them. A bump map comes first: it
// bends the shading normals of the surfaces.

#include <span>
#include <vector>

#include "kernels/table.h"
#include "scene/compile.h"
#include "soa/columns.h"

namespace yat {

class TextureStage {
 public:
  /// Room for the largest of the programs, which must live as long; none where there are none.
  /// basis: of the colours that they make.
  TextureStage(std::span<const TextureProgram> programs, const BandBasis& basis,
               const KernelTable& kernels, uint32_t chunk_rows);
  // Steps point into this object's own memory.
  TextureStage(const TextureStage&) = delete;
  TextureStage& operator=(const TextureStage&) = delete;

  /// What a chunk is seen with. order and instance: KernelTable::make_derivatives.
  struct Chunk {
    const SceneView& scene;
    GeometryKind geometry;
    const uint32_t* order;
    const uint32_t* instance;
    const Surface<Column>& surfaces;  ///< shading normals are written by bump maps
    const PathState<ConstColumn>& paths;
    uint32_t n;
  };
  /// Runs a program. The view holds until the next call.
  ParameterView run(uint32_t program, const Chunk& chunk);
  /// The same at points that no ray sees: of their surfaces pos, ns, u, v, prim and parameter are
  /// read. derivatives: null columns, or what programs that ask for them get.
  ParameterView run(uint32_t program, const Surface<ConstColumn>& points,
                    const SurfaceDerivatives<ConstColumn>& derivatives, const TexelView& texels,
                    uint32_t n);

  size_t bytes() const {
    return columns_.bytes() + derivatives_.bytes() + moved_.bytes() + heights_.bytes();
  }

 private:
  /// A program with its columns in this object's memory.
  struct Program {
    const TextureProgram* source;
    std::vector<TextureStepView> steps, bump_steps;
    std::vector<uint32_t*> spread;        ///< per field: where it is spread to, or null
    std::vector<const uint32_t*> fields;  ///< per field: its column
    uint32_t row_words;
    bool spreads;
  };

  TextureStepView view_of(const TextureStep& step);
  float* column(uint32_t c) { return columns_.data() + size_t(c) * stride_; }
  void bend(const Program& program, const Chunk& chunk, TextureInput& input);
  ParameterView run_steps(const Program& program, const TextureInput& input, uint32_t n);

  const KernelTable& kernels_;
  uint32_t stride_;
  BandBasis basis_;
  AlignedArray<float> columns_;
  Table<SurfaceDerivatives> derivatives_;
  AlignedArray<float> moved_;    ///< pos_x, pos_y, pos_z, u, v of surfaces a step further
  AlignedArray<float> heights_;  ///< at the surface, and a step along u and v
  std::vector<Program> programs_;
};

}  // namespace yat
