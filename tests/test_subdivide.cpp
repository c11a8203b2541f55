// Loop subdivision: known limits, counts, boundaries, seams of texture coordinates.

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "scene/subdivide.h"
#include "scene_builder.h"

namespace yat {
namespace {

Mesh mesh_of(std::vector<float> positions, std::vector<uint32_t> indices,
             std::vector<float> uvs = {}) {
  Mesh mesh;
  mesh.owned_positions = std::move(positions);
  mesh.owned_uvs = std::move(uvs);
  mesh.positions = mesh.owned_positions;
  mesh.uvs = mesh.owned_uvs;
  mesh.indices = std::move(indices);
  return mesh;
}
glm::dvec3 vertex(std::span<const float> values, size_t i) {
  return {double(values[3 * i]), double(values[3 * i + 1]), double(values[3 * i + 2])};
}

Mesh octahedron() {
  return mesh_of({1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
                 {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});
}

/// A regular grid of triangles in z = 0, n x n cells, its lower left corner at 0.
Mesh grid(uint32_t n) {
  std::vector<float> p;
  std::vector<uint32_t> i;
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) p.insert(p.end(), {float(x), float(y), 0.f});
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t a = y * (n + 1) + x, b = a + 1, d = a + n + 1, c = d + 1;
      i.insert(i.end(), {a, b, c, a, c, d});
    }
  return mesh_of(p, i);
}

TEST(Subdivide, CountsAndClosedSurfacesStayClosed) {
  for (const int levels : {1, 2, 3}) {
    Mesh mesh = octahedron();
    subdivide(mesh, {levels, true, false});
    EXPECT_EQ(mesh.triangles(), 8u << 2 * levels);
    // Euler: V = F / 2 + 2.
    EXPECT_EQ(mesh.vertices(), mesh.triangles() / 2 + 2);
    std::map<std::pair<uint32_t, uint32_t>, int> directed;
    for (size_t t = 0; t < mesh.indices.size(); t += 3)
      for (size_t k = 0; k < 3; ++k)
        ++directed[{mesh.indices[t + k], mesh.indices[t + (k + 1) % 3]}];
    for (const auto& [edge, count] : directed) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(directed.count({edge.second, edge.first}), 1u);
    }
  }
}

// A vertex of valence n goes to (w p + sum of neighbours) / (w + n), w = 3 / (8 beta): for the
// octahedron, beta = 31/256 with n = 4, so that a corner at 1 goes to 96/31 / (96/31 + 4). Levels
// change nothing of the limit.
TEST(Subdivide, LimitOfTheOctahedron) {
  const double w = 96. / 31, limit = w / (w + 4);
  for (const int levels : {1, 2, 4}) {
    Mesh mesh = octahedron();
    subdivide(mesh, {levels, true, false});
    double found = 0;
    for (uint32_t v = 0; v < mesh.vertices(); ++v) {
      const glm::dvec3 p = vertex(mesh.positions, v), n = vertex(mesh.normals, v);
      EXPECT_NEAR(glm::length(n), 1, 1e-6);
      EXPECT_GT(glm::dot(p, n), .8 * glm::length(p)) << "outwards, nearly a sphere";
      if (std::abs(p.x) < 1e-6 && std::abs(p.y) < 1e-6 && p.z > 0) {
        found = p.z;
        EXPECT_NEAR(n.z, 1, 1e-6);
      }
    }
    EXPECT_NEAR(found, limit, 1e-6) << levels;
  }
}

