// Shapes: which way they face, what is dropped, where they end up.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "scene_builder.h"

namespace yat {
namespace {

glm::dvec3 vertex(const TriangleRow<Value>& t, int k) {
  const float* p = &t.p0_x + 3 * k;
  return {double(p[0]), double(p[1]), double(p[2])};
}
glm::dvec3 outside(const TriangleRow<Value>& t) {
  const glm::dvec3 p0 = vertex(t, 0);
  return glm::normalize(glm::cross(vertex(t, 1) - p0, vertex(t, 2) - p0));
}
Parameter normals(std::vector<float> n) {
  return numbers(ParameterType::kNormal, "N", std::move(n));
}
Matrix scale(double x, double y, double z) {
  return glm::scale(Matrix(1.), glm::dvec3(x, y, z));
}
Matrix translate(double x, double y, double z) {
  return glm::translate(Matrix(1.), glm::dvec3(x, y, z));
}

using CompileGeometry = SceneTest;

// lxs 2.5, the whole table: a triangle that faces +z in object space.
TEST_F(CompileGeometry, SideOfTriangles) {
  struct Case {
    bool reverse, mirror_x, mirror_z;
    float vertex_normal_z;  // 0: none given
    double faces_z;
  };
  const Case cases[] = {
      {false, false, false, 0, 1},
      {true, false, false, 0, -1},
      {false, true, false, 0, 1},   // mirroring alone keeps the object's outside
      {false, false, true, 0, -1},  // ... and the object's +z is the world's -z here
      {true, true, false, 0, -1},
      {true, false, true, 0, 1},
      // Vertex normals decide; negated by ReverseOrientation, mapped with the object.
      {false, false, false, -1, -1},
      {false, false, false, 1, 1},
      {true, false, false, -1, 1},
      {true, false, false, 1, -1},
      {false, true, false, -1, -1},
      {false, false, true, 1, -1},
      {false, false, true, -1, 1},
      {true, true, false, -1, 1},
  };
  for (const Case& c : cases) {
    description.shapes.clear();
    std::vector<Parameter> more;
    // Slightly apart, so that the mesh is not flat.
    if (c.vertex_normal_z != 0)
      more.push_back(
          normals({.1f, 0, c.vertex_normal_z, 0, .1f, c.vertex_normal_z, 0, 0, c.vertex_normal_z}));
    shape(triangle(more), scale(c.mirror_x ? -2 : 2, 2, c.mirror_z ? -2 : 2)).reverse_orientation =
        c.reverse;
    const Scene scene = compile();
    const auto label = testing::Message() << "reverse " << c.reverse << " mirror " << c.mirror_x
                                          << c.mirror_z << " N " << c.vertex_normal_z;
    ASSERT_EQ(scene.triangles.size(), 1u) << label;
    EXPECT_NEAR(outside(scene.triangles.row(0)).z, c.faces_z, 1e-6) << label;
    if (c.vertex_normal_z != 0) {
      ASSERT_EQ(scene.triangle_vertices.size(), 1u) << label;
      const auto v = scene.triangle_vertices.row(0);
      EXPECT_GT(double(v.n0_z) * c.faces_z, .9) << label;
      EXPECT_NEAR(std::hypot(v.n0_x, v.n0_y, v.n0_z), 1, 1e-6) << label;
    }
  }
}

TEST_F(CompileGeometry, VerticesKeepTheirNormalsWhenSwapped) {
  shape(triangle({normals({.1f, 0, 1, 0, .2f, 1, .3f, .3f, 1}),
                  numbers(ParameterType::kFloat, "uv", {0, 0, 1, 0, 0, 1})}))
      .reverse_orientation = true;
  const Scene scene = compile();
  const auto t = scene.triangles.row(0);
  const auto v = scene.triangle_vertices.row(0);
  // p1 and p2 are exchanged: p1 is now object (0, 1, 0), whose normal was (.3, .3, 1) negated.
  EXPECT_GT(t.p1_y, t.p0_y);
  EXPECT_NEAR(v.n1_x, -.3f / std::sqrt(1.18f), 1e-6);
  EXPECT_NEAR(v.n2_y, -.2f / std::sqrt(1.04f), 1e-6);
  EXPECT_EQ(v.u1, 0);
  EXPECT_EQ(v.v1, 1);
}

TEST_F(CompileGeometry, NormalsByInverseTranspose) {
  // The plane x + z = const squeezed to half in x: its normal becomes (2, 0, 1).
  const float n = std::sqrt(.5f);
  shape(mesh({0, 0, 1, 1, 0, 0, 0, 1, 1}, {0, 1, 2}, {normals({n, 0, n, n, .1f, n, n, 0, n})}),
        scale(.5, 1, 1));
  const auto v = compile().triangle_vertices.row(0);
  EXPECT_NEAR(v.n0_x / v.n0_z, 2, 1e-5);
  EXPECT_EQ(v.n0_y, 0);
}

TEST_F(CompileGeometry, MeshWithoutNormalsIsFlatAndSoIsOneWhoseNormalsAgree) {
  shape(triangle());
  shape(triangle({normals({0, 0, 2, 0, 0, 2, 0, 0, 2})}));
  const Scene scene = compile();
  EXPECT_EQ(scene.triangle_vertices.size(), 0u);
  ASSERT_EQ(scene.bins.size(), 2u);
  EXPECT_EQ(scene.bins[1].geometry, GeometryKind::kTriangleFlat);
  EXPECT_EQ(scene.bins[1].primitives, 2u);
  EXPECT_EQ(scene.prim_bin[0], 1u);
}

TEST_F(CompileGeometry, SceneFarAwayIsTheSceneAtTheOrigin) {
  shape(square(), translate(1e6, -2e6, 3e6));
  description.world_to_camera = translate(-1e6, 2e6, -3e6 + 5);
  const Scene far = compile();
  description.shapes[0].to_world = Matrix(1.);
  description.world_to_camera = translate(0, 0, 5);
  const Scene near = compile();
  EXPECT_EQ(far.center, glm::dvec3(1e6, -2e6, 3e6));
  for (uint32_t t = 0; t < 2; ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(vertex(far.triangles.row(t), k), vertex(near.triangles.row(t), k));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(far.camera.origin[k], near.camera.origin[k]);
  EXPECT_EQ(near.camera.origin[2], -5);
  EXPECT_GE(near.radius, 5);
}

TEST_F(CompileGeometry, QuadsSplitAlongTheShorterDiagonal) {
  // A kite: 0-2 is 4 long, 1-3 is 2.
  Plugin quad =
      plugin("mesh", {integers("quadindices", {0, 1, 2, 3}),
                      numbers(ParameterType::kPoint, "P", {-2, 0, 0, 0, -1, 0, 2, 0, 0, 0, 1, 0})});
  shape(quad);
  shape(quad, scale(.1, 1, 1));  // in the world 0-2 is now the shorter
  const Scene scene = compile();
  ASSERT_EQ(scene.triangles.size(), 4u);
  const auto has = [&](uint32_t t, glm::dvec3 p) {
    for (int k = 0; k < 3; ++k)
      if (glm::length(vertex(scene.triangles.row(t), k) - p) < 1e-6) return true;
    return false;
  };
  for (uint32_t t : {0u, 1u}) EXPECT_TRUE(has(t, {0, -1, 0}) && has(t, {0, 1, 0}));
  for (uint32_t t : {2u, 3u}) EXPECT_TRUE(has(t, {-.2, 0, 0}) && has(t, {.2, 0, 0}));
  for (uint32_t t = 0; t < 4; ++t) EXPECT_NEAR(outside(scene.triangles.row(t)).z, 1, 1e-9);
}

TEST_F(CompileGeometry, IndexOutOfRangeDropsTheMesh) {
  shape(triangle());
  shape(mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 0, 1, 3}));
  EXPECT_EQ(compile().triangles.size(), 1u);
  EXPECT_SAID(
      "scene.lxs:11:2: error: index 3 at place 5 of \"triindices\" is out of range: there "
      "are 3 vertices; the mesh is left out");
  EXPECT_EQ(diagnostics.error_count(), 1u);
}

TEST_F(CompileGeometry, OddCounts) {
  shape(mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 0, 1}, {normals({0, 0, 1, 0, 0, 1})}));
  EXPECT_EQ(compile().triangles.size(), 1u);
  EXPECT_SAID(
      "scene.lxs:11:2: error: \"triindices\" has 5 numbers, which is not a multiple of 3: "
      "the last 2 are dropped");
  EXPECT_SAID("scene.lxs:13:2: error: \"N\" has 6 numbers where 3 vertices need 9: it is ignored");
}

