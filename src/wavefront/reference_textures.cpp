#include "wavefront/reference_textures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "scene/colour_model.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

void run(const ConstantParameters<Value>& p, StepPlace& place) {
  place.out(0, double(p.r));
  place.out(1, double(p.g));
  place.out(2, double(p.b));
}

/// Length of the gradient of the first coordinate on the surface.
double gradient(const Vec& own, const Vec& other) {
  if (glm::length(glm::cross(own, other)) == 0) return 0;
  // Along the part of dp/du that leaves the other coordinate as it is.
  const Vec across = own - glm::dot(own, other) / glm::dot(other, other) * other;
  return 1 / glm::length(across);
}

void run(const MapSurfaceParameters<Value>& p, StepPlace& place) {
  const TexturePlace& at = place.at;
  place.out(0, at.u * double(p.s_scale) + double(p.s_delta));
  place.out(1, at.v * double(p.t_scale) + double(p.t_delta));
  place.out(2, at.width * gradient(at.du, at.dv) * std::fabs(double(p.s_scale)));
  place.out(3, at.width * gradient(at.dv, at.du) * std::fabs(double(p.t_scale)));
}

void run(const MapRoundParameters<Value>& p, StepPlace& place) {
  const Vec rows[3] = {
      {p.m_xx, p.m_xy, p.m_xz}, {p.m_yx, p.m_yy, p.m_yz}, {p.m_zx, p.m_zy, p.m_zz}};
  const Vec at = Vec(glm::dot(rows[0], place.at.position), glm::dot(rows[1], place.at.position),
                     glm::dot(rows[2], place.at.position)) +
                 Vec(p.x, p.y, p.z);
  double phi = std::atan2(at.y, at.x);
  if (phi < 0) phi += 2 * kPi;
  const bool cylinder = place.form(2) == 1;
  const double radius = glm::length(at), ring = std::hypot(at.x, at.y);
  const double theta = radius > 0 ? std::acos(std::clamp(at.z / radius, -1., 1.)) : 0;
  place.out(0, phi / (2 * kPi) * double(p.s_scale) + double(p.s_delta));
  place.out(1, cylinder ? .5 - at.z / 2 : theta / kPi * double(p.t_scale) + double(p.t_delta));
  double squares = 0;
  for (const Vec& row : rows) squares += glm::dot(row, row);
  const double width = place.at.width * std::sqrt(squares / 3);
  place.out(2, ring > 0 ? width / (2 * kPi * ring) * std::fabs(double(p.s_scale)) : 0);
  place.out(3, cylinder     ? width / 2
               : radius > 0 ? width / (kPi * radius) * std::fabs(double(p.t_scale))
                            : 0);
}

void run(const MapPlanarParameters<Value>& p, StepPlace& place) {
  const Vec s(p.s_x, p.s_y, p.s_z), t(p.t_x, p.t_y, p.t_z);
  place.out(0, glm::dot(s, place.at.position) + double(p.s_delta));
  place.out(1, glm::dot(t, place.at.position) + double(p.t_delta));
  place.out(2, place.at.width * glm::length(s));
  place.out(3, place.at.width * glm::length(t));
}

void run(const MapSolidParameters<Value>& p, StepPlace& place) {
  const uint32_t form = place.form(3);
  const Vec at = form == 0   ? place.at.position
                 : form == 1 ? Vec(place.at.u, place.at.v, 0)
                             : place.at.normal;
  place.out(0, glm::dot(Vec(p.m_xx, p.m_xy, p.m_xz), at) + double(p.x));
  place.out(1, glm::dot(Vec(p.m_yx, p.m_yy, p.m_yz), at) + double(p.y));
  place.out(2, glm::dot(Vec(p.m_zx, p.m_zy, p.m_zz), at) + double(p.z));
}