// Flat regular grids stay flat, their inner vertices where they are; edges become straight
// B-splines; corners shrink, unless boundaries are sharp.
TEST(Subdivide, GridsAndTheirBoundaries) {
  for (const bool sharp : {false, true}) {
    Mesh mesh = grid(4);
    subdivide(mesh, {2, true, sharp});
    EXPECT_EQ(mesh.triangles(), 32u * 16);
    EXPECT_EQ(mesh.vertices(), 17u * 17);
    double corner = 9, middle = 9;
    for (uint32_t v = 0; v < mesh.vertices(); ++v) {
      const glm::dvec3 p = vertex(mesh.positions, v), n = vertex(mesh.normals, v);
      EXPECT_EQ(p.z, 0);
      EXPECT_NEAR(n.z, 1, 1e-6) << "boundaries and corners too";
      corner = std::min(corner, glm::length(p));
      middle = std::min(middle, glm::length(p - glm::dvec3(2, 2, 0)));
    }
    EXPECT_LT(middle, 1e-6);
    if (sharp) {
      EXPECT_EQ(corner, 0);
    } else {
      // A corner of two boundary edges (1, 0) and (0, 1): limit (1/6 of both), as B-splines.
      EXPECT_NEAR(corner, std::sqrt(2.) / 6, 1e-6);
    }
  }
}

TEST(Subdivide, SeamsOfTextureCoordinatesStay) {
  // Two triangles side by side; the right one has its own copies of the shared corners.
  Mesh mesh = mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 3, 4, 5},
                      {0, 0, 1, 0, 0, 1, 5, 0, 5, 1, 4, 1});
  subdivide(mesh, {1, false, true});
  EXPECT_EQ(mesh.triangles(), 8u);
  EXPECT_TRUE(mesh.normals.empty()) << "dmnormalsmooth false: flat";
  EXPECT_EQ(mesh.vertices(), 12u) << "six for each side of the seam";
  for (uint32_t v = 0; v < mesh.vertices(); ++v) {
    const glm::dvec3 p = vertex(mesh.positions, v);
    const auto u = double(mesh.uvs[2 * v]);
    EXPECT_TRUE(u <= 1 || u >= 4);
    // The shared edge is inside, not a boundary: its middle is the mean by 3/8 and 1/8.
    if (u == .5 && mesh.uvs[2 * v + 1] == .5f) {
      EXPECT_NEAR(p.x, .5, .1);
    }
  }
}

TEST(Subdivide, OddMeshesDoNotBreakIt) {
  // Three triangles at one edge, one with a repeated corner, and a vertex of its own.
  Mesh mesh = mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 9, 9, 9},
                      {0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 0, 2});
  subdivide(mesh, {2, true, false});
  EXPECT_EQ(mesh.triangles(), 48u);
  for (uint32_t i : mesh.indices) {
    const glm::dvec3 p = vertex(mesh.positions, i);
    EXPECT_LE(glm::length(p), 1.0001);
  }
}

class SubdivideStatements : public SceneTest {};

TEST_F(SubdivideStatements, LevelsSchemesAndBounds) {
  const std::vector<int32_t> faces = {0, 1, 2, 0, 2, 3};
  const std::vector<float> corners = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  shape(mesh(corners, faces, {integers("nsubdivlevels", {2})}));
  EXPECT_EQ(compile().triangles.size(), 32u);
  description.shapes.clear();
  shape(mesh(corners, faces, {integers("nlevels", {1}), text("subdivscheme", "catmull")}));
  EXPECT_EQ(compile().triangles.size(), 8u);
  EXPECT_SAID("scene.lxs:14:2: warning: unknown subdivision scheme \"catmull\": \"loop\" is used");
  description.shapes.clear();
  shape(mesh(corners, faces,
             {integers("nsubdivlevels", {2}), text("subdivscheme", "microdisplacement")}));
  EXPECT_EQ(compile().triangles.size(), 2u);
}

TEST_F(SubdivideStatements, TooManyTrianglesAreAnError) {
  // The triangle has no area, so that nothing is made of it; the count is what matters.
  ShapeEntry entry;
  entry.plugin = mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 1}, {integers("nsubdivlevels", {13})});
  ASSERT_TRUE(compile_shape(entry, description, diagnostics).has_value());
  EXPECT_SAID(
      "scene.lxs:13:2: error: 13 levels of subdivision make 4^13 triangles of each of 1, more than "
      "the 16777216 that are allowed: 12 are used; write \"integer nsubdivlevels\" [12]");
  entry.plugin = triangle({integers("nsubdivlevels", {-3})});
  EXPECT_EQ(compile_shape(entry, description, diagnostics)->mesh.triangles(), 1u);
}

}  // namespace
}  // namespace yat
