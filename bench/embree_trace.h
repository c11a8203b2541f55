#pragma once
// The same rays through Embree.

#include <memory>

#include "embree_build.h"
#include "ray_sets.h"

namespace yat::bench {

class EmbreeScene {
 public:
  EmbreeScene(const BenchScene& scene, EmbreeQuality quality);
  ~EmbreeScene();
  static std::vector<std::string> variants();
  /// Seconds for the trace calls alone; rays are put into Embree's form outside. Fills hits
  /// (closest: t and prim; shadow: prim = 0 where stopped, else kNone).
  double trace(uint32_t variant, const RaySet& set, std::vector<Hit<Value>>& hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace yat::bench
