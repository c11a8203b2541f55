#include "ray_sets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace yat::bench {
namespace {

using glm::dvec3;

Ray<Value> ray_of(const dvec3& o, const dvec3& d) {
  return {float(o.x), float(o.y), float(o.z), float(d.x), float(d.y), float(d.z), kRayFar};
}

/// Uniform numbers in [0, 1), the same with every standard library.
class Uniform {
 public:
  double operator()() { return double(engine_() >> 8) * 0x1p-24; }

 private:
  std::mt19937 engine_{1};
};

RaySet camera_rays(const Viewpoint& view, uint32_t width, uint32_t height, Uniform& uniform) {
  RaySet set{"camera", false, {}};
  set.rays.reserve(size_t(width) * height);
  const dvec3 forward = glm::normalize(view.target - view.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3{0, 1, 0}));
  const dvec3 up = glm::cross(right, forward);
  for (uint32_t ty = 0; ty < height; ty += 8)
    for (uint32_t tx = 0; tx < width; tx += 8)
      for (uint32_t i = 0; i < 64; ++i) {
        const uint32_t px = tx + i % 4 + i / 16 % 2 * 4, py = ty + i / 4 % 4 + i / 32 * 4;
        const double x = (px + uniform() - width * 0.5) / height;
        const double y = (py + uniform() - height * 0.5) / height;
        set.rays.push_back(
            ray_of(view.eye, glm::normalize(forward + right * (x * 0.7) - up * (y * 0.7))));
      }
  return set;
}

/// A hit's position, moved off the surface to the side that the ray came from, and that side.
struct Vertex {
  dvec3 position, normal, direction;
};

Vertex vertex_of(const BenchScene& scene, const Ray<Value>& ray, const Hit<Value>& hit) {
  const float* const c = scene.corners.data() + size_t(hit.prim) * 9;
  const dvec3 p0{c[0], c[1], c[2]}, p1{c[3], c[4], c[5]}, p2{c[6], c[7], c[8]};
  const dvec3 d{ray.dir_x, ray.dir_y, ray.dir_z};
  dvec3 normal = glm::normalize(glm::cross(p1 - p0, p2 - p0));
  if (glm::dot(normal, d) > 0) normal = -normal;
  const dvec3 p = p0 + (p1 - p0) * double(hit.u) + (p2 - p0) * double(hit.v);
  const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return {p + normal * (size * 64 * 0x1p-23), normal, d};
}

dvec3 cosine_direction(const dvec3& normal, Uniform& uniform) {
  const double phi = 2 * M_PI * uniform(), r = std::sqrt(uniform());
  const dvec3 tangent = glm::normalize(
      glm::cross(std::abs(normal.x) > 0.5 ? dvec3{0, 1, 0} : dvec3{1, 0, 0}, normal));
  const dvec3 side = glm::cross(normal, tangent);
  return glm::normalize(tangent * (r * std::cos(phi)) + side * (r * std::sin(phi)) +
                        normal * std::sqrt(1 - r * r));
}

}  // namespace

std::vector<RaySet> record_rays(const BenchScene& scene, const KernelTable& kernels,
                                const TreeView& tree, uint32_t width, uint32_t height) {
  Uniform uniform;
  const Viewpoint& view = scene.view;
  std::vector<RaySet> sets = {camera_rays(view, width, height, uniform)};
  AlignedArray<std::byte> scratch(
      kernels.traversal_scratch_bytes(tree, uint32_t(sets[0].rays.size())));
  std::vector<Ray<Value>> wave = sets[0].rays;
  for (int bounce = 1; bounce <= 3; ++bounce) {
    const auto n = uint32_t(wave.size());
    Table<Ray> rays{n};
    Table<Hit> hits{n};
    for (uint32_t i = 0; i < n; ++i) rays.set(i, wave[i]);
    kernels.intersect_closest(tree, rays.view(), hits.columns(), n,
                              {scratch.data(), scratch.size()});
    RaySet mirror{"mirror", false, {}};
    RaySet shadow{"shadow " + std::to_string(bounce), true, {}};
    RaySet diffuse{"diffuse " + std::to_string(bounce), false, {}};
    for (uint32_t i = 0; i < n; ++i) {
      const Hit<Value> hit = hits.row(i);
      if (hit.prim == kNone) continue;
      const Vertex vertex = vertex_of(scene, wave[i], hit);
      if (bounce == 1)
        mirror.rays.push_back(
            ray_of(vertex.position, glm::normalize(glm::reflect(vertex.direction, vertex.normal))));
      const double x = uniform(), y = uniform();
      const dvec3 to_lamp = view.lamp + view.lamp_x * x + view.lamp_y * y - vertex.position;
      if (bounce <= 2 && glm::dot(to_lamp, vertex.normal) > 0)
        shadow.rays.push_back(ray_of(vertex.position, to_lamp * (1 - 1e-5)));
      diffuse.rays.push_back(ray_of(vertex.position, cosine_direction(vertex.normal, uniform)));
    }
    wave = diffuse.rays;
    for (RaySet* set : {&mirror, &shadow, &diffuse})
      if (!set->rays.empty()) sets.push_back(std::move(*set));
  }
  return sets;
}

}  // namespace yat::bench
