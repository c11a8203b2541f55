#include "scene/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "scene/numbers.h"
#include "scene/ply_header.h"
#include "scene/read_file.h"

namespace yat {
namespace {

float to_float(double x) {
  // Outside float's range the conversion is undefined.
  if (std::abs(x) <= double(std::numeric_limits<float>::max())) return float(x);
  return std::isnan(x) ? std::numeric_limits<float>::quiet_NaN()
                       : std::copysign(std::numeric_limits<float>::infinity(), float(x > 0) - 0.5f);
}

template <class T>
T load(const char* at, bool swap) {
  unsigned char bytes[sizeof(T)];
  std::memcpy(bytes, at, sizeof(T));
  if (swap) std::reverse(bytes, bytes + sizeof(T));
  return std::bit_cast<T>(bytes);
}

double load_as(PlyType type, const char* at, bool swap) {
  switch (type) {
    case PlyType::kInt8:
      return load<int8_t>(at, swap);
    case PlyType::kUint8:
      return load<uint8_t>(at, swap);
    case PlyType::kInt16:
      return load<int16_t>(at, swap);
    case PlyType::kUint16:
      return load<uint16_t>(at, swap);
    case PlyType::kInt32:
      return load<int32_t>(at, swap);
    case PlyType::kUint32:
      return load<uint32_t>(at, swap);
    case PlyType::kFloat:
      return double(load<float>(at, swap));
    case PlyType::kDouble:
      return load<double>(at, swap);
  }
  return 0;
}

/// Reads the elements behind the header, one after the other.
class BodyReader {
 public:
  BodyReader(std::string_view data, const PlyHeader& header, std::string_view name)
      : at_(data.data() + header.bytes),
        end_(data.data() + data.size()),
        ascii_(header.format == PlyFormat::kAscii),
        swap_(!ascii_ && (header.format == PlyFormat::kBigEndian) !=
                             (std::endian::native == std::endian::big)),
        name_(name) {}

  void read_vertices(const PlyElement& element, PlyMesh& mesh);
  void read_faces(const PlyElement& element, uint64_t vertices, PlyMesh& mesh);
  void skip(const PlyElement& element);
  /// Chooses the diagonal of each quad, now that positions are known (faces may come first).
  void split_quads(PlyMesh& mesh) const;

 private:
  [[noreturn]] void fail(std::string_view reason) const {
    throw PlyError(fmt::format("{}: {}", name_, reason));
  }
  [[noreturn]] void fail_truncated() const {
    fail(
        fmt::format("the file ends in {} {} (counted from 0), it is cut off or its header counts "
                    "too many",
                    element_, row_));
  }
  size_t left() const { return size_t(end_ - at_); }

  /// Takes no count on trust: each row needs at least this many bytes of the file.
  void check_count(const PlyElement& element) {
    element_ = element.name;
    row_ = 0;
    size_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += ascii_ ? 1 : ply_bytes(property.list ? property.count_type : property.type);
    if (least != 0 && element.count > left() / least)
      fail(
          fmt::format("the header counts {} rows of {}, but the file is too short for them, it is "
                      "cut off or damaged",
                      element.count, quote(element.name)));
  }