TEST_F(CompileGeometry, MissingParts) {
  shape(plugin("mesh", {integers("indices", {0, 1, 2})}, 40));
  shape(plugin("mesh", {numbers(ParameterType::kPoint, "P", {0, 0, 0, 1, 0, 0, 0, 1, 0})}, 50));
  EXPECT_EQ(error(), "error: nothing to render: none of the 2 shapes can be seen");
  EXPECT_SAID("scene.lxs:40:1: error: shape \"mesh\" has no vertices (\"point P\"): left out");
  EXPECT_SAID(
      "scene.lxs:50:1: error: shape \"mesh\" has no faces (\"integer triindices\" or "
      "\"quadindices\"): left out");
}

TEST_F(CompileGeometry, DegenerateTrianglesAreDroppedAndCounted) {
  shape(mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, NAN, 0, 0, 0, INFINITY, 0},
             {0, 1, 2, 0, 1, 3, 0, 0, 1, 0, 1, 4, 5, 1, 2}));
  const Scene scene = compile();
  EXPECT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.degenerate_triangles, 4u);
  EXPECT_SAID(
      "scene.lxs:10:1: warning: 2 triangles have no area, 2 triangles have a vertex that is "
      "NaN or infinite: left out");
  EXPECT_EQ(scene.center, glm::dvec3(1, .5, 0)) << "the NaN must not move the centre";
}

