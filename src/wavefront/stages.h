#pragma once
// The stages of the loop: what each takes, reads, writes and feeds. One entry per Stage, in the
// order of the loop: the contract that schedule.cpp follows.

#include <array>
#include <string_view>

#include "base/stats.h"

namespace yat {

struct StageInfo {
  Stage stage;
  std::string_view drains;  ///< the rows that it works through
  std::string_view reads;
  std::string_view writes;
  std::string_view feeds;  ///< the stages that get rows from it
};

inline constexpr std::array<StageInfo, kStages> kStageList = {{
    {Stage::kGenerate, "free slots", "CameraSample", "Ray, PathState, SampleSum", "intersect"},
    {Stage::kIntersect, "paths under way", "Ray", "Hit", "sort"},
    {Stage::kSort, "paths under way", "Hit, PathState", "bin, order",
     "environment, surface, accumulate"},
    {Stage::kEnvironment, "paths that missed", "Ray, Hit, PathState", "SampleSum", ""},
    {Stage::kSurface, "a chunk of a bin", "Ray, Hit, PathState", "Surface, PathState",
     "emission, texture, draw, sample_lights, shade"},
    {Stage::kEmission, "a chunk of an emissive bin", "Surface, PathState", "SampleSum", ""},
    {Stage::kTexture, "a chunk of a textured bin", "Surface, PathState", "parameters", "shade"},
    {Stage::kDraw, "a chunk of a bin", "PathState", "Randoms", "sample_lights, shade"},
    {Stage::kLightSample, "a chunk of a bin", "Surface, Randoms", "LightSample", "shade"},
    {Stage::kShade, "a chunk of a bin", "Surface, PathState, Randoms, LightSample",
     "Ray, PathState, ShadowRay", "intersect, intersect_shadow, accumulate"},
    {Stage::kIntersectShadow, "shadow rays of the turn", "ShadowRay", "occluded", "accumulate"},
    {Stage::kAccumulate, "shadow rays and ended paths of the turn", "ShadowRay, SampleSum",
     "SampleSum, film", "generate"},
    {Stage::kSchedule, "", "", "", "generate"},
}};

constexpr bool stages_in_order() {
  for (uint32_t i = 0; i < kStages; ++i)
    if (kStageList[i].stage != Stage(i)) return false;
  return true;
}
static_assert(stages_in_order());

}  // namespace yat
