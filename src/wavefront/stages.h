#pragma once
// The stages of the loop: what each takes, reads, writes and feeds. One entry per Stage, in the
// order of the loop: the contract that schedule.cpp follows.

#include <array>
#include <string_view>

#include "base/stats.h"
#include "soa/records.h"

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

/// Bytes of a row of what the list above names; 0: no such name.
constexpr uint32_t bytes_named(std::string_view name) {
  constexpr uint32_t kWord = sizeof(uint32_t);
  constexpr std::pair<std::string_view, uint32_t> kNames[] = {
      {"CameraSample", field_count<CameraSample> * kWord},
      {"Ray", field_count<Ray> * kWord},
      {"PathState", field_count<PathState> * kWord},
      {"SampleSum", field_count<SampleSum> * kWord},
      {"Hit", field_count<Hit> * kWord},
      {"Surface", field_count<Surface> * kWord},
      {"Randoms", field_count<Randoms> * kWord},
      {"LightSample", field_count<LightSample> * kWord},
      {"ShadowRay", field_count<ShadowRay> * kWord},
      {"bin", kWord},
      {"order", kWord},
      {"occluded", kWord},
      {"parameters", 3 * kWord},  // One colour; which there are differs from bin to bin.
      {"film", 64},               // film.h: a line of the cache.
  };
  for (const auto& [known, bytes] : kNames)
    if (name == known) return bytes;
  return 0;
}

/// Bytes of columns that a stage reads and writes for one of its rows, all of those that it may
/// touch. What it looks up besides (tree, triangles, textures, lights) is not among them.
constexpr uint32_t stage_row_bytes(Stage stage) {
  uint32_t bytes = 0;
  for (std::string_view names :
       {kStageList[uint32_t(stage)].reads, kStageList[uint32_t(stage)].writes})
    while (!names.empty()) {
      const size_t end = names.find(", ");
      bytes += bytes_named(names.substr(0, end));
      names = end == std::string_view::npos ? std::string_view() : names.substr(end + 2);
    }
  return bytes;
}

}  // namespace yat
