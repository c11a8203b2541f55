// A torus that cuts itself, as a mesh.

#include <cmath>
#include <glm/vec3.hpp>

#include "scene/read_shapes.h"

namespace yat {

Mesh make_torus_mesh(double major, double minor, double theta_min, double theta_sweep,
                     double phi_max) {
  Mesh mesh;
  constexpr uint32_t kRings = 128, kSegments = 256;
  for (uint32_t j = 0; j <= kRings; ++j)
    for (uint32_t i = 0; i <= kSegments; ++i) {
      const double u = double(i) / kSegments, v = double(j) / kRings;
      const double phi = phi_max * u, theta = theta_min + theta_sweep * v;
      const glm::dvec3 out(std::cos(phi), std::sin(phi), 0), up(0, 0, 1);
      const glm::dvec3 n = std::cos(theta) * out + std::sin(theta) * up;
      const glm::dvec3 p = major * out + minor * n;
      for (int k = 0; k < 3; ++k) {
        mesh.owned_normals.push_back(float(n[k]));
        mesh.owned_positions.push_back(float(p[k]));
      }
      mesh.owned_uvs.push_back(float(u));
      mesh.owned_uvs.push_back(float(v));
    }
  const auto at = [](uint32_t j, uint32_t i) { return j * (kSegments + 1) + i; };
  for (uint32_t j = 0; j < kRings; ++j)
    for (uint32_t i = 0; i < kSegments; ++i)
      mesh.indices.insert(mesh.indices.end(), {at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j, i),
                                               at(j + 1, i + 1), at(j + 1, i)});
  mesh.positions = mesh.owned_positions;
  mesh.normals = mesh.owned_normals;
  mesh.uvs = mesh.owned_uvs;
  return mesh;
}

}  // namespace yat
