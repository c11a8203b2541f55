// Placed meshes -> triangle rows, with the orientation rules of lxs 2.5.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/compile_parts.h"

namespace yat {

namespace {

glm::dvec3 triple(std::span<const float> values, size_t i) {
  return {double(values[3 * i]), double(values[3 * i + 1]), double(values[3 * i + 2])};
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Vertex normals in the world, unit; (0,0,0) where the given one is zero or not finite.
std::vector<glm::dvec3> world_normals(const Mesh& mesh, const PlacedShape& placed) {
  std::vector<glm::dvec3> normals(mesh.normals.size() / 3);
  for (size_t v = 0; v < normals.size(); ++v) {
    const glm::dvec3 n = placed.placement.normal_map * triple(mesh.normals, v);
    const double length = glm::length(n);
    if (length > 0 && std::isfinite(length))
      normals[v] = n * ((placed.reverse_orientation ? -1 : 1) / length);
    else
      normals[v] = glm::dvec3(0.);
  }
  return normals;
}

/// A vertex normal that kernels may rely on: unit, on the side of the outside `g`. One that points
/// behind its triangle (coarse meshes near their outline) is laid into the triangle's plane, which
/// moves it as little as possible.
glm::dvec3 on_side_of(const glm::dvec3& g, const glm::dvec3& n) {
  const double cosine = glm::dot(n, g);
  if (cosine >= 0 && n != glm::dvec3(0.)) return n;
  const glm::dvec3 flat = n - cosine * g;
  const double length = glm::length(flat);
  return length > 1e-6 ? flat / length : g;
}

std::string counted(uint64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Interpolated normals this close to the face's own (about rounding of a unit float) shade the
/// same: the mesh is flat, and needs no vertex rows.
constexpr double kFlat = 1e-6;

}  // namespace

double mesh_area(const Mesh& mesh, const Placement& placement) {
  double area = 0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::dvec3 p0 = placement.point(triple(mesh.positions, mesh.indices[t]));
    const glm::dvec3 p1 = placement.point(triple(mesh.positions, mesh.indices[t + 1]));
    const glm::dvec3 p2 = placement.point(triple(mesh.positions, mesh.indices[t + 2]));
    const double twice = glm::length(glm::cross(p1 - p0, p2 - p0));
    if (std::isfinite(twice)) area += .5 * twice;
  }
  return area;
}

MeshRows add_mesh_rows(const PlacedShape& placed, const Mesh& mesh, const glm::dvec3& center,
                       UvUse uv, std::vector<TriangleRow<Value>>& triangles,
                       std::vector<TriangleVertexRow<Value>>& vertices, Diagnostics& diagnostics) {
  const size_t first_vertex_row = vertices.size();
  const std::vector<glm::dvec3> normals = world_normals(mesh, placed);
  const bool mirrored = placed.reverse_orientation != placed.placement.mirrored;
  uint64_t no_area = 0, not_finite = 0, bad_normals = 0;
  // Texture coordinates are for textures, and say where dp/du points.
  const UvUse emission_uv = placed.emissive() ? placed.look.uv : UvUse::kUnread;
  const bool keep_uv =
      (uv != UvUse::kUnread || emission_uv != UvUse::kUnread || placed.material.tangents) &&
      !mesh.uvs.empty();
  bool flat = !keep_uv;
  // By halves more at least: many small meshes must not copy the table each time.
  const size_t wanted = triangles.size() + mesh.triangles();
  if (wanted > triangles.capacity()) triangles.reserve(std::max(wanted, triangles.size() * 3 / 2));

  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    uint32_t index[3] = {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
    glm::vec3 p[3];
    for (int k = 0; k < 3; ++k)
      p[k] = glm::vec3(placed.placement.point(triple(mesh.positions, index[k])) - center);
    if (!is_finite(p[0]) || !is_finite(p[1]) || !is_finite(p[2])) {
      ++not_finite;
      continue;
    }
    // Decided on the rounded vertices, as the tree and the kernels see them.
    const glm::dvec3 d0(p[0]), raw = glm::cross(glm::dvec3(p[1]) - d0, glm::dvec3(p[2]) - d0);
    const double length = glm::length(raw);
    if (!(length > 0)) {
      ++no_area;
      continue;
    }
    glm::dvec3 outside = raw * ((mirrored ? -1 : 1) / length);
    bool swap = mirrored;
    if (!normals.empty()) {
      // Vertex normals that agree with each other decide the side.
      int behind = 0, given = 0;
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3& n = normals[index[k]];
        if (n == glm::dvec3(0.)) continue;
        ++given;
        behind += glm::dot(n, outside) < 0;
      }
      bad_normals += uint64_t(3 - given);
      if (given > 0 && behind == given) {
        outside = -outside;
        swap = !swap;
      }
    }
    if (swap) {
      std::swap(p[1], p[2]);
      std::swap(index[1], index[2]);
    }

    TriangleRow<Value> row{};
    row.p0_x = p[0].x, row.p0_y = p[0].y, row.p0_z = p[0].z;
    row.p1_x = p[1].x, row.p1_y = p[1].y, row.p1_z = p[1].z;
    row.p2_x = p[2].x, row.p2_y = p[2].y, row.p2_z = p[2].z;
    for (const glm::vec3& q : p)
      row.extent = std::max({row.extent, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    row.parameter = 0;
    row.light = kNone;
    triangles.push_back(row);
    if (normals.empty() && !keep_uv) continue;

    TriangleVertexRow<Value> vertex{};
    float* const to[3] = {&vertex.n0_x, &vertex.n1_x, &vertex.n2_x};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 n = normals.empty() ? outside : on_side_of(outside, normals[index[k]]);
      const glm::dvec3 off = glm::abs(n - outside);
      flat = flat && std::max({off.x, off.y, off.z}) <= kFlat;
      for (int axis = 0; axis < 3; ++axis) to[k][axis] = float(n[axis]);
    }
    const auto uv_of = [&](int k, int axis) {
      return mesh.uvs.empty() ? .5f : mesh.uvs[2 * index[k] + size_t(axis)];
    };
    vertex.u0 = uv_of(0, 0), vertex.v0 = uv_of(0, 1);
    vertex.u1 = uv_of(1, 0), vertex.v1 = uv_of(1, 1);
    vertex.u2 = uv_of(2, 0), vertex.v2 = uv_of(2, 1);
    vertices.push_back(vertex);
  }

  if (flat) vertices.resize(first_vertex_row);
  if (uv == UvUse::kNeeded && mesh.uvs.empty())
    diagnostics.warning(placed.loc,
                        "the material's texture is mapped by uv, which the mesh has not: it has "
                        "one colour");
  if (emission_uv == UvUse::kNeeded && mesh.uvs.empty())
    diagnostics.warning(placed.loc,
                        "the light's texture is mapped by uv, which the mesh has not: it has one "
                        "colour");
  if (no_area || not_finite) {
    std::string what;
    if (no_area) what = counted(no_area, "triangle has", "triangles have") + " no area";
    if (not_finite)
      what += (no_area ? ", " : "") + counted(not_finite, "triangle has", "triangles have") +
              " a vertex that is NaN or infinite";
    diagnostics.warning(placed.loc, what + ": left out");
  }
  if (bad_normals && mesh.normals_from_file)
    diagnostics.warning(
        placed.loc,
        fmt::format("{} zero, NaN or infinite: the face's normal is used there",
                    counted(bad_normals, "corner's normal is", "corners' normals are")));
  return {flat, uint32_t(no_area + not_finite)};
}

LightRow<Value> triangle_light(const TriangleRow<Value>& row, const glm::dvec3& radiance) {
  const glm::vec3 p0(row.p0_x, row.p0_y, row.p0_z);
  const glm::vec3 b = glm::vec3(row.p1_x, row.p1_y, row.p1_z) - p0;
  const glm::vec3 c = glm::vec3(row.p2_x, row.p2_y, row.p2_z) - p0;
  const glm::dvec3 d0(p0), d1(row.p1_x, row.p1_y, row.p1_z), d2(row.p2_x, row.p2_y, row.p2_z);
  LightRow<Value> light{};
  light.kind = uint32_t(LightKind::kTriangle);
  light.a_x = p0.x, light.a_y = p0.y, light.a_z = p0.z;
  light.b_x = b.x, light.b_y = b.y, light.b_z = b.z;
  light.c_x = c.x, light.c_y = c.y, light.c_z = c.z;
  light.extra = float(.5 * glm::length(glm::cross(d1 - d0, d2 - d0)));
  light.radiance_r = float(radiance.x);
  light.radiance_g = float(radiance.y);
  light.radiance_b = float(radiance.z);
  return light;
}

}  // namespace yat
