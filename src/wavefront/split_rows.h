#pragma once
// Work memory for materials that are made of others, and for veils (batch.h).

#include <cstdint>

#include "soa/columns.h"
#include "soa/records.h"

namespace yat {

/// Rows of a chunk. Surface, PathState, Randoms and LightSample take 176 bytes a row: 44 KB of a
/// 48 KB L1 cache at 256.
inline constexpr uint32_t kChunkRows = 256;

/// Rows of a chunk on their way to the children of a material that is made of two.
struct SplitRows {
  Table<Surface> surfaces{kChunkRows};  ///< of one child, dense
  Table<PathState> paths{kChunkRows};
  Table<Tangent> tangents{kChunkRows};
  Table<Coat> coats{kChunkRows};
  AlignedArray<float> u{kChunkRows};            ///< of one child: the number that decides inside it
  AlignedArray<uint32_t> hit{kChunkRows};       ///< of one child: rows of the hits, of instances
  AlignedArray<float> seen_weight{kChunkRows};  ///< of one child: see Worker::ChunkRows
  // Of the parent's rows:
  Table<Coat> own_coats{kChunkRows};
  AlignedArray<float> share{kChunkRows}, chance{kChunkRows}, left{kChunkRows};
  AlignedArray<uint32_t> child{kChunkRows};
  // Per child:
  AlignedArray<uint32_t> parameter[2]{AlignedArray<uint32_t>(kChunkRows),
                                      AlignedArray<uint32_t>(kChunkRows)};
  AlignedArray<uint32_t> order[2]{AlignedArray<uint32_t>(kChunkRows),
                                  AlignedArray<uint32_t>(kChunkRows)};
  /// Veils: how much of the light meets it.
  AlignedArray<float> weight[2]{AlignedArray<float>(kChunkRows), AlignedArray<float>(kChunkRows)};

  size_t bytes() const {
    size_t sum = surfaces.bytes() + paths.bytes() + tangents.bytes() + coats.bytes() +
                 own_coats.bytes() + u.bytes() + hit.bytes() + seen_weight.bytes() + share.bytes() +
                 chance.bytes() + left.bytes() + child.bytes();
    for (int c = 0; c < 2; ++c) sum += parameter[c].bytes() + order[c].bytes() + weight[c].bytes();
    return sum;
  }
};

/// Shadow rays on their way through veils: as rays and paths of a turn.
struct VeilRows {
  explicit VeilRows(uint32_t rows)
      : hits(rows),
        bin(rows),
        order(rows),
        weight(rows ? kChunkRows : 0),
        r(rows ? kChunkRows : 0),
        g(rows ? kChunkRows : 0),
        b(rows ? kChunkRows : 0) {
    for (int i = 0; i < 2; ++i) {
      rays[i].resize(rows);
      paths[i].resize(rows);
    }
  }
  Table<Ray> rays[2];
  Table<PathState> paths[2];
  Table<Hit> hits;
  AlignedArray<uint32_t> bin, order;
  AlignedArray<float> weight, r, g, b;  ///< of a chunk: ones; what its surfaces let pass

  size_t bytes() const {
    size_t sum = hits.bytes() + bin.bytes() + order.bytes() + weight.bytes() + r.bytes() +
                 g.bytes() + b.bytes();
    for (int i = 0; i < 2; ++i) sum += rays[i].bytes() + paths[i].bytes();
    return sum;
  }
};

}  // namespace yat
