// Statements of analytic shapes and of the rarer meshes.

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "scene/stl.h"
#include "scene_builder.h"

namespace yat {
namespace {

constexpr double kPi = 3.141592653589793;

Matrix scale(double x, double y, double z) {
  return glm::scale(Matrix(1.), glm::dvec3(x, y, z));
}
Matrix translate(double x, double y, double z) {
  return glm::translate(Matrix(1.), glm::dvec3(x, y, z));
}

class CompileShapes : public SceneTest {
 protected:
  /// Where the row's own point (x, y, z) is in the world.
  static glm::dvec3 world(const Scene& scene, const ShapeRow<Value>& r, const glm::dvec3& p) {
    const glm::dmat3 rows(r.w_xx, r.w_xy, r.w_xz, r.w_yx, r.w_yy, r.w_yz, r.w_zx, r.w_zy, r.w_zz);
    return p * rows + glm::dvec3(r.org_x, r.org_y, r.org_z) + scene.center;
  }
};

TEST_F(CompileShapes, RowsAreByKindAndKeepTheirBinsAndLights) {
  const uint32_t light = area_light({number("power", 0)});
  const uint32_t mirror = material(plugin("mirror", {}));
  shape(plugin("torus", {}));
  shape(plugin("disk", {}), translate(1, 2, 3)).area_light = light;
  shape(plugin("sphere", {}), scale(1, 1, 2)).material = mirror;
  shape(plugin("cone", {}), translate(5, 0, 0)).area_light = light;
  shape(plugin("sphere", {}), scale(2, 2, 2));
  shape(plugin("plane", {}));
  const Scene scene = compile();
  ASSERT_EQ(scene.shapes.size(), 4u);
  EXPECT_EQ(scene.spheres.size(), 1u);
  const uint32_t ends[] = {0, 2, 3, 4};
  for (uint32_t k = 0; k < kShapeKinds; ++k) {
    EXPECT_EQ(scene.shape_rows[k].first, ends[k]);
    EXPECT_EQ(scene.shape_rows[k].end, ends[k + 1]);
    EXPECT_EQ(scene.veil_shape_rows[k].first, ends[k + 1]) << "no veils";
    EXPECT_EQ(scene.veil_shape_rows[k].end, ends[k + 1]);
  }
  const uint32_t first = scene.spheres.size() + scene.planes.size();
  const GeometryKind kinds[] = {GeometryKind::kQuadric, GeometryKind::kQuadric, GeometryKind::kDisk,
                                GeometryKind::kTorus};
  for (uint32_t s = 0; s < 4; ++s)
    EXPECT_EQ(scene.bins[scene.prim_bin[first + s]].geometry, kinds[s]) << s;
  EXPECT_EQ(scene.bins[scene.prim_bin[first]].material, MaterialKind::kMirror);
  EXPECT_TRUE(scene.bins[scene.prim_bin[first + 1]].emissive);
  EXPECT_FALSE(scene.bins[scene.prim_bin[first + 3]].emissive);
  ASSERT_EQ(scene.lights.size(), 2u);
  for (const uint32_t s : {1u, 2u}) {
    const LightRow<Value> row = scene.lights.row(scene.shapes.row(s).light);
    EXPECT_EQ(row.kind, uint32_t(LightKind::kShape));
    EXPECT_EQ(std::bit_cast<uint32_t>(row.a_x), s);
  }
  EXPECT_NEAR(scene.lights.row(scene.shapes.row(2).light).extra, kPi, 1e-5);
  EXPECT_EQ(scene.shapes.row(0).light, kNone);
  EXPECT_SILENT();
}

TEST_F(CompileShapes, MapsTakeOwnSpaceToTheWorld) {
  shape(plugin("disk", {number("radius", 2), number("height", 3)}), translate(1, 0, 0));
  shape(plugin("paraboloid", {number("radius", 2), number("zmax", 4), number("zmin", 1)}),
        translate(0, 1, 0) * scale(1, 1, -1));
  const Scene scene = compile();
  ASSERT_EQ(scene.shapes.size(), 2u);
  const ShapeRow<Value> bowl = scene.shapes.row(0), disk = scene.shapes.row(1);
  const auto near = [](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(a - b) < 1e-6;
  };
  EXPECT_TRUE(near(world(scene, disk, {0, 1, 0}), {1, 2, 3}));
  EXPECT_TRUE(near(world(scene, bowl, {1, 0, 0}), {2, 1, -4}));
  EXPECT_TRUE(near(world(scene, bowl, {0, 0, -1}), {0, 1, 0}));
  EXPECT_FLOAT_EQ(bowl.z_min, -.75f);
  // The scene's bounds hold them: the bowl from z = -4 to -1, the disk at 3.
  EXPECT_NEAR(scene.center.z, -.5, 1e-6);
}

// lxs 6.2: the area of a quadric ignores its transform.
TEST_F(CompileShapes, LightPowerByTheAreaBeforeTheTransform) {
  const uint32_t light = area_light({number("power", 100), number("efficacy", 17)});
  shape(plugin("disk", {number("radius", 2)}), scale(3, 3, 3)).area_light = light;
  shape(plugin("sphere", {number("zmin", 0), number("phimax", 180)}), scale(1, 2, 1)).area_light =
      light;
  const Scene scene = compile();
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_NEAR(double(scene.lights.row(0).radiance_r), 1700 / (kPi * 4 * kPi), 1e-3);
  EXPECT_NEAR(double(scene.lights.row(1).radiance_r), 1700 / (kPi * kPi), 1e-3);
  EXPECT_NEAR(double(scene.lights.row(0).extra), 36 * kPi, 1e-3) << "the world's, for the choice";
}

// u and v of planes are lengths of object space along two of its axes.
TEST_F(CompileShapes, PlanesHaveTextureCoordinates) {
  shape(plugin("plane", {}), translate(1, 2, 3) * scale(2, 4, 1));
  shape(plugin("plane", {numbers(ParameterType::kNormal, "n", {1, 0, 0})}), translate(1, 2, 3));
  const Scene scene = compile();
  const auto uv = [&](uint32_t row, const glm::dvec3& world) {
    const PlaneRow<Value> p = scene.planes.row(row);
    const glm::dvec3 at = world - scene.center;
    return glm::dvec2(glm::dot(glm::dvec3(p.u_x, p.u_y, p.u_z), at) + double(p.u_0),
                      glm::dot(glm::dvec3(p.v_x, p.v_y, p.v_z), at) + double(p.v_0));
  };
  const auto expect_uv = [&](uint32_t row, const glm::dvec3& world, double u, double v) {
    EXPECT_NEAR(uv(row, world).x, u, 1e-5);
    EXPECT_NEAR(uv(row, world).y, v, 1e-5);
  };
  expect_uv(0, {1, 2, 3}, 0, 0);
  expect_uv(0, {3, 2, 3}, 1, 0);
  expect_uv(0, {1, 10, 3}, 0, 2);
  expect_uv(1, {1, 3, 3}, 1, 0);
  expect_uv(1, {1, 2, 5}, 0, 2);
}

TEST_F(CompileShapes, ManyGetATree) {
  for (uint32_t i = 0; i < 4; ++i) shape(plugin("cylinder", {}), translate(3. * i, 0, 0));
  EXPECT_EQ(compile().shape_tree.view.node_count, 0u) << "four are tried one after the other";
  shape(plugin("sphere", {}), translate(0, 9, 0));
  const Scene scene = compile();
  EXPECT_GT(scene.shape_tree.view.node_count, 0u);
  EXPECT_LE(double(scene.shape_tree.view.min[2]), -1);
  EXPECT_EQ(scene.veil_shape_tree.view.node_count, 0u);
}

TEST_F(CompileShapes, NumbersThatLeaveNothing) {
  shape(triangle());
  shape(plugin("disk", {number("radius", 0)}, 20));
  shape(plugin("disk", {number("innerradius", 1)}, 22));
  shape(plugin("sphere", {number("zmin", 2), number("zmax", 3)}, 24));
  shape(plugin("cylinder", {number("phimax", 0)}, 28));
  shape(plugin("cone", {number("height", 0)}, 30));
  shape(plugin("torus", {number("thetamin", 10), number("thetamax", 10)}, 32));
  shape(plugin("hyperboloid", {numbers(ParameterType::kPoint, "p2", {0, 0, 5})}, 36));
  shape(plugin("paraboloid", {number("zmin", -2), number("zmax", -1)}, 38));
  EXPECT_EQ(compile().shapes.size(), 0u);
  EXPECT_SAID(
      "scene.lxs:21:2: warning: shape \"disk\": \"radius\" is 0, but must be above 0: left out");
  EXPECT_SAID(
      "scene.lxs:23:2: warning: shape \"disk\": \"innerradius\" is not below \"radius\": left out");
  EXPECT_SAID(
      "scene.lxs:25:2: warning: shape \"sphere\": nothing is left between \"zmin\" and \"zmax\": "
      "left out");
  EXPECT_SAID(
      "scene.lxs:29:2: warning: shape \"cylinder\": \"phimax\" leaves nothing of it: left out");
  EXPECT_SAID("scene.lxs:31:2: warning: shape \"cone\": \"height\" is 0: left out");
  EXPECT_SAID(
      "scene.lxs:33:2: warning: shape \"torus\": nothing is left between \"thetamin\" and "
      "\"thetamax\": left out");
  EXPECT_SAID(
      "scene.lxs:36:1: warning: shape \"hyperboloid\": \"p1\" and \"p2\" are on its axis: left "
      "out");
  EXPECT_SAID("scene.lxs:40:2: warning: shape \"paraboloid\": \"zmax\" must be above 0: left out");
}

TEST_F(CompileShapes, StandIns) {
  shape(plugin("torus", {number("minorradius", 2)}, 20));
  shape(plugin("hyperboloid",
               {numbers(ParameterType::kPoint, "p1", {1, -1, 2}),
                numbers(ParameterType::kPoint, "p2", {1, 2, 2})},
               30));
  shape(plugin("cylinder", {number("zmin", 1), number("zmax", 0)}, 40));
  const Scene scene = compile();
  EXPECT_EQ(scene.triangles.size(), 65536u);
  EXPECT_SAID(
      "scene.lxs:21:2: warning: a torus that cuts itself (\"minorradius\" above \"majorradius\") "
      "is rendered as 65000 triangles");
  EXPECT_SAID(
      "scene.lxs:31:2: warning: shape \"hyperboloid\": \"p1\" and \"p2\" are at one height: it is "
      "taken as a disk");
  EXPECT_SAID(
      "scene.lxs:41:2: warning: shape \"cylinder\": \"zmin\" is above \"zmax\": they are "
      "exchanged");
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_NEAR(double(scene.shapes.row(1).a), 1. / 5, 1e-6) << "from radius 1 to the root of 5";
}

TEST_F(CompileShapes, InstancesThatSqueezeASphere) {
  description.objects = {{"o", {}}};
  shape(plugin("sphere", {number("radius", 2)})).object = 0;
  description.instances.push_back({0, scale(3, 3, 3), kNone, {}});
  description.instances.push_back({0, scale(1, 1, 3) * translate(0, 0, 1), kNone, {}});
  const Scene scene = compile();
  EXPECT_EQ(scene.spheres.size(), 1u);
  ASSERT_EQ(scene.shapes.size(), 1u);
  const ShapeRow<Value> row = scene.shapes.row(0);
  EXPECT_NEAR(world(scene, row, {0, 0, 1}).z, 9, 1e-6);
  EXPECT_EQ(messages.size(), 1u) << "only that there is no light: " << all_said();
}

TEST_F(CompileShapes, Heightfields) {
  shape(plugin("heightfield",
               {integers("nu", {4}), integers("nv", {3}),
                numbers(ParameterType::kFloat, "Pz", {0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 3})}));
  shape(plugin(
      "heightfield",
      {integers("nu", {2}), integers("nv", {2}), numbers(ParameterType::kFloat, "Pz", {0, 0, 0})},
      20));
  shape(plugin("heightfield", {integers("nu", {1}), integers("nv", {2})}, 30));
  const Scene scene = compile();
  ASSERT_EQ(scene.triangles.size(), 2u * 3 * 2);
  double highest = 0;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const TriangleRow<Value> row = scene.triangles.row(t);
    EXPECT_GT((row.p1_x - row.p0_x) * (row.p2_y - row.p0_y) -
                  (row.p2_x - row.p0_x) * (row.p1_y - row.p0_y),
              0)
        << "outside is up";
    // (2/3, 1/2) has height 2.
    for (const auto& p :
         {glm::dvec3(row.p0_x, row.p0_y, row.p0_z), glm::dvec3(row.p1_x, row.p1_y, row.p1_z),
          glm::dvec3(row.p2_x, row.p2_y, row.p2_z)}) {
      const glm::dvec3 at = p + scene.center;
      if (std::abs(at.x - 2. / 3) < 1e-5 && std::abs(at.y - .5) < 1e-5) {
        EXPECT_NEAR(at.z, 2, 1e-6);
      }
      highest = std::max(highest, at.z);
    }
  }
  EXPECT_NEAR(highest, 3, 1e-6);
  EXPECT_SAID(
      "scene.lxs:23:2: error: \"Pz\" has 3 numbers where \"nu\" x \"nv\" need 4: the heightfield "
      "is left out");
  EXPECT_SAID("scene.lxs:31:2: error: a heightfield of 1 x 2 places has no face: left out");
}

TEST_F(CompileShapes, DeferredIsBuiltAtOnce) {
  shape(plugin("deferred", {text("shapename", "disk"), number("radius", 2),
                            numbers(ParameterType::kFloat, "shapebbox", {0, 1, 0, 1, 0, 1})}));
  shape(plugin("deferred", {text("shapename", "dusk")}, 20));
  EXPECT_EQ(compile().shapes.size(), 1u);
  EXPECT_SAID("scene.lxs:20:1: error: unknown shape \"dusk\" (did you mean \"disk\"?): left out");
}

std::string binary_stl(const std::vector<float>& corners) {
  std::string data(80, ' ');
  data.replace(0, 5, "solid");  // some programs do that
  const auto put = [&](uint32_t word) {
    for (int i = 0; i < 4; ++i) data += char(word >> (8 * i) & 0xff);
  };
  put(uint32_t(corners.size() / 9));
  for (size_t f = 0; f < corners.size(); f += 9) {
    for (int i = 0; i < 3; ++i) put(0);
    for (size_t i = 0; i < 9; ++i) put(std::bit_cast<uint32_t>(corners[f + i]));
    data += std::string(2, '\0');
  }
  return data;
}

const std::vector<float> kCorners = {0, 0, 1, 2, 0, 1, 0, 3, 1, 0, 3, 1, 2, 0, 1, 2, 3, 1};
constexpr const char* kAsciiStl =
    "solid two triangles vertex\n facet normal 0 0 1\n  outer loop\n"
    "   vertex 0 0 1\n   vertex 2.0 0 1e0\n   vertex 0 3 +1\n  endloop\n endfacet\n"
    " facet normal 0 0 0\r\n outer loop\r\n vertex 0 3 1 vertex 2 0 1 vertex 2 3 1\r\n endloop "
    "endfacet\nendsolid two triangles\n";

TEST(Stl, AsciiAndBinary) {
  EXPECT_EQ(parse_stl(kAsciiStl, "a.stl"), kCorners);
  EXPECT_EQ(parse_stl(binary_stl(kCorners), "b.stl"), kCorners);
}

TEST(Stl, BrokenFiles) {
  const auto message = [](std::string_view data) -> std::string {
    try {
      parse_stl(data, "x.stl");
    } catch (const StlError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(message("hello"), "x.stl: is no STL file");
  std::string cut = binary_stl(kCorners);
  cut[0] = 'x';
  cut.resize(cut.size() - 60);
  EXPECT_EQ(message(cut), "x.stl: it counts 2 triangles, but ends after 0");
  EXPECT_EQ(message("solid s\nvertex 0 0 O"), "x.stl: \"O\" is not a number");
  EXPECT_EQ(message("solid s\nvertex 0 0 0\nvertex 0 0 1\nendsolid"),
            "x.stl: it has 2 corners, which do not make whole triangles");
}

TEST_F(CompileShapes, StlMeshes) {
  const std::filesystem::path folder = std::filesystem::path(YAT_TEST_OUTPUT_DIR) / "stl";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.stl") << kAsciiStl;
  std::ofstream(folder / "b.stl", std::ios::binary) << binary_stl(kCorners);
  description.directory = folder.string();
  shape(plugin("stlmesh", {text("filename", "a.stl")}));
  shape(plugin("stlmesh", {text("filename", "b.stl"), text("recenter_mesh", "true")}));
  shape(plugin("stlmesh", {text("filename", "no.stl")}, 20));
  const Scene scene = compile();
  ASSERT_EQ(scene.triangles.size(), 4u);
  EXPECT_EQ(scene.triangle_vertices.size(), 0u) << "flat";
  // The first from (0,0,1) to (2,3,1), the second about the origin.
  EXPECT_NEAR(scene.center.x, .5, 1e-6);
  EXPECT_NEAR(scene.center.z, .5, 1e-6);
  EXPECT_NEAR(double(scene.triangles.row(2).p0_x) + scene.center.x, -1, 1e-6);
  EXPECT_SAID("scene.lxs:21:2: error: mesh file \"no.stl\" not found: the shape is left out");
}

}  // namespace
}  // namespace yat
