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

/// A ray against one triangle in double precision.
struct Meeting {
  double inside = -1e300;  ///< distance [m] of the line from the nearest edge, negative outside
  double slack = 0;        ///< by which rounding may move it [m]
  double t = 0, t_slack = 0;
  bool possible() const { return inside >= -slack; }
  bool certain() const { return inside > slack; }
  bool near(double at) const { return t - t_slack <= at && at <= t + t_slack; }
};

Meeting meet(const BenchScene& scene, uint32_t prim, const Ray<Value>& ray) {
  const dvec3 org{ray.org_x, ray.org_y, ray.org_z}, dir{ray.dir_x, ray.dir_y, ray.dir_z};
  const float* const c = scene.corners.data() + size_t(prim) * 9;
  const dvec3 v[3] = {dvec3{c[0], c[1], c[2]} - org, dvec3{c[3], c[4], c[5]} - org,
                      dvec3{c[6], c[7], c[8]} - org};
  const dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
  const double facing = glm::dot(normal, dir);
  Meeting out;
  if (facing == 0) return out;
  out.slack = kRounding * std::max({glm::length(v[0]), glm::length(v[1]), glm::length(v[2])});
  out.inside = 1e300;
  for (int k = 0; k < 3; ++k) {
    const dvec3 edge = v[(k + 1) % 3] - v[k];
    const double volume = glm::dot(dir, glm::cross(v[k], edge)) * (facing > 0 ? 1 : -1);
    const double across = glm::length(glm::cross(dir, edge));
    out.inside =
        std::min(out.inside, across > 0 ? volume / across : (volume >= 0 ? 1e300 : -1e300));
    if (out.inside < -out.slack) return out;
  }
  out.t = glm::dot(normal, v[0]) / facing;
  out.t_slack = out.slack * glm::length(normal) / std::abs(facing) + kRounding * std::abs(out.t);
  return out;
}

enum class Verdict { kSame, kTie, kBothRight, kDiffers };

/// What can be said of two answers without trying every triangle: also of two triangles that both
/// are met, at distances that rounding cannot tell apart. Counts the same triangle at another
/// distance as it finds it.
Verdict verdict(const BenchScene& scene, const Ray<Value>& ray, bool shadow, const Hit<Value>& ours,
                const Hit<Value>& theirs, Differences& out) {
  if ((ours.prim == kNone) != (theirs.prim == kNone)) return Verdict::kDiffers;
  if (ours.prim == kNone || shadow) return Verdict::kSame;
  if (ours.prim != theirs.prim) {
    if (ulps_between(ours.t, theirs.t) <= 4) return Verdict::kTie;
    const Meeting a = meet(scene, ours.prim, ray), b = meet(scene, theirs.prim, ray);
    return a.possible() && b.possible() && a.t > a.t_slack && b.t > b.t_slack &&
                   std::abs(a.t - b.t) <= a.t_slack + b.t_slack
               ? Verdict::kBothRight
               : Verdict::kDiffers;
  }
  if (std::abs(ours.t - theirs.t) > 1e-5f * ours.t) {
    const Meeting meeting = meet(scene, ours.prim, ray);
    out.yat_t_off += !meeting.near(double(ours.t));
    out.other_t_off += !meeting.near(double(theirs.t));
  }
  return Verdict::kSame;
}

}  // namespace

Judge::Judge(const BenchScene& scene, const Ray<Value>& ray, bool shadow)
    : shadow_(shadow), t_max_(shadow ? 1.0 : double(ray.t_max)) {
  for (uint32_t prim = 0; prim < scene.triangles(); ++prim) {
    const Meeting m = meet(scene, prim, ray);
    const double low = m.t - m.t_slack, high = m.t + m.t_slack;
    if (!m.possible() || high < 0 || low > t_max_) continue;
    possible_.push_back({prim, low});
    if (m.certain() && low > 0 && high < t_max_)
      nearest_certain_ = std::min(nearest_certain_, high);
  }
}

bool Judge::right(const Hit<Value>& hit) const {
  if (hit.prim == kNone) return nearest_certain_ == 1e300;
  if (shadow_) return !possible_.empty();
  return std::any_of(possible_.begin(), possible_.end(), [&](const Possible& p) {
    return p.prim == hit.prim && p.low <= nearest_certain_;
  });
}

Differences compare(const BenchScene& scene, const RaySet& set, const std::vector<Hit<Value>>& ours,
                    const std::vector<Hit<Value>>& theirs) {
  Differences out;
  uint64_t judged = 0;
  for (uint32_t i = 0; i < set.rays.size(); ++i) {
    const Verdict v = verdict(scene, set.rays[i], set.shadow, ours[i], theirs[i], out);
    out.ties += v == Verdict::kTie;
    out.rounding += v == Verdict::kBothRight;
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
