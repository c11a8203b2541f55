// Tangents of surfaces: along dp/du, across the shading normal, whatever the triangle.

#include <cmath>

#include "kernel_columns.h"

namespace yat {
namespace {

class Tangents : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Tangents);

struct Rows {
  uint32_t n;
  Table<Surface> surfaces;
  GuardedColumn<float> x, y, z;
  explicit Rows(uint32_t rows) : n(rows), surfaces(rows), x(rows), y(rows), z(rows) {}
  Tangent<Column> columns() { return {x.data(), y.data(), z.data()}; }
  glm::dvec3 tangent(uint32_t i) const { return {x[i], y[i], z[i]}; }
  void set(uint32_t i, uint32_t prim, const glm::dvec3& ng, const glm::dvec3& ns,
           const glm::dvec3& pos = {}) {
    Surface<Value> s{};
    s.pos_x = float(pos.x), s.pos_y = float(pos.y), s.pos_z = float(pos.z);
    s.ng_x = float(ng.x), s.ng_y = float(ng.y), s.ng_z = float(ng.z);
    s.ns_x = float(ns.x), s.ns_y = float(ns.y), s.ns_z = float(ns.z);
    s.prim = prim;
    surfaces.set(i, s);
  }
};

/// The direction that LuxRender takes for n where there is no dp/du, across ns.
glm::dvec3 arbitrary(const glm::dvec3& n, const glm::dvec3& ns) {
  const glm::dvec3 t =
      std::abs(n.x) > std::abs(n.y) ? glm::dvec3(-n.z, 0, n.x) : glm::dvec3(0, n.z, -n.y);
  return glm::normalize(t - glm::dot(t, ns) * ns);
}

TEST_P(Tangents, AreAlongDpDuOfTriangles) {
  const KernelTable& k = kernels();
  Random random(5);
  for (const uint32_t n : tail_counts(k.lanes)) {
    RowTable<TriangleRow> triangles(std::max(n, 1u));
    RowTable<TriangleVertexRow> vertices(std::max(n, 1u));
    Rows rows(n);
    std::vector<glm::dvec3> wanted(n);
    for (uint32_t i = 0; i < n; ++i) {
      // Of any size; every third without coordinates.
      const double size = std::pow(10., double(i % 13) - 6);
      const glm::dvec3 p0 = size * random.direction(), p1 = size * random.direction(),
                       p2 = size * random.direction();
      TriangleRow<Value> t{};
      t.p0_x = float(p0.x), t.p0_y = float(p0.y), t.p0_z = float(p0.z);
      t.p1_x = float(p1.x), t.p1_y = float(p1.y), t.p1_z = float(p1.z);
      t.p2_x = float(p2.x), t.p2_y = float(p2.y), t.p2_z = float(p2.z);
      triangles.set(i, t);
      TriangleVertexRow<Value> v{};
      v.u0 = .25f, v.v0 = .5f, v.u1 = 1, v.v1 = -.25f, v.u2 = i % 2 ? .75f : -.75f, v.v2 = 2;
      if (i % 3 == 2) v.u0 = v.u1 = v.u2 = v.v0 = v.v1 = v.v2 = .5f;
      vertices.set(i, v);
      const glm::dvec3 ng = glm::normalize(glm::cross(p1 - p0, p2 - p0));
      const glm::dvec3 ns = glm::normalize(ng + .3 * random.direction());
      rows.set(i, i, ng, ns);
      // Two equations: p = p0 + (u - u0) dp/du + (v - v0) dp/dv at vertices 1 and 2.
      const double du1 = double(v.u1 - v.u0), du2 = double(v.u2 - v.u0), dv1 = double(v.v1 - v.v0),
                   dv2 = double(v.v2 - v.v0);
      const glm::dvec3 along = (dv2 * (p1 - p0) - dv1 * (p2 - p0)) / (du1 * dv2 - dv1 * du2);
      wanted[i] = i % 3 == 2 ? arbitrary(ng, ns) : glm::normalize(along - glm::dot(along, ns) * ns);
    }
    SceneView scene{};
    scene.geometry.triangles = triangles.view();
    scene.geometry.triangle_vertices = vertices.view();
    k.make_tangents[uint32_t(GeometryKind::kTriangleVertex)](scene, rows.surfaces.view(),
                                                             rows.columns(), n);
    EXPECT_TRUE(rows.x.untouched() && rows.y.untouched() && rows.z.untouched());
    for (uint32_t i = 0; i < n; ++i) expect_near(rows.tangent(i), wanted[i], 2e-4, "tangent", i);
  }
}

TEST_P(Tangents, GoAroundAxesOfSpheresAndAreNeverZero) {
  const KernelTable& k = kernels();
  Random random(6);
  constexpr uint32_t n = 101;
  RowTable<SphereRow> spheres(n);
  Rows rows(n);
  std::vector<glm::dvec3> wanted(n);
  for (uint32_t i = 0; i < n; ++i) {
    const glm::dvec3 center = random.point(5), z = random.direction();
    const glm::dvec3 x = glm::normalize(glm::cross(z, random.direction()));
    const double hand = i % 2 ? 1 : -1, radius = std::pow(10., double(i % 7) - 3);
    SphereRow<Value> s{};
    s.center_x = float(center.x), s.center_y = float(center.y), s.center_z = float(center.z);
    s.radius = float(radius);
    s.x_x = float(x.x), s.x_y = float(x.y), s.x_z = float(x.z);
    s.z_x = float(z.x), s.z_y = float(z.y), s.z_z = float(z.z);
    s.hand = float(hand);
    spheres.set(i, s);
    // Seen from inside too.
    const glm::dvec3 out = random.direction(), ng = i % 3 ? out : -out;
    const glm::dvec3 ns = glm::normalize(ng + .2 * random.direction());
    rows.set(i, 2 + i, ng, ns, center + radius * out);
    const glm::dvec3 around = hand * glm::cross(z, out);
    wanted[i] = glm::normalize(around - glm::dot(around, ns) * ns);
  }
  // A pole.
  SphereRow<Value> pole{};
  pole.radius = 1, pole.z_z = 1, pole.x_x = 1, pole.hand = 1;
  spheres.set(0, pole);
  rows.set(0, 2, {0, 0, 1}, {0, 0, 1}, {0, 0, 1});
  wanted[0] = arbitrary({0, 0, 1}, {0, 0, 1});
  SceneView scene{};
  scene.geometry.triangles.count = 2;
  scene.geometry.spheres = spheres.view();
  k.make_tangents[uint32_t(GeometryKind::kSphere)](scene, rows.surfaces.view(), rows.columns(), n);
  for (uint32_t i = 0; i < n; ++i)
    // Small ones far from the origin have a rounded place.
    expect_near(rows.tangent(i), wanted[i], i % 7 < 2 ? 2e-2 : 1e-4, "sphere", i);
}

TEST_P(Tangents, OfPlanesAreWhereUGrows) {
  const KernelTable& k = kernels();
  Random random(7);
  constexpr uint32_t n = 50;
  RowTable<PlaneRow> planes(n);
  Rows rows(n);
  std::vector<glm::dvec3> wanted(n);
  for (uint32_t i = 0; i < n; ++i) {
    const glm::dvec3 normal = random.direction();
    const glm::dvec3 du = 3. * glm::normalize(glm::cross(normal, random.direction()));
    const glm::dvec3 dv = .5 * glm::cross(normal, du) + .3 * du;
    // u and v of du * u + dv * v.
    const glm::dvec3 u = glm::cross(dv, normal) / glm::dot(du, glm::cross(dv, normal));
    const glm::dvec3 v = glm::cross(du, normal) / glm::dot(dv, glm::cross(du, normal));
    PlaneRow<Value> p{};
    p.normal_x = float(normal.x), p.normal_y = float(normal.y), p.normal_z = float(normal.z);
    p.u_x = float(u.x), p.u_y = float(u.y), p.u_z = float(u.z);
    p.v_x = float(v.x), p.v_y = float(v.y), p.v_z = float(v.z);
    planes.set(i, p);
    const glm::dvec3 ns = glm::normalize(normal + .2 * random.direction());
    rows.set(i, 5 + i, normal, ns);
    wanted[i] = glm::normalize(du - glm::dot(du, ns) * ns);
  }
  SceneView scene{};
  scene.geometry.triangles.count = 3;
  scene.geometry.spheres.count = 2;
  scene.geometry.planes = planes.view();
  k.make_tangents[uint32_t(GeometryKind::kPlane)](scene, rows.surfaces.view(), rows.columns(), n);
  for (uint32_t i = 0; i < n; ++i) expect_near(rows.tangent(i), wanted[i], 1e-5, "plane", i);
}

}  // namespace
}  // namespace yat