void run(const ArithmeticParameters<Value>& p, StepPlace& place) {
  for (uint32_t k = 0; k < 3; ++k) {
    const double a = place.in(0, k), b = place.in(1, k), c = place.in(2);
    const double results[] = {a * b, a + b, a - b, (1 - c) * a + c * b, a + double(p.weight) * b};
    place.out(k, results[place.form(5)]);
  }
}

void run(const RampParameters<Value>& p, StepPlace& place) {
  const double x = place.in(0), start = double(p.start), end = double(p.end);
  place.out(0, x >= end ? 1 : x <= start ? 0 : (x - start) / (end - start));
}

void run(const ClampParameters<Value>& p, StepPlace& place) {
  for (uint32_t k = 0; k < 3; ++k)
    place.out(k, double(p.unit) * std::clamp(place.in(0, k), double(p.least), double(p.most)));
}

void run(const WeighParameters<Value>& p, StepPlace& place) {
  place.out(0, glm::dot(Vec(p.r, p.g, p.b), place.colour(0)));
}

void run(const BandsParameters<Value>& p, StepPlace& place) {
  const Vec bands = to_bands(place.colour(0), place.basis);
  if (place.form(kBandsTraits.forms) == kBandsRaised)
    place.out(glm::pow(glm::max(bands, Vec(0.)), Vec(double(p.gamma))));
  else
    place.out(bands);
}

// ---- Patterns and noise: reference_patterns.cpp ------------------------------------------------

#define YAT_PATTERN(Type)                                        \
  void run(const Type##Parameters<Value>& p, StepPlace& place) { \
    run_pattern(p, place);                                       \
  }
YAT_PATTERN(Checkerboard)
YAT_PATTERN(Bilerp)
YAT_PATTERN(Brick)
YAT_PATTERN(Dots)
YAT_PATTERN(UvColour)
YAT_PATTERN(UvMask)
YAT_PATTERN(Harlequin)
YAT_PATTERN(Noise)
YAT_PATTERN(Marble)
YAT_PATTERN(Blender)
#undef YAT_PATTERN

// ---- Images ------------------------------------------------------------------------------------

/// One level of an image, a texel at a time.
struct ImageLevel {
  const uint32_t* words;
  TexelFormat format;
  int64_t width, height;
  ImageWrap wrap;

  glm::dvec4 texel(int64_t x, int64_t y) const {
    const bool bytes = format == TexelFormat::kByte1 || format == TexelFormat::kByte4;
    const bool single = format == TexelFormat::kByte1 || format == TexelFormat::kFloat1;
    const double one = bytes ? 255 : 1;
    if (x < 0 || y < 0 || x >= width || y >= height) {
      if (wrap == ImageWrap::kBlack) return glm::dvec4(0);
      if (wrap == ImageWrap::kWhite) return glm::dvec4(one);
    }
    const auto into = [&](int64_t i, int64_t n) {
      return wrap == ImageWrap::kRepeat ? ((i % n) + n) % n : std::clamp<int64_t>(i, 0, n - 1);
    };
    x = into(x, width);
    y = into(y, height);
    const int64_t tile = (y / 4) * ((width + 3) / 4) + x / 4,
                  number = tile * 16 + y % 4 * 4 + x % 4;
    glm::dvec4 out(0.);
    for (int k = 0; k < (single ? 1 : 4); ++k) {
      const int64_t unit = single ? number : number * 4 + k;
      out[k] = bytes ? double(words[unit / 4] >> (unit % 4 * 8) & 255u)
                     : double(std::bit_cast<float>(words[unit]));
    }
    return out;
  }
  glm::dvec4 nearest(double s, double t) const {
    return texel(int64_t(std::floor(s * double(width))), int64_t(std::floor(t * double(height))));
  }
  glm::dvec4 bilinear(double s, double t) const {
    const double x = s * double(width) - .5, y = t * double(height) - .5;
    const auto i = int64_t(std::floor(x)), j = int64_t(std::floor(y));
    const double fx = x - double(i), fy = y - double(j);
    return (1 - fy) * ((1 - fx) * texel(i, j) + fx * texel(i + 1, j)) +
           fy * ((1 - fx) * texel(i, j + 1) + fx * texel(i + 1, j + 1));
  }
};