  double value(PlyType type) { return ascii_ ? ascii_value() : binary_value(type); }
  double ascii_value();
  double binary_value(PlyType type) {
    const uint32_t bytes = ply_bytes(type);
    if (left() < bytes) fail_truncated();
    const double result = load_as(type, at_, swap_);
    at_ += bytes;
    return result;
  }
  uint64_t list_length(const PlyProperty& property) {
    const double length = value(property.count_type);
    const size_t least = ascii_ ? 1 : ply_bytes(property.type);
    if (!(length >= 0) || length != std::floor(length))
      fail(fmt::format("{} {} (counted from 0): a list of {} values", element_, row_, length));
    if (length > double(left() / least)) fail_truncated();
    return uint64_t(length);
  }
  void skip(const PlyProperty& property) {
    if (!property.list) {
      value(property.type);
      return;
    }
    const uint64_t length = list_length(property);
    if (ascii_)
      for (uint64_t i = 0; i < length; ++i) ascii_value();
    else
      at_ += length * ply_bytes(property.type);
  }
  [[noreturn]] void fail_index(double index, uint64_t vertices) const {
    fail(
        fmt::format("face {} (counted from 0): vertex index {} is out of range, the file has {} "
                    "vertices",
                    row_, index, vertices));
  }
  void add_face(const std::vector<uint32_t>& corners, PlyMesh& mesh);
  void read_triangles_fast(uint64_t count, uint64_t vertices, PlyMesh& mesh);