TEST_F(CompileGeometry, BadNormalsTakeTheFaces) {
  shape(triangle({normals({0, 0, 0, NAN, 0, 1, .5f, 0, 1})}));
  const Scene scene = compile();
  const auto v = scene.triangle_vertices.row(0);
  EXPECT_EQ(v.n0_z, 1);
  EXPECT_EQ(v.n1_z, 1);
  EXPECT_NEAR(v.n2_x, .5f / std::sqrt(1.25f), 1e-6);
  EXPECT_SAID(
      "scene.lxs:10:1: warning: 2 corners' normals are zero, NaN or infinite: the face's "
      "normal is used there");
}

TEST_F(CompileGeometry, NormalBehindItsFaceIsLaidIntoIt) {
  shape(triangle({normals({1, 0, -.2f, 0, 0, 1, 0, 0, 1})}));
  const auto v = compile().triangle_vertices.row(0);
  EXPECT_FLOAT_EQ(v.n0_x, 1);
  EXPECT_GE(v.n0_z, 0);
}

TEST_F(CompileGeometry, SingularTransformsDropTheShape) {
  shape(triangle());
  shape(triangle(), scale(1, 1, 0));
  EXPECT_EQ(compile().triangles.size(), 1u);
  EXPECT_SAID(
      "scene.lxs:10:1: error: the transform of shape \"mesh\" is singular or not finite: "
      "left out");
}

TEST_F(CompileGeometry, WholeSpheres) {
  shape(plugin("sphere", {number("radius", 2)}), translate(1, 2, 3) * scale(-3, 3, 3));
  shape(plugin("sphere", {number("radius", 2)}), translate(1, 2, 3) * scale(3, 3, 3))
      .reverse_orientation = true;
  const Scene scene = compile();
  ASSERT_EQ(scene.spheres.size(), 2u);
  EXPECT_FLOAT_EQ(scene.spheres.row(0).radius, 6);
  EXPECT_EQ(scene.spheres.row(0).inward, 0u) << "mirroring keeps outward outward";
  EXPECT_EQ(scene.spheres.row(1).inward, 1u);
  EXPECT_EQ(scene.spheres.row(0).occludes, 1u);
  EXPECT_EQ(scene.center, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.bins[scene.prim_bin[0]].geometry, GeometryKind::kSphere);
  EXPECT_EQ(messages.size(), 1u) << "only that there is no light: " << all_said();
}

TEST_F(CompileGeometry, Planes) {
  // n . p = 0 in object space; the inverse transpose maps the normal.
  shape(plugin("plane", {numbers(ParameterType::kNormal, "n", {1, 0, 1})}),
        translate(0, 0, 5) * scale(.5, 1, 1));
  shape(plugin("plane", {})).reverse_orientation = true;
  // As the scenes of YART, whose shape it is, spell it.
  shape(plugin("plane", {numbers(ParameterType::kNormal, "N", {0, 1, 0})}));
  const Scene scene = compile();
  EXPECT_EQ(messages.size(), 1u) << "only that there is no light: " << all_said();
  ASSERT_EQ(scene.planes.size(), 3u);
  EXPECT_EQ(scene.planes.row(2).normal_y, 1);
  const auto p = scene.planes.row(0);
  EXPECT_NEAR(p.normal_x, 2 / std::sqrt(5.), 1e-6);
  EXPECT_NEAR(p.normal_z, 1 / std::sqrt(5.), 1e-6);
  // (0, 0, 5) lies in it.
  EXPECT_NEAR(double(p.distance), double(p.normal_z) * (5 - scene.center.z), 1e-5);
  EXPECT_EQ(scene.planes.row(1).normal_z, -1);
}

TEST_F(CompileGeometry, BoxesFaceOutwards) {
  shape(plugin("box", {number("width", 1), number("height", 2), number("depth", 3)}));
  const Scene scene = compile();
  ASSERT_EQ(scene.triangles.size(), 12u);
  double area = 0;
  for (uint32_t t = 0; t < 12; ++t) {
    const auto row = scene.triangles.row(t);
    EXPECT_GT(glm::dot(outside(row), vertex(row, 0)), 0) << t;
    const auto p0 = vertex(row, 0);
    area += .5 * glm::length(glm::cross(vertex(row, 1) - p0, vertex(row, 2) - p0));
  }
  EXPECT_DOUBLE_EQ(area, 8 * (1 * 2 + 2 * 3 + 3 * 1));
}