void run(const ImageParameters<Value>& p, StepPlace& place) {
  const uint32_t form = place.form(32), filter = form >> 2 & 3;
  const auto level = [&](uint32_t n) {
    const uint32_t begin = filter == 2 ? place.texels.levels[p.image * kTexelLevels + n] : p.texels;
    return ImageLevel{place.texels.words + begin, TexelFormat(form & 3),
                      std::max<int64_t>(1, p.width >> n), std::max<int64_t>(1, p.height >> n),
                      ImageWrap(place.variant >> 8 & 3)};
  };
  const double s = place.in(0, 0), t = place.in(0, 1);
  glm::dvec4 texel;
  if (filter == 0) {
    texel = level(0).nearest(s, t);
  } else if (filter == 1) {
    texel = level(0).bilinear(s, t);
  } else {
    const double wide = std::max(place.in(1, 0) * p.width, place.in(1, 1) * p.height);
    const double number = std::clamp(std::log2(std::max(wide, 1.)), 0., double(p.last_level));
    const double below = std::floor(number), f = number - below;
    const auto last = uint32_t(p.last_level);
    texel = (1 - f) * level(uint32_t(below)).bilinear(s, t) +
            f * level(std::min(uint32_t(below) + 1, last)).bilinear(s, t);
  }
  const auto decode = [&](double x) {
    return std::pow(std::max(0., double(p.gain) * x), double(p.gamma));
  };
  const bool single =
      (form & 3) == uint32_t(TexelFormat::kByte1) || (form & 3) == uint32_t(TexelFormat::kFloat1);
  if (single)
    place.out(0, decode(texel.x));
  else if (form & kImageNumber)
    place.out(0, decode(glm::dot(texel, glm::dvec4(p.r, p.g, p.b, p.a))));
  else
    place.out(Vec(decode(texel.x), decode(texel.y), decode(texel.z)));
}

}  // namespace