  const char* at_;
  const char* end_;
  bool ascii_, swap_;
  std::string_view name_;
  std::string_view element_;
  uint64_t row_ = 0;                 ///< of element_, for messages
  std::vector<size_t> quad_starts_;  ///< into PlyMesh::triangles: six indices a b c a c d
};

double BodyReader::ascii_value() {
  const auto is_space = [](char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
  };
  while (at_ != end_ && is_space(*at_)) ++at_;
  if (at_ == end_) fail_truncated();
  const char* stop = at_;
  while (stop != end_ && !is_space(*stop)) ++stop;
  const std::string_view word(at_, size_t(stop - at_));
  const NumberRead<double> number = read_number<double>(at_, stop);
  at_ = stop;
  if (number.status == NumberStatus::kOk && number.end == stop) return number.value;
  // Writers print what their C library prints; such vertices are dropped with their triangles.
  if (word == "nan" || word == "-nan" || word == "NaN")
    return std::numeric_limits<double>::quiet_NaN();
  if (word == "inf" || word == "-inf")
    return word[0] == '-' ? -std::numeric_limits<double>::infinity()
                          : std::numeric_limits<double>::infinity();
  fail(fmt::format("{} {} (counted from 0): {} is {}", element_, row_, quote(word),
                   number.status == NumberStatus::kOverflow ? "too large" : "not a number"));
}

void BodyReader::read_vertices(const PlyElement& element, PlyMesh& mesh) {
  check_count(element);
  struct Target {
    int property[3];
    int n;
    std::vector<float>* out;
  };
  std::vector<Target> targets;
  const auto want = [&](std::initializer_list<const char*> names, std::vector<float>& out) {
    Target target{{0, 0, 0}, 0, &out};
    for (const char* wanted : names) {
      const int found = element.find(wanted);
      if (found < 0 || element.properties[size_t(found)].list) return false;
      target.property[target.n++] = found;
    }
    targets.push_back(target);
    return true;
  };
  if (!want({"x", "y", "z"}, mesh.positions)) fail("its vertices have no x, y and z");
  want({"nx", "ny", "nz"}, mesh.normals);
  want({"s", "t"}, mesh.uvs) || want({"u", "v"}, mesh.uvs) ||
      want({"texture_u", "texture_v"}, mesh.uvs) || want({"u0", "v0"}, mesh.uvs);
  mesh.colours = element.find("red") >= 0;
  const size_t n = size_t(element.count);

  std::vector<size_t> offsets;
  size_t stride = 0;
  bool fixed = !ascii_;
  for (const PlyProperty& property : element.properties) {
    fixed = fixed && !property.list;
    offsets.push_back(stride);
    stride += ply_bytes(property.type);
  }

  if (fixed) {
    // check_count() has seen that n * stride bytes are there.
    for (const Target& target : targets) {
      target.out->resize(n * size_t(target.n));
      float* out = target.out->data();
      const size_t first = offsets[size_t(target.property[0])];
      bool packed = !swap_;
      for (int i = 0; i < target.n; ++i) {
        const auto p = size_t(target.property[i]);
        packed = packed && element.properties[p].type == PlyType::kFloat &&
                 offsets[p] == first + 4 * size_t(i);
      }
      const char* row = at_ + first;
      if (packed && target.n == 3) {
        for (size_t v = 0; v < n; ++v) std::memcpy(out + 3 * v, row + v * stride, 12);
      } else if (packed) {
        for (size_t v = 0; v < n; ++v) std::memcpy(out + 2 * v, row + v * stride, 8);
      } else {
        for (int i = 0; i < target.n; ++i) {
          const auto p = size_t(target.property[i]);
          const char* from = at_ + offsets[p];
          for (size_t v = 0; v < n; ++v)
            out[v * size_t(target.n) + size_t(i)] =
                to_float(load_as(element.properties[p].type, from + v * stride, swap_));
        }
      }
    }
    at_ += n * stride;
    return;
  }

  std::vector<float> row(element.properties.size());
  for (const Target& target : targets) target.out->reserve(n * size_t(target.n));
  for (row_ = 0; row_ < n; ++row_) {
    for (size_t p = 0; p < row.size(); ++p) {
      if (element.properties[p].list)
        skip(element.properties[p]);
      else
        row[p] = to_float(value(element.properties[p].type));
    }
    for (const Target& target : targets)
      for (int i = 0; i < target.n; ++i) target.out->push_back(row[size_t(target.property[i])]);
  }
}

void BodyReader::add_face(const std::vector<uint32_t>& corners, PlyMesh& mesh) {
  const size_t n = corners.size();
  if (n < 3) {
    ++mesh.skipped;
    return;
  }
  if (n == 4) {
    ++mesh.quads;
    quad_starts_.push_back(mesh.triangles.size());
  } else if (n > 4) {
    ++mesh.polygons;
  }
  for (size_t i = 2; i < n; ++i)
    mesh.triangles.insert(mesh.triangles.end(), {corners[0], corners[i - 1], corners[i]});
}

/// Rows that are nothing but a list of three 4-byte indices with a 1-byte length, in this machine's
/// byte order: what nearly all files hold. Stops before the first row of another length.
void BodyReader::read_triangles_fast(uint64_t count, uint64_t vertices, PlyMesh& mesh) {
  while (row_ < count && left() >= 13 && static_cast<unsigned char>(*at_) == 3) {
    uint32_t corner[3];
    std::memcpy(corner, at_ + 1, 12);
    // A negative index of a signed type is a large number here.
    if (std::max({corner[0], corner[1], corner[2]}) >= vertices) return;
    mesh.triangles.insert(mesh.triangles.end(), corner, corner + 3);
    at_ += 13;
    ++row_;
  }
}

void BodyReader::read_faces(const PlyElement& element, uint64_t vertices, PlyMesh& mesh) {
  check_count(element);
  int at = element.find("vertex_indices");
  if (at < 0) at = element.find("vertex_index");
  if (at < 0 || !element.properties[size_t(at)].list) fail("its faces have no list vertex_indices");
  const PlyProperty& indices = element.properties[size_t(at)];
  mesh.faces = element.count;

  const bool fast = !ascii_ && !swap_ && element.properties.size() == 1 &&
                    ply_bytes(indices.count_type) == 1 &&
                    (indices.type == PlyType::kInt32 || indices.type == PlyType::kUint32);
  // What the bytes that are left can hold, should every face be a triangle.
  const uint64_t likely =
      std::min<uint64_t>(element.count, left() / (1 + 3 * (ascii_ ? 2 : ply_bytes(indices.type))));
  mesh.triangles.reserve(size_t(likely) * 3);

  std::vector<uint32_t> corners;
  for (row_ = 0; row_ < element.count;) {
    if (fast) {
      read_triangles_fast(element.count, vertices, mesh);
      if (row_ == element.count) break;
    }
    for (size_t p = 0; p < element.properties.size(); ++p) {
      if (int(p) != at) {
        skip(element.properties[p]);
        continue;
      }
      const uint64_t n = list_length(indices);
      corners.clear();
      for (uint64_t i = 0; i < n; ++i) {
        const double index = value(indices.type);
        if (!(index >= 0 && index < double(vertices)) || index != std::floor(index))
          fail_index(index, vertices);
        corners.push_back(uint32_t(index));
      }
    }
    add_face(corners, mesh);
    ++row_;
  }
}

void BodyReader::skip(const PlyElement& element) {
  check_count(element);
  if (element.properties.empty()) return;  // its rows take no bytes, however many are claimed
  size_t stride = 0;
  bool fixed = !ascii_;
  for (const PlyProperty& property : element.properties) {
    fixed = fixed && !property.list;
    stride += ply_bytes(property.type);
  }
  if (fixed) {
    at_ += size_t(element.count) * stride;
    return;
  }
  for (row_ = 0; row_ < element.count; ++row_)
    for (const PlyProperty& property : element.properties) skip(property);
}

void BodyReader::split_quads(PlyMesh& mesh) const {
  const auto length2 = [&](uint32_t a, uint32_t b) {
    double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
      const double d =
          double(mesh.positions[3 * size_t(a) + i]) - double(mesh.positions[3 * size_t(b) + i]);
      sum += d * d;
    }
    return sum;
  };
  for (const size_t start : quad_starts_) {
    uint32_t* t = mesh.triangles.data() + start;  // a b c a c d
    const uint32_t a = t[0], b = t[1], c = t[2], d = t[5];
    if (length2(b, d) < length2(a, c)) {
      t[2] = d;  // a b d
      t[3] = b;  // b c d
      t[4] = c;
    }
  }
}

}  // namespace

