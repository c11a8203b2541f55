#pragma once
// What the parts of the tree build share: sets of references, the binary tree, the price list.
//
//   triangles ─> references                                             tree_references.cpp
//             ─> binary tree: splits of objects, of space, or both      tree_build.cpp
//                  objects: binned; exact for small sets                tree_objects.cpp
//                  planes: binned, swept exactly, references clipped    tree_planes.cpp
//             ─> its largest nodes put where they fit best              tree_reinsert.cpp
//             ─> its largest leaves offered in parts                    tree_objects.cpp
//             ─> which binary nodes become wide                         tree_plan.cpp
//             ─> 8-wide nodes and blocks                                tree_collapse.cpp
//
// References lie in one array. A split reorders the set's part of it in place; what a plane
// duplicates goes into free room behind the set, which both sides inherit by their size. Every
// node depends on nothing but its set, so threads cannot change the tree.

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "scene/tree_box.h"
#include "scene/tree_build.h"

namespace yat::tree {

/// Memory of sets: references, and beside each a place for a row of a finished leaf.
struct Storage {
  std::unique_ptr<std::byte[], FreeAligned> reference_memory, row_memory;
  Reference* references = nullptr;
  uint32_t* rows = nullptr;
  explicit Storage(size_t capacity);
  void drop_references() {
    reference_memory.reset();
    references = nullptr;
  }
};

/// Some references and the free room behind them.
struct Set {
  Storage* storage = nullptr;
  size_t first = 0, count = 0, room = 0;  ///< room >= count
  Box box, half_centers;                  ///< bounds of the references, and of their half centres

  std::span<Reference> references() const { return {storage->references + first, count}; }
  uint32_t* rows() const { return storage->rows + first; }
  void add(const Reference& r) {
    box.add(r.box());
    add_center(r);
  }
  void add_center(const Reference& r) {
    const F4 c = r.half_center();
    half_centers.low = min_of(half_centers.low, c);
    half_centers.high = max_of(half_centers.high, c);
  }
};

/// A node of the binary tree. Without children: a leaf.
struct BinaryNode {
  Box box;
  BinaryNode* children = nullptr;       ///< two, side by side; the first is the lower side
  BinaryNode* parent = nullptr;         ///< set by mend_top, for itself
  uint32_t* rows = nullptr;             ///< of a leaf: ascending, no duplicates
  size_t count = 0;                     ///< references at and below this node
  int32_t axis = 0;                     ///< of the split
  uint32_t plan = 0;                    ///< of the wide tree (tree_plan.cpp)
  uint32_t wide_nodes = 0, blocks = 0;  ///< at and below, if a wide node starts here
  bool leaf() const { return !children; }
};

/// Memory for small arrays of T, handed out by each worker from chunks of its own, and kept.
template <class T>
class Arena {
 public:
  explicit Arena(uint32_t workers) : cursors_(workers) {}
  /// `count` elements, side by side. Inside ThreadPool::run.
  T* take(size_t count) {
    Cursor& cursor = cursors_[worker_index()];
    if (cursor.left < count) {
      cursor.left = std::max(count, kChunk);
      cursor.chunks.push_back(std::make_unique<T[]>(cursor.left));
      cursor.next = cursor.chunks.back().get();
    }
    T* const out = cursor.next;
    cursor.next += count;
    cursor.left -= count;
    return out;
  }

 private:
  static constexpr size_t kChunk = 1024;
  struct alignas(64) Cursor {
    std::vector<std::unique_ptr<T[]>> chunks;
    T* next = nullptr;
    size_t left = 0;
  };
  std::vector<Cursor> cursors_;
};
using NodeArena = Arena<BinaryNode>;

/// What a random ray pays, in units of one visit of an 8-wide node by a ray alone.
struct Prices {
  uint32_t block_width;
  double root_area;

  static constexpr float kTraversal = 0.5f, kBlock = 0.6f, kTriangle = 0.025f;
  /// Boxes that many rays of a batch enter see long lists: their children are tested, and their
  /// triangles, a register of rays at a time (kernels/traverse_leaf.h), which is cheaper per ray
  /// and costs by the triangle instead of by the block.
  static constexpr double kManyRays = 1.0 / 24;
  static constexpr float kStreamTraversal = 0.08f, kStreamLeaf = 0.1f, kStreamTriangle = 0.06f;
  /// A wide node; in long lists also by its children.
  static constexpr float kWide = 0.5f, kStreamWide = 0.05f, kStreamChild = 0.03f;

  size_t blocks(size_t n) const { return (n + block_width - 1) / block_width; }
  float block_leaf(size_t n) const { return kBlock * float(blocks(n)) + kTriangle * float(n); }
  static float stream_leaf(size_t n) { return kStreamLeaf + kStreamTriangle * float(n); }
  /// Of a visit; area as a share of the root's.
  float leaf(size_t n, float area) const {
    return area < float(kManyRays) ? block_leaf(n) : std::min(block_leaf(n), stream_leaf(n));
  }
  static float wide(uint32_t children, float area) {
    return area < float(kManyRays) ? kWide : kStreamWide + kStreamChild * float(children);
  }
};

/// The prices of one set's children, with areas in its own unit.
struct LocalPrices {
  const Prices& prices;
  AreaUnit unit;
  float area, inverse_area;  ///< of the set; 0 if it has none
  float many_rays;           ///< from this area on

