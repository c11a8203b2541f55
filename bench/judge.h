#pragma once
// Which of two answers to a ray is right, by trying every triangle in double precision.

#include "bench_scenes.h"
#include "ray_sets.h"

namespace yat::bench {

/// Says whether an answer is one that a program may give that computes in float: rounding may move
/// the ray by 2^-20 of the distance between its origin and a triangle's vertices, so that near an
/// edge both sides of it are right.
class Judge {
 public:
  Judge(const BenchScene& scene, const Ray<Value>& ray, bool shadow);
  /// Whether hit.prim (kNone: a miss) is what the ray meets first; of a shadow ray, whether it is
  /// stopped. hit.t is not asked.
  bool right(const Hit<Value>& hit) const;

 private:
  struct Possible {
    uint32_t prim;
    double low;  ///< least t that rounding may give
  };
  bool shadow_;
  double t_max_;
  std::vector<Possible> possible_;  ///< triangles that the ray, perhaps moved, meets
  double nearest_certain_ = 1e300;  ///< no right hit is beyond; 1e300: a miss may be right
};

/// Differences between the answers of two programs to a set of rays.
struct Differences {
  uint64_t ties = 0;                        ///< another triangle at the same distance, to 4 ulp
  uint64_t yat_t_off = 0, other_t_off = 0;  ///< the same triangle, at a t beyond that rounding
  uint64_t rounding = 0;  ///< different, and both right: the ray goes along an edge or a surface
  uint64_t yat_wrong = 0, other_wrong = 0;
  uint64_t unjudged = 0;             ///< different, and not looked at: there were too many
  uint64_t hit_miss = 0;             ///< of all but ties: one hits, the other misses
  std::vector<uint32_t> wrong_rows;  ///< the first few rows where yat is wrong or nobody looked
};

/// Judges the first 200 rows that differ.
Differences compare(const BenchScene& scene, const RaySet& set, const std::vector<Hit<Value>>& ours,
                    const std::vector<Hit<Value>>& theirs);

}  // namespace yat::bench
