#pragma once
// Programs that make a material's parameters from textures: the compiled form, owned by the scene.
//
// A program is what materials of one kind have in common whose textures are alike but for numbers
// and images: it has a bin of its own, and a row of constants per material.

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/texture_step.h"
#include "scene/registry.h"
#include "soa/columns.h"

namespace yat {

struct TextureStep {
  StepKind kind = StepKind::kConstant;
  uint32_t variant = 0;                     ///< TextureStepView::variant
  std::vector<std::array<uint16_t, 3>> in;  ///< columns of each input's three channels
  std::vector<uint16_t> out;                ///< columns
  AlignedArray<uint32_t> constants;
  uint32_t rows = 0;  ///< of `constants`: 1 if all materials have the same
};

/// What textures want of a mesh's texture coordinates.
enum class UvUse : uint32_t {
  kUnread,
  kIfThere,  ///< bump maps: directions along the surface
  kNeeded,   ///< some step maps by them
};

/// TextureProgram::material of what makes no material, but the three bands of a light.
inline constexpr MaterialKind kNoMaterial = MaterialKind::kCount;
/// Fields and words of the record that a program makes.
inline RecordSize program_record(MaterialKind kind) {
  return kind == kNoMaterial ? RecordSize{3, 0} : parameters_size(kind);
}

struct TextureProgram {
  /// A field of the material's record and the column that holds it.
  struct Field {
    uint32_t field, column;
  };
  MaterialKind material = MaterialKind::kMatte;
  std::vector<TextureStep> steps;
  std::vector<Field> fields;
  /// Bump or normal map: steps of their own, which run before the others; a bump map's three times.
  std::vector<TextureStep> bump_steps;
  std::array<uint32_t, 3> bump_columns{};  ///< of the height, or of the normal's colour
  bool normal_map = false;
  AlignedArray<uint32_t> bump;  ///< BumpParameters; as many rows as materials
  uint32_t columns = 0;         ///< that the steps use
  UvUse uv = UvUse::kUnread;
  bool derivatives = false;           ///< some step reads SurfaceDerivatives
  AlignedArray<uint32_t> parameters;  ///< the material's records, as far as no texture gives them
  uint32_t rows = 0;                  ///< materials that share the program
  size_t bytes() const;
};

/// The texels of all images.
struct Texels {
  AlignedArray<uint32_t> words, levels;
  uint32_t images = 0;
  TexelView view() const { return {words.data(), levels.data()}; }
  size_t bytes() const { return words.bytes() + levels.bytes(); }
};

}  // namespace yat
