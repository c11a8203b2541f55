#include "embree_build.h"

#include <fmt/format.h>

#include <numeric>

#include "base/error.h"
#include "embree_device.h"
#include "measure.h"

namespace yat::bench {

const char* embree_quality_name(EmbreeQuality quality) {
  return quality == EmbreeQuality::kHigh ? "high" : "medium";
}

std::string embree_version() {
  const EmbreeDevice device(1);
  const auto part = [&](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(device.handle(), property);
  };
  return fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     part(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

EmbreeDevice::EmbreeDevice(uint32_t threads)
    : handle_(rtcNewDevice(fmt::format("threads={},hugepages=1", threads).c_str())) {
  if (!handle_) throw ResourceError("Embree gives no device");
  rtcSetDeviceMemoryMonitorFunction(handle_, &EmbreeDevice::on_memory, this);
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(handle_);
}

bool EmbreeDevice::on_memory(void* self, ssize_t bytes, bool) {
  auto& device = *static_cast<EmbreeDevice*>(self);
  const int64_t now = device.bytes_ += bytes;
  int64_t peak = device.peak_;
  while (now > peak && !device.peak_.compare_exchange_weak(peak, now)) {
  }
  return true;
}

EmbreeMesh::EmbreeMesh(const BenchScene& scene)
    : vertices(scene.corners), indices(size_t(scene.triangles()) * 3) {
  vertices.resize(vertices.size() + 4);
  std::iota(indices.begin(), indices.end(), 0u);
}

RTCScene make_embree_scene(const EmbreeDevice& device, const EmbreeMesh& mesh,
                           EmbreeQuality quality) {
  const RTCScene scene = rtcNewScene(device.handle());
  rtcSetSceneBuildQuality(
      scene, quality == EmbreeQuality::kHigh ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  const RTCGeometry geometry = rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             mesh.vertices.data(), 0, 12, mesh.indices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.indices.data(), 0, 12, mesh.indices.size() / 3);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device.handle()) != RTC_ERROR_NONE) {
    rtcReleaseScene(scene);
    throw ResourceError("Embree cannot build the scene");
  }
  return scene;
}

struct EmbreeBuilder::Impl {
  EmbreeMesh mesh;
  EmbreeDevice device;
};

EmbreeBuilder::EmbreeBuilder(const BenchScene& scene, uint32_t threads)
    : impl_(new Impl{EmbreeMesh(scene), EmbreeDevice(threads)}) {}
EmbreeBuilder::~EmbreeBuilder() = default;

EmbreeBuilder::Result EmbreeBuilder::build(EmbreeQuality quality) {
  EmbreeDevice& device = impl_->device;
  const int64_t before = device.bytes();
  device.reset_peak();
  const double wall = wall_seconds(), cpu = process_seconds();
  const RTCScene scene = make_embree_scene(device, impl_->mesh, quality);
  Result result;
  result.wall = wall_seconds() - wall;
  result.cpu = process_seconds() - cpu;
  result.bytes = uint64_t(device.bytes() - before);
  result.peak_bytes = uint64_t(device.peak_bytes() - before);
  rtcReleaseScene(scene);
  return result;
}

}  // namespace yat::bench
