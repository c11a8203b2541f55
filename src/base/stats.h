#pragma once
// What a render counted: per stage calls, rows, lanes and exclusive time; rays by kind; drops.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace yat {

/// Stages in the order of the loop. Each nanosecond of a worker belongs to exactly one of them.
enum class Stage : uint32_t {
  kGenerate,
  kIntersect,
  kSort,
  kEnvironment,
  kSurface,
  kEmission,
  kTexture,
  kDraw,
  kLightSample,
  kShade,
  kIntersectShadow,
  kAccumulate,
  kSchedule,
  kCount
};
inline constexpr uint32_t kStages = uint32_t(Stage::kCount);
std::string_view stage_name(Stage stage);

struct StageCount {
  uint64_t calls = 0, rows = 0;
  uint64_t lanes_active = 0, lanes_total = 0;
  uint64_t nanoseconds = 0;  ///< of worker time, exclusive
};

/// Counters of one worker; merge() adds them up.
struct RenderStats {
  std::array<StageCount, kStages> stages{};
  uint64_t camera_rays = 0, bounce_rays = 0, shadow_rays = 0;
  uint64_t paths = 0;
  std::array<uint64_t, 8> dropped{};  ///< by DropCause
  void merge(const RenderStats& other);
};

/// One span of a stage on a worker, for the Chrome trace.
struct TraceSpan {
  Stage stage;
  uint32_t worker;
  uint64_t begin_ns, end_ns;  ///< since the start of the render
  uint64_t rows;
};

}  // namespace yat
