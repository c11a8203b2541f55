#pragma once
// The top level of the two: an 8-wide tree over the bounds of instances.

#include <cstdint>
#include <span>

#include "scene/tree_build.h"

namespace yat {

/// Bounds of something that is placed, scene space [m].
struct TopBox {
  double min[3], max[3];
};

/// Builds the tree over boxes of finite numbers. A leaf holds one box: its child word is bit 31
/// and the box's number. Nodes are as the triangle tree's, boxes rounded outwards and grown by
/// the rounding of the box test; there are no blocks. Object splits by the SAH over centres (Wald
/// 2007, binned), halves by index where that does not separate. The bytes depend on the boxes
/// alone. At most 2^31 - 1 boxes. Where `items` are given, a leaf holds its box's item instead.
Tree build_top_tree(std::span<const TopBox> boxes, std::span<const uint32_t> items = {});

}  // namespace yat
