#include "scene/graphics_state.h"

#include <fmt/format.h>

namespace yat {

std::string_view texture_kind_name(TextureKind kind) {
  constexpr std::string_view names[] = {"float", "color", "fresnel"};
  return names[size_t(kind)];
}

std::string_view block_begin_name(BlockKind kind) {
  constexpr std::string_view names[] = {"AttributeBegin", "TransformBegin", "ObjectBegin"};
  return names[size_t(kind)];
}

std::string_view block_end_name(BlockKind kind) {
  constexpr std::string_view names[] = {"AttributeEnd", "TransformEnd", "ObjectEnd"};
  return names[size_t(kind)];
}

void GraphicsState::begin_block(BlockKind kind, SourceLoc loc) {
  Block block{kind,       loc,
              ctm,        material,
              area_light, lasting_material,
              object,     interior,
              exterior,   reverse_orientation,
              {},         0,
              0};
  for (size_t k = 0; k < kTextureKinds; ++k) block.texture_marks[k] = textures[k].mark();
  block.material_mark = materials.mark();
  block.volume_mark = volumes.mark();
  blocks_.push_back(block);
}

void GraphicsState::restore(const Block& block) {
  ctm = block.ctm;
  if (block.kind == BlockKind::kTransform) return;
  lasting_material = block.lasting_material;
  if (dialect_ == Dialect::kYart) return;
  material = block.material;
  area_light = block.area_light;
  object = block.object;
  interior = block.interior;
  exterior = block.exterior;
  reverse_orientation = block.reverse_orientation;
  for (size_t k = 0; k < kTextureKinds; ++k) textures[k].undo_to(block.texture_marks[k]);
  materials.undo_to(block.material_mark);
  volumes.undo_to(block.volume_mark);
}

bool GraphicsState::end_block(BlockKind kind, SourceLoc loc) {
  size_t match = blocks_.size();
  while (match > 0 && blocks_[match - 1].kind != kind &&
         blocks_[match - 1].kind != BlockKind::kObject)
    --match;
  if (match == 0 || blocks_[match - 1].kind != kind) {
    diagnostics_.warning(loc, fmt::format("{} without {}, ignored, remove it", block_end_name(kind),
                                          block_begin_name(kind)));
    return false;
  }
  while (blocks_.size() >= match) {
    const Block& block = blocks_.back();
    if (blocks_.size() > match)
      diagnostics_.warning(
          loc, fmt::format("{} ends the block begun at {}, but {} at {} is still open, ended with "
                           "it, add {}",
                           block_end_name(kind), diagnostics_.place(blocks_[match - 1].loc),
                           block_begin_name(block.kind), diagnostics_.place(block.loc),
                           block_end_name(block.kind)));
    restore(block);
    blocks_.pop_back();
  }
  return true;
}

void GraphicsState::check_all_closed(SourceLoc world_end) const {
  for (const Block& block : blocks_)
    diagnostics_.warning(
        world_end,
        fmt::format("{} at {} is still open when the world ends, add {}",
                    block_begin_name(block.kind), diagnostics_.place(block.loc),
                    block_end_name(block.kind)),
        fmt::format("{} is still open when the world ends", block_begin_name(block.kind)));
}

}  // namespace yat
