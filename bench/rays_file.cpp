#include "rays_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "base/whole_file.h"
#include "scene/read_file.h"

namespace yat::bench {
namespace {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Ray<Value>) == 7 * sizeof(float));
constexpr std::string_view kMagic = "YATRAYS1";
constexpr uint32_t kMaxName = 255, kMaxSets = 4096;

template <class T>
void put(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes pieces off the front of a file's bytes.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void fail(const std::string& what) const { throw Error(name_ + ": error: " + what); }
  std::string_view take(uint64_t n, std::string_view what) {
    if (n > bytes_.size())
      fail(
          fmt::format("ends within {} ({} bytes more should follow): the file is cut short, "
                      "record it again",
                      what, n - bytes_.size()));
    const std::string_view piece = bytes_.substr(0, n);
    bytes_.remove_prefix(n);
    return piece;
  }
  template <class T>
  T number(std::string_view what) {
    T value;
    std::memcpy(&value, take(sizeof value, what).data(), sizeof value);
    return value;
  }
  /// count * size bytes, where the product may not overflow.
  std::string_view take_rows(uint64_t count, uint64_t size, std::string_view what) {
    if (count > bytes_.size() / size)
      fail(
          fmt::format("says {} {}, but is too short for them: the file is cut short or not a ray "
                      "file, record it again",
                      count, what));
    return take(count * size, what);
  }
  size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
  const std::string& name_;
};

}  // namespace

std::string encode_rays(const Recording& recording) {
  std::string out(kMagic);
  const auto put_floats = [&](const float* data, size_t count) {
    if (count) out.append(reinterpret_cast<const char*>(data), count * sizeof(float));
  };
  const std::string name = recording.scene.name.substr(0, kMaxName);
  put(out, uint32_t(recording.sets.size()));
  put(out, uint32_t(name.size()));
  put(out, uint64_t(recording.scene.triangles()));
  out += name;
  put_floats(recording.scene.corners.data(), recording.scene.corners.size());
  for (const RaySet& set : recording.sets) {
    put(out, uint32_t(set.name.size()));
    put(out, uint32_t(set.shadow));
    put(out, uint64_t(set.rays.size()));
    out += set.name;
    put_floats(reinterpret_cast<const float*>(set.rays.data()), set.rays.size() * 7);
  }
  return out;
}

Recording decode_rays(std::string_view bytes, const std::string& name) {
  Reader in(bytes, name);
  if (bytes.substr(0, kMagic.size()) != kMagic)
    in.fail("is not a ray file (its first bytes are not \"YATRAYS1\"): make one with record_rays");
  in.take(kMagic.size(), "the header");
  const auto sets = in.number<uint32_t>("the header");
  const auto name_bytes = in.number<uint32_t>("the header");
  const auto triangles = in.number<uint64_t>("the header");
  if (sets > kMaxSets || name_bytes > kMaxName)
    in.fail("has a header that record_rays does not write: record it again");
  std::string scene_name(in.take(name_bytes, "the name of the scene"));
  const std::string_view corners = in.take_rows(triangles, 9 * sizeof(float), "triangles");
  std::vector<float> positions(size_t(triangles) * 9);
  if (!positions.empty()) std::memcpy(positions.data(), corners.data(), corners.size());
  Recording out{scene_of(std::move(scene_name), std::move(positions)), {}};
  for (uint32_t s = 0; s < sets; ++s) {
    const std::string what = fmt::format("set {} of {}", s + 1, sets);
    const auto set_name_bytes = in.number<uint32_t>(what);
    const auto kind = in.number<uint32_t>(what);
    const auto rays = in.number<uint64_t>(what);
    if (set_name_bytes == 0 || set_name_bytes > kMaxName || kind > 1)
      in.fail(what + " begins with what record_rays does not write: record it again");
    RaySet set{std::string(in.take(set_name_bytes, what)), kind == 1, {}};
    const std::string_view rows = in.take_rows(rays, sizeof(Ray<Value>), "rays");
    if (rays > 0xffffffffu / 2) in.fail(what + " has more rays than a table can hold");
    set.rays.resize(size_t(rays));
    if (rays) std::memcpy(set.rays.data(), rows.data(), rows.size());
    out.sets.push_back(std::move(set));
  }
  if (in.left())
    in.fail(
        fmt::format("{} bytes follow the last set: not a ray file, record it again", in.left()));
  return out;
}

Recording read_rays(const std::string& file) {
  FileText text;
  if (const std::string why = text.read(file); !why.empty())
    throw Error(fmt::format("{}: error: cannot be read ({}); check the name", file, why));
  return decode_rays(text.view(), file);
}

void write_rays(const std::string& file, const Recording& recording) {
  write_whole_file(file, encode_rays(recording));
}

}  // namespace yat::bench
