#include "embree_trace.h"
#include "embree_device.h"
#include "measure.h"

namespace yat::bench {

struct EmbreeScene::Impl {
  EmbreeMesh mesh;
  EmbreeDevice device;
  RTCScene scene;
};

EmbreeScene::EmbreeScene(const BenchScene& scene, EmbreeQuality quality)
    : impl_(new Impl{EmbreeMesh(scene), EmbreeDevice(1), nullptr}) {
  impl_->scene = make_embree_scene(impl_->device, impl_->mesh, quality);
}

EmbreeScene::~EmbreeScene() {
  if (impl_->scene) rtcReleaseScene(impl_->scene);
}

namespace {

enum class Calls { kSingle, kPacket8, kPacket16, kStream };
struct Variant {
  const char* name;
  Calls calls;
  bool coherent;
};
constexpr Variant kVariants[] = {
    {"1", Calls::kSingle, false},
    {"8", Calls::kPacket8, false},
    {"16", Calls::kPacket16, false},
    {"8 coherent", Calls::kPacket8, true},
    {"16 coherent", Calls::kPacket16, true},
#if YAT_EMBREE_MAJOR < 4
    {"stream", Calls::kStream, false},
    {"stream coherent", Calls::kStream, true},
#endif
};

#if YAT_EMBREE_MAJOR >= 4
struct Context {
  RTCIntersectArguments closest;
  RTCOccludedArguments any;
  explicit Context(bool coherent) {
    rtcInitIntersectArguments(&closest);
    rtcInitOccludedArguments(&any);
    closest.flags = any.flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
  RTCIntersectArguments* of_closest() { return &closest; }
  RTCOccludedArguments* of_any() { return &any; }
};
#define YAT_EMBREE_CLOSEST1(scene, ray) rtcIntersect1(scene, ray, context.of_closest())
#define YAT_EMBREE_ANY1(scene, ray) rtcOccluded1(scene, ray, context.of_any())
#define YAT_EMBREE_CLOSEST_N(n, valid, scene, ray) \
  rtcIntersect##n(valid, scene, ray, context.of_closest())
#define YAT_EMBREE_ANY_N(n, valid, scene, ray) rtcOccluded##n(valid, scene, ray, context.of_any())
#else
struct Context {
  RTCIntersectContext value;
  explicit Context(bool coherent) {
    rtcInitIntersectContext(&value);
    value.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
};
#define YAT_EMBREE_CLOSEST1(scene, ray) rtcIntersect1(scene, &context.value, ray)
#define YAT_EMBREE_ANY1(scene, ray) rtcOccluded1(scene, &context.value, ray)
#define YAT_EMBREE_CLOSEST_N(n, valid, scene, ray) \
  rtcIntersect##n(valid, scene, &context.value, ray)
#define YAT_EMBREE_ANY_N(n, valid, scene, ray) rtcOccluded##n(valid, scene, &context.value, ray)
#endif

template <uint32_t N, class Packet, class Call>
double run_packets(const RaySet& set, std::vector<Hit<Value>>& hits, Call&& call) {
  const auto n = uint32_t(set.rays.size());
  const uint32_t count = (n + N - 1) / N;
  auto packets = std::unique_ptr<Packet[]>(new Packet[count]());
  std::vector<int> valid(size_t(count) * N + 16);
  int* const mask =
      reinterpret_cast<int*>((reinterpret_cast<uintptr_t>(valid.data()) + 63) & ~uintptr_t(63));
  for (uint32_t i = 0; i < count * N; ++i) {
    auto& p = packets[i / N];
    const Ray<Value>& r = set.rays[i < n ? i : n - 1];
    const uint32_t k = i % N;
    p.ray.org_x[k] = r.org_x, p.ray.org_y[k] = r.org_y, p.ray.org_z[k] = r.org_z;
    p.ray.dir_x[k] = r.dir_x, p.ray.dir_y[k] = r.dir_y, p.ray.dir_z[k] = r.dir_z;
    p.ray.tnear[k] = 0, p.ray.tfar[k] = set.shadow ? 1 : r.t_max, p.ray.mask[k] = ~0u;
    p.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    mask[i] = i < n ? -1 : 0;
  }
  const double start = thread_seconds();
  for (uint32_t i = 0; i < count; ++i) call(mask + size_t(i) * N, packets[i]);
  const double seconds = thread_seconds() - start;
  for (uint32_t i = 0; i < n; ++i) {
    const auto& p = packets[i / N];
    const uint32_t k = i % N;
    if (set.shadow) {
      hits[i] = {0, 0, 0, p.ray.tfar[k] < 0 ? 0 : kNone};
    } else {
      const bool hit = p.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
      hits[i] = {p.ray.tfar[k], p.hit.u[k], p.hit.v[k], hit ? p.hit.primID[k] : kNone};
    }
  }
  return seconds;
}

}  // namespace

std::vector<std::string> EmbreeScene::variants() {
  std::vector<std::string> names;
  for (const Variant& v : kVariants) names.push_back(v.name);
  return names;
}

double EmbreeScene::trace(uint32_t variant, const RaySet& set,
                          std::vector<Hit<Value>>& hits) const {
  const Variant& v = kVariants[variant];
  const RTCScene scene = impl_->scene;
  const auto n = uint32_t(set.rays.size());
  hits.resize(n);
  Context context(v.coherent);
  if (v.calls == Calls::kPacket8)
    return run_packets<8, RTCRayHit8>(set, hits, [&](const int* valid, RTCRayHit8& p) {
      if (set.shadow) {
        YAT_EMBREE_ANY_N(8, valid, scene, &p.ray);
      } else {
        YAT_EMBREE_CLOSEST_N(8, valid, scene, &p);
      }
    });
  if (v.calls == Calls::kPacket16)
    return run_packets<16, RTCRayHit16>(set, hits, [&](const int* valid, RTCRayHit16& p) {
      if (set.shadow) {
        YAT_EMBREE_ANY_N(16, valid, scene, &p.ray);
      } else {
        YAT_EMBREE_CLOSEST_N(16, valid, scene, &p);
      }
    });
  auto rays = std::unique_ptr<RTCRayHit[]>(new RTCRayHit[n]());
  for (uint32_t i = 0; i < n; ++i) {
    const Ray<Value>& r = set.rays[i];
    RTCRay& to = rays[i].ray;
    to.org_x = r.org_x, to.org_y = r.org_y, to.org_z = r.org_z;
    to.dir_x = r.dir_x, to.dir_y = r.dir_y, to.dir_z = r.dir_z;
    to.tnear = 0, to.tfar = set.shadow ? 1 : r.t_max, to.mask = ~0u;
    rays[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
  }
  const double start = thread_seconds();
  if (v.calls == Calls::kSingle) {
    for (uint32_t i = 0; i < n; ++i) {
      if (set.shadow) {
        YAT_EMBREE_ANY1(scene, &rays[i].ray);
      } else {
        YAT_EMBREE_CLOSEST1(scene, &rays[i]);
      }
    }
  }
#if YAT_EMBREE_MAJOR < 4
  if (v.calls == Calls::kStream) {
    for (uint32_t i = 0; i < n; i += 256) {
      const uint32_t m = std::min(n - i, 256u);
      if (set.shadow) {
        rtcOccluded1M(scene, &context.value, &rays[i].ray, m, sizeof(RTCRayHit));
      } else {
        rtcIntersect1M(scene, &context.value, &rays[i], m, sizeof(RTCRayHit));
      }
    }
  }
#endif
  const double seconds = thread_seconds() - start;
  for (uint32_t i = 0; i < n; ++i) {
    if (set.shadow) {
      hits[i] = {0, 0, 0, rays[i].ray.tfar < 0 ? 0 : kNone};
    } else {
      const bool hit = rays[i].hit.geomID != RTC_INVALID_GEOMETRY_ID;
      hits[i] = {rays[i].ray.tfar, rays[i].hit.u, rays[i].hit.v, hit ? rays[i].hit.primID : kNone};
    }
  }
  return seconds;
}

}  // namespace yat::bench
