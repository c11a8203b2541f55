#include "judge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace yat::bench {
namespace {

using glm::dvec3;

constexpr double kRounding = 0x1p-20;
constexpr uint64_t kMostJudged = 200;

/// Distance in float steps; both >= 0.
uint32_t ulps_between(float a, float b) {
  const auto x = std::bit_cast<int32_t>(a), y = std::bit_cast<int32_t>(b);
  return uint32_t(x > y ? int64_t(x) - y : int64_t(y) - x);
}

enum class Verdict { kSame, kTie, kDiffers };

Verdict verdict(const Hit<Value>& ours, const Hit<Value>& theirs, bool shadow) {
  if ((ours.prim == kNone) != (theirs.prim == kNone)) return Verdict::kDiffers;
  if (ours.prim == kNone || shadow) return Verdict::kSame;
  if (ours.prim == theirs.prim)
    return std::abs(ours.t - theirs.t) <= 1e-5f * ours.t ? Verdict::kSame : Verdict::kDiffers;
  return ulps_between(ours.t, theirs.t) <= 4 ? Verdict::kTie : Verdict::kDiffers;
}

}  // namespace

Judge::Judge(const BenchScene& scene, const Ray<Value>& ray, bool shadow)
    : shadow_(shadow), t_max_(shadow ? 1.0 : double(ray.t_max)) {
  const dvec3 org{ray.org_x, ray.org_y, ray.org_z}, dir{ray.dir_x, ray.dir_y, ray.dir_z};
  for (uint32_t i = 0; i < scene.triangles(); ++i) {
    const float* const c = scene.corners.data() + size_t(i) * 9;
    const dvec3 v[3] = {dvec3{c[0], c[1], c[2]} - org, dvec3{c[3], c[4], c[5]} - org,
                        dvec3{c[6], c[7], c[8]} - org};
    const dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    const double facing = glm::dot(normal, dir);
    if (facing == 0) continue;
    const double reach = std::max({glm::length(v[0]), glm::length(v[1]), glm::length(v[2])});
    const double slack = kRounding * reach;
    // Distance of the line from each edge, positive inside.
    double inside = 1e300;
    for (int k = 0; k < 3; ++k) {
      const dvec3 edge = v[(k + 1) % 3] - v[k];
      const double volume = glm::dot(dir, glm::cross(v[k], edge)) * (facing > 0 ? 1 : -1);
      const double across = glm::length(glm::cross(dir, edge));
      inside = std::min(inside, across > 0 ? volume / across : (volume >= 0 ? 1e300 : -1e300));
    }
    if (inside < -slack) continue;
    const double t = glm::dot(normal, v[0]) / facing;
    const double t_slack = slack * glm::length(normal) / std::abs(facing) + kRounding * std::abs(t);
    if (t + t_slack < 0 || t - t_slack > t_max_) continue;
    possible_.push_back({t - t_slack, t + t_slack});
    if (inside > slack && t - t_slack > 0 && t + t_slack < t_max_)
      nearest_certain_ = std::min(nearest_certain_, t + t_slack);
  }
}

bool Judge::right(const Hit<Value>& hit) const {
  if (hit.prim == kNone) return nearest_certain_ == 1e300;
  if (shadow_) return !possible_.empty();
  const auto t = double(hit.t);
  if (t > nearest_certain_) return false;
  return std::any_of(possible_.begin(), possible_.end(),
                     [&](const Interval& at) { return at.low <= t && t <= at.high; });
}

Differences compare(const BenchScene& scene, const RaySet& set, const std::vector<Hit<Value>>& ours,
                    const std::vector<Hit<Value>>& theirs) {
  Differences out;
  uint64_t judged = 0;
  for (uint32_t i = 0; i < set.rays.size(); ++i) {
    const Verdict v = verdict(ours[i], theirs[i], set.shadow);
    out.ties += v == Verdict::kTie;
    if (v != Verdict::kDiffers) continue;
    out.hit_miss += (ours[i].prim == kNone) != (theirs[i].prim == kNone);
    bool keep = true;
    if (judged++ < kMostJudged) {
      const Judge judge(scene, set.rays[i], set.shadow);
      const bool we = judge.right(ours[i]), they = judge.right(theirs[i]);
      out.rounding += we && they;
      out.yat_wrong += !we;
      out.other_wrong += !they;
      keep = !we;
    } else {
      ++out.unjudged;
    }
    if (keep && out.wrong_rows.size() < 8) out.wrong_rows.push_back(i);
  }
  return out;
}

}  // namespace yat::bench
