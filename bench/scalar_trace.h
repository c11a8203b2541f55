#pragma once
// One ray after the other through the same tree, one box and one triangle at a time: what the
// kernels are compared with, for speed and, being written apart from them, for their answers.

#include "kernels/table.h"

namespace yat::bench {

/// As KernelTable::traversal_scratch_bytes; the number of rays does not matter.
size_t scalar_scratch_bytes(const TreeView& tree, uint32_t max_rays) noexcept;
/// As KernelTable::intersect_closest. Counts no lanes.
LaneCount scalar_closest(const TreeView& tree, const Ray<ConstColumn>& rays,
                         const Hit<Column>& hits, uint32_t n, const Scratch& scratch) noexcept;
/// As KernelTable::intersect_shadow[0].
LaneCount scalar_shadow(const TreeView& tree, const ShadowRay<ConstColumn>& rays,
                        uint32_t* occluded, uint32_t n, const Scratch& scratch) noexcept;

}  // namespace yat::bench