void run_step(StepKind kind, const uint32_t* constants, StepPlace& place) {
  const auto read = [&](auto record) {
    for_each_field([&](auto i, auto& field) { std::memcpy(&field, constants + i, 4); }, record);
    run(record, place);
  };
  switch (kind) {
#define YAT_TEXTURE(file, Type) \
  case StepKind::k##Type:       \
    return read(Type##Parameters<Value>{});
    YAT_TEXTURES(YAT_TEXTURE)
#undef YAT_TEXTURE
    case StepKind::kCount:
      break;
  }
  throw std::logic_error("reference: no such texture kind");
}

double footprint(const Scene& scene, double distance, double pdf, double cosine) {
  const CameraView& camera = scene.camera;
  const double spread = pdf > 0 ? std::min(1., 2. / 16 * std::sqrt(1 / (kPi * pdf)))
                                : glm::length(Vec(camera.dx[0], camera.dx[1], camera.dx[2]));
  return spread * distance / std::sqrt(std::max(cosine, 1e-4));
}

namespace {

/// The columns that a program's steps leave.
std::vector<double> run_steps(const Scene& scene, const TextureProgram& program,
                              const std::vector<TextureStep>& steps, uint32_t row,
                              const TexturePlace& at, const BandBasis& basis) {
  std::vector<double> columns(program.columns);
  for (const TextureStep& step : steps) {
    StepPlace place{at,   step.variant, {}, {}, uint32_t(step.out.size()), scene.texels.view(),
                    basis};
    for (size_t k = 0; k < step.in.size(); ++k)
      for (size_t c = 0; c < 3; ++c) place.input[k][c] = columns[step.in[k][c]];
    const uint32_t constants = step.rows == 1 ? 0 : row;
    run_step(step.kind,
             step.constants.data() + size_t(constants) * parameters_size(step.kind).row_words,
             place);
    for (size_t k = 0; k < step.out.size(); ++k) columns[step.out[k]] = place.output[k];
  }
  return columns;
}

TexturePlace place_of(const Point& point, double width) {
  return {point.position, point.ns, point.u, point.v, point.du, point.dv, width, point.prim};
}

}  // namespace

void bend_normal(const Scene& scene, uint32_t number, uint32_t row, Point& point, double width) {
  if (number == kNone || scene.programs[number].bump_steps.empty()) return;
  const TextureProgram& program = scene.programs[number];
  const TexturePlace here = place_of(point, width);
  const auto heights = [&](const TexturePlace& at) {
    return run_steps(scene, program, program.bump_steps, row, at, scene.colour.reflectance);
  };
  const Vec n = point.ns;
  const bool mapped = glm::length(glm::cross(point.du, point.dv)) > 0;
  const Axes axes(n);
  const Vec du = mapped ? point.du : axes.x, dv = mapped ? point.dv : axes.y;
  const std::vector<double> first = heights(here);
  Vec bent;
  if (program.normal_map) {
    Vec local;
    for (int k = 0; k < 3; ++k) local[k] = 2 * first[program.bump_columns[size_t(k)]] - 1;
    bent = local.x * glm::normalize(du) + local.y * glm::normalize(dv) + local.z * n;
  } else {
    BumpParameters<Value> p{};
    for_each_field(
        [&](auto i, auto& field) {
          std::memcpy(&field, program.bump.data() + size_t(row) * row_words<BumpParameters> + i, 4);
        },
        p);
    const double step_u =
        mapped && p.step_u > 0 ? double(p.step_u) : double(p.distance) / glm::length(du);
    const double step_v =
        mapped && p.step_v > 0 ? double(p.step_v) : double(p.distance) / glm::length(dv);
    TexturePlace along_u = here, along_v = here;
    along_u.position += step_u * du;
    along_v.position += step_v * dv;
    if (mapped) {
      along_u.u += step_u;
      along_v.v += step_v;
    }
    const uint32_t h = program.bump_columns[0];
    const double by_u = (heights(along_u)[h] - first[h]) / step_u;
    const double by_v = (heights(along_v)[h] - first[h]) / step_v;
    bent = glm::cross(du + by_u * n, dv + by_v * n);
  }
  const double side = glm::dot(bent, n);
  if (side != 0) point.ns = glm::normalize(side < 0 ? -bent : bent);
}

std::vector<uint32_t> material_parameters(const Scene& scene, MaterialKind kind, uint32_t number,
                                          uint32_t row, const Point& point, double width) {
  const RecordSize size = parameters_size(kind);
  const bool textured = number != kNone;
  const uint32_t* from = (textured ? scene.programs[number].parameters.data()
                                   : scene.parameters[uint32_t(kind)].data()) +
                         size_t(row) * size.row_words;
  std::vector<uint32_t> words(from, from + size.fields);
  if (!textured) return words;
  const TextureProgram& program = scene.programs[number];
  const std::vector<double> columns = run_steps(scene, program, program.steps, row,
                                                place_of(point, width), scene.colour.reflectance);
  for (const TextureProgram::Field& field : program.fields)
    words[field.field] = std::bit_cast<uint32_t>(float(columns[field.column]));
  return words;
}

Vec light_texture(const Scene& scene, uint32_t number, uint32_t row, const Point& point,
                  double width) {
  const TextureProgram& program = scene.emission_programs[number];
  TexturePlace at = place_of(point, width);
  at.normal = point.ng;
  const std::vector<double> columns =
      run_steps(scene, program, program.steps, row, at, scene.colour.light);
  Vec colour;
  for (const TextureProgram::Field& field : program.fields)
    colour[int(field.field)] = columns[field.column];
  return colour;
}

}  // namespace yat::reference
