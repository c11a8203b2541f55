#include "bench_scenes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "scene/ply.h"

namespace yat::bench {
namespace {

using glm::dvec3;

void add(BenchScene& scene, const dvec3& a, const dvec3& b, const dvec3& c) {
  for (const dvec3& p : {a, b, c})
    for (int axis = 0; axis < 3; ++axis) scene.corners.push_back(float(p[axis]));
}

void quad(BenchScene& scene, const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  add(scene, a, b, c);
  add(scene, a, c, d);
}

void box(BenchScene& scene, const dvec3& low, const dvec3& high) {
  const auto p = [&](int i) {
    return dvec3{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
  };
  constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) quad(scene, p(f[0]), p(f[1]), p(f[2]), p(f[3]));
}

/// Rows [first, last) of a grid, each of `columns` quads, over point(row, column).
template <class F>
void grid(BenchScene& scene, uint32_t first, uint32_t last, uint32_t columns, F&& point) {
  for (uint32_t i = first; i < last; ++i)
    for (uint32_t j = 0; j < columns; ++j)
      quad(scene, point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
}

/// n >= 2 with n^2 as near as can be to `squares`.
uint32_t side_of(double squares) {
  return std::max(2u, uint32_t(std::lround(std::sqrt(squares))));
}

/// A displaced sphere of 4 n (n - 1) triangles; `kind` chooses its bumps.
void rough_ball(BenchScene& scene, const dvec3& centre, double radius, uint32_t n, uint32_t kind) {
  const auto point = [&](uint32_t i, uint32_t j) {
    const double theta = M_PI * i / n, phi = M_PI * (j % (2 * n)) / n;
    const double r = 1 + 0.08 * std::sin(9 * theta) * std::sin((7 + kind) * phi) +
                     0.03 * std::sin(31 * theta) * std::cos((23 - kind) * phi);
    const double level = i == 0 || i == n ? 0 : std::sin(theta);
    return centre +
           radius * r * dvec3{level * std::cos(phi), std::cos(theta), level * std::sin(phi)};
  };
  grid(scene, 1, n - 1, 2 * n, point);
  for (uint32_t j = 0; j < 2 * n; ++j) {
    add(scene, point(0, j), point(1, j + 1), point(1, j));
    add(scene, point(n - 1, j), point(n - 1, j + 1), point(n, j));
  }
}

void bounds(const BenchScene& scene, dvec3& low, dvec3& high) {
  low = dvec3(1e30), high = dvec3(-1e30);
  for (size_t i = 0; i < scene.corners.size(); ++i) {
    const int axis = int(i % 3);
    low[axis] = std::min(low[axis], double(scene.corners[i]));
    high[axis] = std::max(high[axis], double(scene.corners[i]));
  }
}

void finish(BenchScene& scene) {
  scene.rows.resize(scene.triangles());
  for (uint32_t i = 0; i < scene.triangles(); ++i) {
    TriangleRow<Value> row{};
    std::memcpy(&row.p0_x, scene.corners.data() + size_t(i) * 9, 36);
    scene.rows.set(i, row);
  }
}

/// A closed room around the triangles so far, its camera, and a lamp under the ceiling.
void add_room(BenchScene& scene) {
  dvec3 low, high;
  bounds(scene, low, high);
  const dvec3 size = high - low;
  const double s = std::max({size.x, size.y, size.z});
  box(scene, low - dvec3{s, 0.001 * s, s}, high + s);
  const dvec3 middle = (low + high) * 0.5;
  scene.view = {middle + dvec3{0.5 * s, 0.4 * s, 1.25 * s},
                middle,
                dvec3{middle.x - 0.3 * s, high.y + 0.99 * s, middle.z - 0.3 * s},
                {0.6 * s, 0, 0},
                {0, 0, 0.6 * s}};
}

BenchScene read_mesh(const std::string& file) {
  const PlyMesh mesh = read_ply(file);
  BenchScene s;
  s.name = std::filesystem::path(file).stem().string();
  s.corners.reserve(mesh.triangles.size() * 3 + 200);
  for (const uint32_t vertex : mesh.triangles)
    for (size_t axis = 0; axis < 3; ++axis)
      s.corners.push_back(mesh.positions[size_t(vertex) * 3 + axis]);
  if (s.corners.empty()) throw Error(file + ": error: no triangles to trace");
  return s;
}

}  // namespace

BenchScene scene_of(std::string name, std::vector<float> corners) {
  BenchScene s;
  s.name = std::move(name);
  s.corners = std::move(corners);
  finish(s);
  return s;
}

BenchScene cornell_box() {
  BenchScene s;
  s.name = "cornell";
  quad(s, {552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2});
  quad(s, {556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0});
  quad(s, {549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2});
  quad(s, {0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2});
  quad(s, {552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0});
  const auto block = [&](double h, dvec3 a, dvec3 b, dvec3 c, dvec3 d) {
    const dvec3 up{0, h, 0};
    quad(s, a + up, b + up, c + up, d + up);
    quad(s, d, d + up, c + up, c);
    quad(s, a, a + up, d + up, d);
    quad(s, b, b + up, a + up, a);
    quad(s, c, c + up, b + up, b);
  };
  block(165, {130, 0, 65}, {82, 0, 225}, {240, 0, 272}, {290, 0, 114});
  block(330, {423, 0, 247}, {265, 0, 296}, {314, 0, 456}, {472, 0, 406});
  quad(s, {343, 548.7, 227}, {343, 548.7, 332}, {213, 548.7, 332}, {213, 548.7, 227});
  // The room stands around the origin, as compiled scenes do.
  for (float& x : s.corners) x = (x - 278.f) / 100.f;
  s.view = {{0, -0.05, -10.78}, {0, -0.05, 0}, {-0.65, 2.6995, -0.51}, {1.3, 0, 0}, {0, 0, 1.05}};
  finish(s);
  return s;
}

BenchScene rough_sphere(uint32_t triangles) {
  BenchScene s;
  s.name = "sphere";
  rough_ball(s, dvec3(0.0), 1, side_of(triangles / 4.0), 0);
  add_room(s);
  finish(s);
  return s;
}

BenchScene columns_hall(uint32_t triangles) {
  constexpr uint32_t kColumns = 20, kHeads = 18, kBeams = 9;
  constexpr double kLength = 48, kWidth = 24, kHeight = 12;
  BenchScene s;
  s.name = "hall";
  s.corners.reserve(size_t(triangles) * 9);
  const dvec3 half{kLength / 2, kHeight / 2, kWidth / 2};
  box(s, -half, half);
  for (uint32_t i = 0; i < kBeams; ++i) {
    const double x = kLength * ((i + 0.5) / kBeams - 0.5);
    box(s, {x - 0.2, half.y - 0.8, -half.z}, {x + 0.2, half.y - 0.05, half.z});
  }
  // A tenth of the triangles in the floor, a third in the columns, the rest in the heads.
  const auto floor_side = side_of(triangles * 0.1 / 4);
  grid(s, 0, 2 * floor_side, floor_side, [&](uint32_t i, uint32_t j) {
    const double x = kLength * (0.5 * i / floor_side - 0.5),
                 z = kWidth * (double(j) / floor_side - 0.5);
    return dvec3{
        x, 0.05 - half.y + 0.02 * std::sin(5 * x) * std::cos(7 * z) + 0.005 * std::sin(61 * x * z),
        z};
  });
  const auto around = side_of(triangles * 0.33 / kColumns / 4);
  for (uint32_t c = 0; c < kColumns; ++c) {
    const double x = kLength * ((c / 2 + 0.5) / (kColumns / 2) - 0.5), z = c & 1 ? 5.5 : -5.5;
    grid(s, 0, 2 * around, around, [&](uint32_t i, uint32_t j) {
      const double up = 0.5 * i / around, phi = 2 * M_PI * (j % around) / around;
      const double r = (0.55 - 0.1 * up * up) * (1 + 0.06 * std::cos(20 * phi));
      return dvec3{x + r * std::cos(phi), kHeight * (up - 0.5), z + r * std::sin(phi)};
    });
  }
  const auto head = side_of(triangles * 0.57 / kHeads / 4);
  for (uint32_t h = 0; h < kHeads; ++h) {
    const dvec3 foot{kLength * ((h / 3 + 1.0) / (kHeads / 3 + 1) - 0.5), -half.y,
                     8.0 * (double(h % 3) - 1) + 0.7 * std::sin(double(h))};
    box(s, foot - dvec3{0.5, 0, 0.5}, foot + dvec3{0.5, 1.2, 0.5});
    rough_ball(s, foot + dvec3{0, 2.1, 0}, 0.8, head, h % 5);
  }
  s.view = {{-22.5, -2.5, 1.5}, {10, -3.5, 0}, {-12, half.y - 1, -2}, {24, 0, 0}, {0, 0, 4}};
  finish(s);
  return s;
}

BenchScene mesh_in_room(const std::string& file) {
  BenchScene s = read_mesh(file);
  add_room(s);
  finish(s);
  return s;
}

BenchScene mesh_as_it_is(const std::string& file) {
  BenchScene s = read_mesh(file);
  dvec3 low, high;
  bounds(s, low, high);
  const dvec3 middle = (low + high) * 0.5, size = high - low;
  const dvec3 along = size.x >= size.z ? dvec3{1, 0, 0} : dvec3{0, 0, 1};
  // In the middle, where nothing but what stands there is in its way: under a roof or a vault, all
  // shadow rays would end at it.
  s.view = {middle - along * (0.3 * glm::dot(along, size)),
            middle,
            middle + dvec3{-0.05 * size.x, 0.2 * size.y, -0.05 * size.z},
            {0.1 * size.x, 0, 0},
            {0, 0, 0.1 * size.z}};
  finish(s);
  return s;
}

BenchScene generated_scene(const std::string& name) {
  const size_t colon = name.find(':');
  const std::string kind = name.substr(0, colon);
  uint32_t triangles = kind == "hall" ? 1500000 : 70000;
  if (colon != std::string::npos) {
    const char* const end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + colon + 1, end, triangles);
    if (error != std::errc() || stop != end || triangles < 5000 || triangles > 20000000)
      throw UsageError("scene \"" + name + "\": give a count of triangles from 5000 to 20000000");
  }
  if (kind == "cornell" && colon == std::string::npos) return cornell_box();
  if (kind == "sphere") return rough_sphere(triangles);
  if (kind == "hall") return columns_hall(triangles);
  throw UsageError("scene \"" + name +
                   "\": not one of cornell, sphere[:triangles], hall[:triangles]");
}

}  // namespace yat::bench
