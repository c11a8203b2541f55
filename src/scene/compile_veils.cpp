// Veils: triangles that let a part of the light pass have a tree of their own, which shadow rays
// walk after nothing solid has stopped them.

#include <cstring>
#include <vector>

#include "scene/compile_parts.h"

namespace yat {

void build_veils(const TreeOptions& options, ThreadPool& pool, Scene& scene) {
  std::vector<uint32_t> veils;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (scene.bins[scene.prim_bin[t]].passing == Passing::kVeil) veils.push_back(t);
  if (veils.empty()) return;
  RowTable<TriangleRow> rows(uint32_t(veils.size()));
  for (uint32_t v = 0; v < veils.size(); ++v) rows.set(v, scene.triangles.row(veils[v]));
  scene.veils = build_tree(rows.view(), {}, options, pool);
  // Leaves name the triangles of the scene.
  const uint32_t width = scene.veils.view.block_width;
  for (uint32_t b = 0; b < scene.veils.view.block_count; ++b)
    for (uint32_t k = 0; k < width; ++k) {
      float* const word = scene.veils.blocks.data() + (size_t(b) * 10 + 9) * width + k;
      uint32_t prim;
      std::memcpy(&prim, word, 4);
      if (prim != kNone) std::memcpy(word, &veils[prim], 4);
    }
}

}  // namespace yat
