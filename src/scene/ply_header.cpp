#include "scene/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "scene/ply.h"

namespace yat {
namespace {

std::optional<PlyType> scalar_type(std::string_view word) {
  // Both spellings are in use: the 1994 one and the one that states the width.
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
      {"char", PlyType::kInt8},
      {"int8", PlyType::kInt8},
      {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16},
      {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},
      {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},
      {"uint", PlyType::kUint32},
      {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat},
      {"float32", PlyType::kFloat},
      {"double", PlyType::kDouble},
      {"float64", PlyType::kDouble},
  }};
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  return std::nullopt;
}

/// Cuts lines and words; remembers the line number for messages.
class HeaderReader {
 public:
  HeaderReader(std::string_view data, std::string_view name) : data_(data), name_(name) {}

  [[noreturn]] void fail(std::string_view reason) const {
    throw PlyError(fmt::format("{}: header line {}: {}", name_, line_number_, reason));
  }

  /// The next line, without its end. The first line settles what ends a line: in a file with LF a
  /// CR after end_header would be data.
  std::string_view line() {
    ++line_number_;
    const size_t end = data_.find_first_of(cr_only_ ? "\r" : "\n", position_);
    if (end == std::string_view::npos || end - position_ > kLongestLine)
      fail("end_header is missing, the file is cut off or is no PLY file");
    std::string_view text = data_.substr(position_, end - position_);
    position_ = end + 1;
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
  }

  void settle_line_end() {
    const size_t end = data_.find_first_of("\r\n");
    cr_only_ = end != std::string_view::npos && data_[end] == '\r' &&
               (end + 1 >= data_.size() || data_[end + 1] != '\n');
  }

  size_t position() const { return position_; }

 private:
  static constexpr size_t kLongestLine = 1 << 16;
  std::string_view data_, name_;
  size_t position_ = 0;
  uint32_t line_number_ = 0;
  bool cr_only_ = false;
};

std::string_view next_word(std::string_view& text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  const size_t end = std::min(text.find_first_of(" \t", begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

PlyType need_type(const HeaderReader& reader, std::string_view word) {
  const std::optional<PlyType> type = scalar_type(word);
  if (!type)
    reader.fail(
        fmt::format("unknown property type {}, use char, uchar, short, ushort, int, uint, "
                    "float or double",
                    quote(word)));
  return *type;
}

PlyProperty read_property(const HeaderReader& reader, std::string_view rest) {
  PlyProperty property;
  std::string_view word = next_word(rest);
  if (word == "list") {
    property.list = true;
    property.count_type = need_type(reader, next_word(rest));
    if (!ply_is_integer(property.count_type))
      reader.fail("the length of a list must have an integer type");
    word = next_word(rest);
  }
  property.type = need_type(reader, word);
  property.name = next_word(rest);
  if (property.name.empty()) reader.fail("a property has no name");
  return property;
}

PlyElement read_element(const HeaderReader& reader, std::string_view rest) {
  PlyElement element;
  element.name = next_word(rest);
  const std::string_view count = next_word(rest);
  const auto [end, status] =
      std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (status != std::errc() || end != count.data() + count.size())
    reader.fail(
        fmt::format("element {} needs a count, found {}", quote(element.name), quote(count)));
  return element;
}

}  // namespace

int PlyElement::find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return int(i);
  return -1;
}

PlyHeader parse_ply_header(std::string_view data, std::string_view name) {
  if (data.substr(0, 3) != "ply" || data.size() < 4 || (data[3] != '\n' && data[3] != '\r'))
    throw PlyError(fmt::format("{}: not a PLY file (its first line is not \"ply\")", name));
  HeaderReader reader(data, name);
  reader.settle_line_end();
  reader.line();
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    std::string_view rest = reader.line();
    const std::string_view word = next_word(rest);
    if (word == "end_header") break;
    if (word == "format") {
      const std::string_view format = next_word(rest);
      if (format == "ascii")
        header.format = PlyFormat::kAscii;
      else if (format == "binary_little_endian")
        header.format = PlyFormat::kLittleEndian;
      else if (format == "binary_big_endian")
        header.format = PlyFormat::kBigEndian;
      else
        reader.fail(fmt::format("unknown format {}", quote(format)));
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(reader, rest));
    } else if (word == "property") {
      if (header.elements.empty()) reader.fail("a property comes before the first element");
      header.elements.back().properties.push_back(read_property(reader, rest));
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      reader.fail(fmt::format("unknown keyword {}", quote(word)));
    }
  }
  if (!has_format) reader.fail("the format line is missing");
  header.bytes = reader.position();
  return header;
}

}  // namespace yat
