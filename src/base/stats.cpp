#include "base/stats.h"

namespace yat {

std::string_view stage_name(Stage stage) {
  constexpr std::array<std::string_view, kStages> names = {
      "generate", "intersect",     "sort",  "environment",      "surface",    "emission", "texture",
      "draw",     "sample_lights", "shade", "intersect_shadow", "accumulate", "schedule"};
  static_assert(!names.back().empty(), "a stage has no name");
  return uint32_t(stage) < kStages ? names[uint32_t(stage)] : std::string_view("unknown");
}

void RenderStats::merge(const RenderStats& other) {
  for (uint32_t i = 0; i < kStages; ++i) {
    StageCount& to = stages[i];
    const StageCount& from = other.stages[i];
    to.calls += from.calls;
    to.rows += from.rows;
    to.lanes_active += from.lanes_active;
    to.lanes_total += from.lanes_total;
    to.nanoseconds += from.nanoseconds;
  }
  camera_rays += other.camera_rays;
  bounce_rays += other.bounce_rays;
  shadow_rays += other.shadow_rays;
  paths += other.paths;
  for (size_t i = 0; i < dropped.size(); ++i) dropped[i] += other.dropped[i];
}

}  // namespace yat