  LocalPrices(const Prices& p, const Box& box) : prices(p), unit(box), area(unit(box)) {
    inverse_area = area > 0 ? 1 / area : 0;
    many_rays = float(Prices::kManyRays * p.root_area / unit.to_double);
  }
  float traversal() const {
    return area >= many_rays ? Prices::kStreamTraversal : Prices::kTraversal;
  }
  float leaf(size_t n, float of_area) const {
    const float by_block = prices.block_leaf(n);
    if (of_area < many_rays) return by_block;
    return std::min(by_block, Prices::stream_leaf(n));
  }
  float leaf(size_t n) const { return leaf(n, area); }
  float split(size_t left, float left_area, size_t right, float right_area) const {
    return traversal() +
           (left_area * leaf(left, left_area) + right_area * leaf(right, right_area)) *
               inverse_area;
  }
};

inline constexpr uint32_t kMaxBlocks = 32;  ///< per leaf: five bits in TreeNode::child
/// Binary levels after which sets are halved by index, whatever the price: bounds the depth.
inline constexpr uint32_t kMaxPricedDepth = 64;
inline constexpr size_t kSmallSet = 64;       ///< Sets up to this size are split exactly.
inline constexpr size_t kParallel = 4096;     ///< References below which a subtree is one task.
inline constexpr uint32_t kBinGrain = 32768;  ///< References a task bins at a time.

/// Adds all references of a set to `bins`, which are empty, in pieces that tasks take: what is
/// added (counts, boxes) does not depend on the order.
template <class Bins>
void bin_all(const Set& set, const BinMap& bin, Bins& bins) {
  const std::span<const Reference> references = set.references();
  const size_t pieces = (set.count + kBinGrain - 1) / kBinGrain;
  if (pieces <= 1) return bins.add(references, bin);
  std::vector<Bins> piece(pieces);
  parallel_ranges(uint32_t(pieces), 1, [&](uint32_t begin, uint32_t end) {
    for (size_t i = begin; i != end; ++i) {
      const size_t first = i * kBinGrain;
      piece[i].add(references.subspan(first, std::min<size_t>(kBinGrain, set.count - first)), bin);
    }
  });
  for (const Bins& b : piece) bins.add(b);
}

struct PlaneSplit {
  float cost = HUGE_VALF;
  int axis = 0;
  float at = 0;
  bool flat_left = true;  ///< references that lie in the plane go to the lower side
  size_t left = 0, right = 0;
};
struct ObjectSplit {
  float cost = HUGE_VALF;
  int axis = 0, bin = 0;  ///< lower side: bins below `bin`
  Box left, right;
};

/// The triangles that can be hit, as one set of `storage`: finite and with area. room: places for
/// references per triangle, at least 1. Inside ThreadPool::run.
Set make_references(const Rows<TriangleRow>& triangles, double room,
                    std::unique_ptr<Storage>& storage);

/// A binary tree with the memory of its nodes and sets.
struct BinaryTree {
  Prices prices{16, 0};
  BinaryNode root;  ///< count 0: no triangles
  NodeArena arena;
  std::unique_ptr<Storage> storage;            ///< of the root's set
  std::vector<std::unique_ptr<Storage>> more;  ///< of sets that outgrew theirs
  std::mutex mutex;                            ///< of `more`
  Arena<uint32_t> merged_rows;                 ///< of leaves that the plan makes of subtrees
  explicit BinaryTree(uint32_t workers) : arena(workers), merged_rows(workers) {}
};

/// Builds the binary tree of the triangles. prices.block_width is given. Inside ThreadPool::run.
void build_binary(const Rows<TriangleRow>& triangles, TreeShape shape, BinaryTree& tree);

/// Puts the largest nodes where they enlarge the tree least. Inside ThreadPool::run.
void mend_top(BinaryTree& tree);

/// What a random ray through the root's box pays in the tree as it stands, in lists of its own,
/// and how much boxes overlap their siblings, in areas of the root's box. Both are the same for
/// any threads.
struct TreeQuality {
  double cost = 0, overlap = 0;
};
TreeQuality quality_of(const BinaryTree& tree);

/// The best plane by the SAH: binned, then exact among the references of the best bins; exact
/// throughout for small sets. cost is infinite where no plane separates anything.
PlaneSplit find_plane(const Set& set, const LocalPrices& prices);

/// Distributes the set over both sides of the plane, with clipped boxes. False, with nothing
/// done, if there is not room enough.
bool split_by_plane(const Rows<TriangleRow>& triangles, const Set& set, const PlaneSplit& split,
                    Set& left, Set& right);

/// The best partition of a large set by bins of centres. cost is infinite where all are equal.
ObjectSplit find_object_split(const Set& set, const LocalPrices& prices);
void split_objects(const Set& set, const ObjectSplit& split, Set& left, Set& right);

/// Everything below a set of up to kSmallSet references, by exact object splits.
void build_small(const Set& set, uint32_t depth, const Prices& prices, NodeArena& arena,
                 BinaryNode& node);

/// Splits the leaves that long lists of rays see down to single references, whatever the price: the
/// plan of the wide tree joins what does not pay. One by one, splits would not: taking one wall of
/// a room from the others leaves a box as large as before; taking all six leaves none. Inside
/// ThreadPool::run.
void part_large_leaves(const Rows<TriangleRow>& triangles, BinaryTree& tree);

/// Makes `node` a leaf of these references.
void make_leaf(const Set& set, BinaryNode& node);

/// Corner positions of triangle `prim`, as double.
struct Corners {
  double p[3][3];
};
Corners corners_of(const Rows<TriangleRow>& triangles, uint32_t prim);

/// Tight box of the part of a triangle inside `box`, rounded outwards.
Box clipped_box(const Corners& corners, const Box& box);

/// The 8-wide tree of a binary tree, which it plans first: fills the arrays, the view and the
/// statistics of their contents. Inside ThreadPool::run.
void collapse(BinaryTree& tree, const Rows<TriangleRow>& triangles,
              std::span<const uint8_t> occludes, Tree& out);

/// x as float, rounded down or up, finite.
float round_down(double x);
float round_up(double x);

}  // namespace yat::tree
