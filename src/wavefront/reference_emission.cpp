// The oracle's lights that do not shine evenly (reference_parts.h).

#include <bit>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "scene/light_maps.h"
#include "wavefront/reference_shapes.h"

namespace yat::reference {

namespace {

/// The point of a light next to `near`.
Point light_point(const Scene& scene, uint32_t light, const EmissionRow<Value>& emission,
                  const Vec& near) {
  const LightRow<Value> row = scene.lights.row(light);
  Point point{};
  point.position = near;
  point.prim = emission.prim;
  if (LightKind(row.kind) == LightKind::kSphere) {
    const SphereRow<Value> sphere = scene.spheres.row(emission.prim - scene.triangles.size());
    const glm::dvec2 uv = sphere_uv(sphere, near);
    point.u = uv.x, point.v = uv.y;
    const Vec out = near - Vec(sphere.center_x, sphere.center_y, sphere.center_z);
    point.ng = glm::normalize(sphere.inward ? -out : out);
  } else if (LightKind(row.kind) == LightKind::kShape) {
    const ShapeRow<Value> shape = scene.shapes.row(std::bit_cast<uint32_t>(row.a_x));
    const glm::dvec2 uv = shape_uv(shape, near);
    point.u = uv.x, point.v = uv.y;
  } else {
    // near = a + x b + y c + something along the normal.
    const Vec b(row.b_x, row.b_y, row.b_z), c(row.c_x, row.c_y, row.c_z);
    const Vec normal = glm::normalize(glm::cross(b, c));
    const Vec weights =
        glm::inverse(glm::dmat3(b, c, normal)) * (near - Vec(row.a_x, row.a_y, row.a_z));
    const double w0 = 1 - weights.x - weights.y;
    point.position = near - weights.z * normal;
    point.ng = normal;
    point.u = w0 * double(emission.u0) + weights.x * double(emission.u1) +
              weights.y * double(emission.u2);
    point.v = w0 * double(emission.v0) + weights.x * double(emission.v1) +
              weights.y * double(emission.v2);
  }
  return point;
}

}  // namespace

Vec emission_factor(const Scene& scene, uint32_t light, const Point& at, const Vec& direction,
                    double width) {
  if (scene.emission.size() == 0) return Vec(1.0);
  const EmissionRow<Value> emission = scene.emission.row(light);
  Vec factor(1.0);
  if (emission.program != kNone)
    factor = light_texture(scene, emission.program, emission.parameter, at, width);
  if (emission.map != kNone) {
    const LightMapRow<Value> map = scene.light_maps.row(emission.map);
    const Vec x(map.m_xx, map.m_xy, map.m_xz), y(map.m_yx, map.m_yy, map.m_yz),
        z(map.m_zx, map.m_zy, map.m_zz);
    const Vec local =
        glm::normalize(Vec(glm::dot(x, direction), glm::dot(y, direction), glm::dot(z, direction)));
    factor *= local.z > 0 ? map_colour(map, scene.light_texels.data(), local) / local.z : Vec(0.0);
  }
  return factor;
}

Vec emission_factor(const Scene& scene, uint32_t light, const Vec& to, const Vec& direction) {
  const EmissionRow<Value> emission = scene.emission.row(light);
  if (emission.program == kNone && emission.map == kNone) return Vec(1.0);
  return emission_factor(scene, light, light_point(scene, light, emission, to), direction, 0);
}

}  // namespace yat::reference
