#include "traversal_scenes.h"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

namespace yat::bench {
namespace {

using Vec = std::array<double, 3>;
Vec operator+(Vec a, const Vec& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec operator-(Vec a, const Vec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec operator*(Vec a, double s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec unit(const Vec& a) {
  return a * (1 / std::sqrt(dot(a, a)));
}

void add(BenchScene& scene, const Vec& a, const Vec& b, const Vec& c) {
  for (const Vec& p : {a, b, c})
    for (const double x : p) scene.corners.push_back(float(x));
}
void quad(BenchScene& scene, const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  add(scene, a, b, c);
  add(scene, a, c, d);
}

void finish(BenchScene& scene) {
  scene.rows.resize(scene.triangles());
  for (uint32_t i = 0; i < scene.triangles(); ++i) {
    TriangleRow<Value> row{};
    std::memcpy(&row.p0_x, scene.corners.data() + size_t(i) * 9, 36);
    scene.rows.set(i, row);
  }
}

void set(float (&to)[3], const Vec& v) {
  for (size_t a = 0; a < 3; ++a) to[a] = float(v[a]);
}

/// A closed room around the triangles so far, its camera, and a lamp under the ceiling.
void add_room(BenchScene& scene) {
  Vec low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  for (size_t i = 0; i < scene.corners.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], double(scene.corners[i]));
    high[i % 3] = std::max(high[i % 3], double(scene.corners[i]));
  }
  const Vec size = high - low;
  const double s = std::max({size[0], size[1], size[2]});
  const Vec a = low - Vec{s, 0.001 * s, s}, b = high + Vec{s, s, s};
  const auto p = [&](int i) {
    return Vec{i & 1 ? b[0] : a[0], i & 2 ? b[1] : a[1], i & 4 ? b[2] : a[2]};
  };
  constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) quad(scene, p(f[0]), p(f[1]), p(f[2]), p(f[3]));
  const Vec middle = (low + high) * 0.5;
  set(scene.eye, middle + Vec{0.5 * s, 0.4 * s, 1.25 * s});
  set(scene.target, middle);
  set(scene.light[0], {middle[0] - 0.3 * s, b[1] - 0.01 * s, middle[2] - 0.3 * s});
  set(scene.light[1], {0.6 * s, 0, 0});
  set(scene.light[2], {0, 0, 0.6 * s});
}

}  // namespace

BenchScene cornell_box() {
  BenchScene s;
  s.name = "cornell";
  quad(s, {552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2});
  quad(s, {556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0});
  quad(s, {549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2});
  quad(s, {0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2});
  quad(s, {552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0});
  const auto block = [&](double h, Vec a, Vec b, Vec c, Vec d) {
    const Vec up{0, h, 0};
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
  for (size_t i = 0; i < s.corners.size(); ++i) s.corners[i] = (s.corners[i] - 278.f) / 100.f;
  set(s.eye, {0, -0.05, -10.78});
  set(s.target, {0, -0.05, 0});
  set(s.light[0], {-0.65, 2.6995, -0.51});
  set(s.light[1], {1.3, 0, 0});
  set(s.light[2], {0, 0, 1.05});
  finish(s);
  return s;
}

BenchScene rough_sphere(uint32_t triangles) {
  BenchScene s;
  s.name = "sphere";
  const auto n = uint32_t(std::sqrt(triangles / 4.0));
  const auto point = [&](uint32_t i, uint32_t j) {
    const double theta = M_PI * i / n, phi = M_PI * (j % (2 * n)) / n;
    const double r = 1 + 0.08 * std::sin(9 * theta) * std::sin(7 * phi) +
                     0.03 * std::sin(31 * theta) * std::cos(23 * phi);
    return Vec{r * std::sin(theta) * std::cos(phi), r * std::cos(theta),
               r * std::sin(theta) * std::sin(phi)};
  };
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < 2 * n; ++j)
      quad(s, point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
  add_room(s);
  finish(s);
  return s;
}

BenchScene mesh_in_room(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot open " + file);
  uint32_t vertices = 0, faces = 0, vertex_bytes = 0;
  bool in_vertex = false, little = false;
  for (std::string line; std::getline(in, line) && line.rfind("end_header", 0) != 0;) {
    std::istringstream words(line);
    std::string word, kind;
    words >> word >> kind;
    if (word == "format") little = kind == "binary_little_endian";
    if (word == "element") {
      in_vertex = kind == "vertex";
      words >> (in_vertex ? vertices : faces);
    }
    if (word == "property" && in_vertex)
      vertex_bytes += kind == "double" ? 8 : kind == "uchar" ? 1 : kind == "short" ? 2 : 4;
  }
  if (!little || vertex_bytes < 12)
    throw std::runtime_error(file + ": only binary_little_endian PLY with float x, y, z");
  std::vector<char> data(size_t(vertices) * vertex_bytes);
  in.read(data.data(), std::streamsize(data.size()));
  const auto vertex = [&](uint32_t i) {
    float p[3];
    if (i >= vertices) throw std::runtime_error(file + ": vertex index out of range");
    std::memcpy(p, data.data() + size_t(i) * vertex_bytes, 12);
    return Vec{double(p[0]), double(p[1]), double(p[2])};
  };
  BenchScene s;
  s.name = file.substr(file.find_last_of('/') + 1);
  for (uint32_t f = 0; f < faces; ++f) {
    uint32_t index[255];
    const int count = in.get();
    if (count < 3 || !in.read(reinterpret_cast<char*>(index), 4 * count))
      throw std::runtime_error(file + ": bad face");
    for (int k = 2; k < count; ++k)
      add(s, vertex(index[0]), vertex(index[k - 1]), vertex(index[k]));
  }
  add_room(s);
  finish(s);
  return s;
}

std::vector<RaySet> record_rays(const BenchScene& scene, const KernelTable& kernels,
                                const TreeView& tree, uint32_t width, uint32_t height) {
  std::mt19937 rng(1);
  const auto uniform = [&] { return double(rng() >> 8) * 0x1p-24; };
  const auto ray = [](const Vec& o, const Vec& d) {
    return Ray<Value>{float(o[0]), float(o[1]), float(o[2]), float(d[0]),
                      float(d[1]), float(d[2]), kRayFar};
  };
  const auto vec = [](const float(&v)[3]) { return Vec{double(v[0]), double(v[1]), double(v[2])}; };
  const Vec eye = vec(scene.eye), forward = unit(vec(scene.target) - eye);
  const Vec right = unit(cross(forward, {0, 1, 0})), up = cross(right, forward);
  std::vector<RaySet> sets = {{"camera", false, {}}};
  for (uint32_t ty = 0; ty < height; ty += 8)
    for (uint32_t tx = 0; tx < width; tx += 8)
      for (uint32_t i = 0; i < 64; ++i) {
        const double x = (tx + i % 8 + uniform() - width * 0.5) / height;
        const double y = (ty + i / 8 + uniform() - height * 0.5) / height;
        sets[0].rays.push_back(ray(eye, unit(forward + right * (x * 0.7) - up * (y * 0.7))));
      }
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
    RaySet shadow{"shadow " + std::to_string(bounce), true, {}};
    RaySet diffuse{"diffuse " + std::to_string(bounce), false, {}};
    for (uint32_t i = 0; i < n; ++i) {
      const Hit<Value> hit = hits.row(i);
      if (hit.prim == kNone) continue;
      const float* const c = scene.corners.data() + size_t(hit.prim) * 9;
      const Vec p0{double(c[0]), double(c[1]), double(c[2])},
          p1{double(c[3]), double(c[4]), double(c[5])},
          p2{double(c[6]), double(c[7]), double(c[8])};
      const Vec d{double(wave[i].dir_x), double(wave[i].dir_y), double(wave[i].dir_z)};
      Vec normal = unit(cross(p1 - p0, p2 - p0));
      if (dot(normal, d) > 0) normal = normal * -1;
      Vec p = p0 + (p1 - p0) * double(hit.u) + (p2 - p0) * double(hit.v);
      const double size = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
      p = p + normal * (size * 32 * 0x1p-23 * 2);
      const Vec end =
          vec(scene.light[0]) + vec(scene.light[1]) * uniform() + vec(scene.light[2]) * uniform();
      if (dot(end - p, normal) > 0) shadow.rays.push_back(ray(p, (end - p) * (1 - 1e-5)));
      const double phi = 2 * M_PI * uniform(), r = std::sqrt(uniform());
      const Vec tangent =
          unit(cross(std::abs(normal[0]) > 0.5 ? Vec{0, 1, 0} : Vec{1, 0, 0}, normal));
      const Vec side = cross(normal, tangent);
      diffuse.rays.push_back(
          ray(p, unit(tangent * (r * std::cos(phi)) + side * (r * std::sin(phi)) +
                      normal * std::sqrt(1 - r * r))));
    }
    wave = diffuse.rays;
    if (!shadow.rays.empty()) sets.push_back(std::move(shadow));
    if (bounce < 3) sets.push_back(std::move(diffuse));
  }
  return sets;
}

}  // namespace yat::bench