PlyMesh parse_ply(std::string_view data, std::string_view name) {
  const PlyHeader header = parse_ply_header(data, name);
  const auto the_element = [&](std::string_view wanted) {
    const PlyElement* found = nullptr;
    for (const PlyElement& element : header.elements) {
      if (element.name != wanted) continue;
      if (found) throw PlyError(fmt::format("{}: two elements {}", name, quote(wanted)));
      found = &element;
    }
    if (!found || found->count == 0)
      throw PlyError(fmt::format("{}: has no {}", name, wanted == "face" ? "faces" : "vertices"));
    return found;
  };
  const PlyElement* vertex = the_element("vertex");
  const PlyElement* face = the_element("face");
  if (vertex->count >= 0xffffffffu)
    throw PlyError(
        fmt::format("{}: {} vertices, more than 32-bit indices reach", name, vertex->count));

  PlyMesh mesh;
  BodyReader body(data, header, name);
  // What comes behind the last of the two need not be read, and may be damaged.
  const PlyElement* last = std::max(vertex, face);
  for (const PlyElement* element = header.elements.data(); element <= last; ++element) {
    if (element == vertex)
      body.read_vertices(*element, mesh);
    else if (element == face)
      body.read_faces(*element, vertex->count, mesh);
    else
      body.skip(*element);
  }
  body.split_quads(mesh);
  if (mesh.polygons)
    mesh.warnings.push_back(fmt::format(
        "{}: {} of {} faces have more than 4 corners, split into fans (right for convex ones)",
        name, mesh.polygons, mesh.faces));
  if (mesh.skipped)
    mesh.warnings.push_back(fmt::format("{}: {} of {} faces have fewer than 3 corners, left out",
                                        name, mesh.skipped, mesh.faces));
  if (mesh.triangles.empty()) throw PlyError(fmt::format("{}: has no triangles", name));
  return mesh;
}

PlyMesh read_ply(const std::string& path) {
  FileText file;
  if (const std::string reason = file.read(path); !reason.empty())
    throw PlyError(fmt::format("{}: cannot be read: {}", path, reason));
  return parse_ply(file.view(), path);
}

}  // namespace yat
