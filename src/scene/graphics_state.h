#pragma once
// The state that directives change and shapes take over: transform, current material and lamp,
// visible names, and the blocks that save and restore them (lxs 2.3).

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/description.h"
#include "scene/scoped_names.h"

namespace yat {

inline constexpr uint32_t kNoRow = 0xffffffffu;

enum class TextureKind { kFloat, kColor, kFresnel };
inline constexpr size_t kTextureKinds = 3;
std::string_view texture_kind_name(TextureKind kind);

enum class BlockKind { kAttribute, kTransform, kObject };
std::string_view block_begin_name(BlockKind kind);
std::string_view block_end_name(BlockKind kind);

class GraphicsState {
 public:
  GraphicsState(Dialect dialect, Diagnostics& diagnostics)
      : dialect_(dialect), diagnostics_(diagnostics) {}

  Matrix ctm{1.0};
  uint32_t material = kNoRow;
  uint32_t area_light = kNoRow;
  uint32_t interior = kNoRow, exterior = kNoRow;  ///< volumes
  /// YART: what `material` would be if shapes did not use it up and blocks kept it.
  uint32_t lasting_material = kNoRow;
  bool reverse_orientation = false;
  ScopedNames textures[kTextureKinds];
  ScopedNames materials;
  ScopedNames volumes;
  // LuxRender keeps these two for the whole scene, whatever the blocks.
  ScopedNames objects;
  std::map<std::string, Matrix, std::less<>> coordinate_systems;

  /// A block saves all but the names that last for the whole scene; in YART's rules, and a
  /// TransformBegin in both, only the CTM.
  void begin_block(BlockKind kind, SourceLoc loc);
  /// Ends the innermost block of that kind and what is open inside it (with a warning). An object
  /// is a wall: nothing in it ends a block around it. False if there is no such block (warned).
  bool end_block(BlockKind kind, SourceLoc loc);
  /// Warns about blocks that are open when the world ends.
  void check_all_closed(SourceLoc world_end) const;
  /// Row of the object being recorded, or kNoRow.
  uint32_t object = kNoRow;

 private:
  struct Block {
    BlockKind kind;
    SourceLoc loc;
    Matrix ctm;
    uint32_t material, area_light, lasting_material, object, interior, exterior;
    bool reverse_orientation;
    size_t texture_marks[kTextureKinds];
    size_t material_mark, volume_mark;
  };
  void restore(const Block& block);

  Dialect dialect_;
  Diagnostics& diagnostics_;
  std::vector<Block> blocks_;
};

}  // namespace yat