TEST_F(CompileGeometry, ObjectsAppearOncePerInstance) {
  description.objects = {{"o", {}}, {"never", {}}};
  shape(triangle(), translate(1, 0, 0)).object = 0;
  shape(plugin("nonsense", {})).object = 1;  // never placed: not even looked at
  const uint32_t red = material(plugin("matte", {color("Kd", 1, 0, 0)}));
  const uint32_t glass = material(plugin("glass", {}));
  description.shapes[0].material = red;
  description.instances.push_back({0, scale(2, 2, 2), kNone, {}});
  description.instances.push_back({0, translate(0, 0, 7), glass, {}});
  const Scene scene = compile();
  ASSERT_EQ(scene.triangles.size(), 2u);
  // world = instance * shape: (1,0,0) doubled, and moved.
  EXPECT_EQ(vertex(scene.triangles.row(0), 0) + scene.center, glm::dvec3(2, 0, 0));
  EXPECT_EQ(vertex(scene.triangles.row(1), 0) + scene.center, glm::dvec3(1, 0, 7));
  EXPECT_EQ(scene.bins[scene.prim_bin[0]].material, MaterialKind::kMatte);
  EXPECT_EQ(scene.bins[scene.prim_bin[1]].material, MaterialKind::kGlass) << "overridden";
  EXPECT_EQ(scene.parameter_rows[uint32_t(MaterialKind::kMatte)], 1u);
}

TEST_F(CompileGeometry, ShapesLeftOut) {
  shape(triangle());
  shape(plugin("nurbs", {number("nu", 4)}, 20));
  shape(plugin("nurbs", {}, 21));
  shape(plugin("shpere", {}, 22));
  compile();
  EXPECT_SAID("scene.lxs:20:1: warning: shape \"nurbs\" is not supported: left out");
  EXPECT_SAID(
      "scene.lxs:22:1: error: unknown shape \"shpere\" (did you mean \"sphere\"?): left out");
  EXPECT_EQ(std::count_if(messages.begin(), messages.end(),
                          [](const std::string& m) { return m.find("nurbs") != m.npos; }),
            1);
}

TEST_F(CompileGeometry, PlyMeshIsSmooth) {
  const std::filesystem::path folder = std::filesystem::path(YAT_TEST_OUTPUT_DIR) / "compile";
  std::filesystem::create_directories(folder);
  // Two squares at a right angle along the y axis, sharing the edge 1-2: there the mean of the unit
  // normals (0,0,1) and (-1,0,0), whatever their areas.
  std::ofstream(folder / "fold.ply") << "ply\nformat ascii 1.0\nelement vertex 6\n"
                                        "property float x\nproperty float y\nproperty float z\n"
                                        "element face 2\n"
                                        "property list uchar int vertex_indices\nend_header\n"
                                        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 5\n1 1 5\n"
                                        "4 0 1 2 3\n4 1 4 5 2\n";
  description.directory = folder.string();
  shape(plugin("plymesh", {text("filename", "C:\\elsewhere\\fold.ply")}));
  const Scene scene = compile();
  ASSERT_EQ(scene.triangles.size(), 4u);
  ASSERT_EQ(scene.triangle_vertices.size(), 4u);
  bool found = false;
  for (uint32_t t = 0; t < 4; ++t) {
    const auto row = scene.triangles.row(t);
    const auto v = scene.triangle_vertices.row(t);
    if (vertex(row, 0) + scene.center != glm::dvec3(1, 0, 0)) continue;
    found = true;
    // One or two of each square's triangles meet at vertex 1, depending on the diagonal:
    // unweighted, z / -x is from 1/2 to 2; weighted by area (1 to 5) it would be 2/5 at most.
    EXPECT_LT(v.n0_x, 0);
    EXPECT_GE(double(v.n0_z / -v.n0_x), .4999);
    EXPECT_LE(double(v.n0_z / -v.n0_x), 2.0001);
  }
  EXPECT_TRUE(found);
  EXPECT_SAID("scene.lxs:11:2: note: \"C:\\elsewhere\\fold.ply\" not found: \"" +
              (folder / "fold.ply").string() + "\" is used");
}

TEST_F(CompileGeometry, MissingPlyLeavesTheShapeOut) {
  shape(triangle());
  shape(plugin("plymesh", {text("filename", "gone.ply")}));
  EXPECT_EQ(compile().triangles.size(), 1u);
  EXPECT_SAID("scene.lxs:11:2: error: mesh file \"gone.ply\" not found: the shape is left out");
}

}  // namespace
}  // namespace yat
