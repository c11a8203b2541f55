#pragma once
// The same rays through Embree.

#include <memory>

#include "traversal_scenes.h"

namespace yat::bench {

class EmbreeScene {
 public:
  enum class Quality { kMedium, kHigh };
  EmbreeScene(const BenchScene& scene, Quality quality);
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
