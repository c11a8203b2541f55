#include "scene/statement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <unordered_map>

#include "scene/numbers.h"

namespace yat {
namespace {

struct TypeName {
  std::string_view name;
  ParameterType type;
};
constexpr std::array<TypeName, 9> kTypes = {{{"integer", ParameterType::kInteger},
                                             {"float", ParameterType::kFloat},
                                             {"bool", ParameterType::kBool},
                                             {"point", ParameterType::kPoint},
                                             {"vector", ParameterType::kVector},
                                             {"normal", ParameterType::kNormal},
                                             {"color", ParameterType::kColor},
                                             {"string", ParameterType::kString},
                                             {"texture", ParameterType::kTexture}}};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// `"type name"` -> its two words; the name is what remains, blanks at its ends cut off.
void split(std::string_view text, std::string_view& type, std::string_view& name) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  const auto blank = std::find_if(text.begin(), text.end(), is_blank);
  type = text.substr(0, size_t(blank - text.begin()));
  name = text.substr(type.size());
  while (!name.empty() && is_blank(name.front())) name.remove_prefix(1);
}

bool is_file_name(const Parameter& parameter) {
  return parameter.type == ParameterType::kString &&
         (parameter.name.find("file") != std::string::npos || parameter.name == "mapname");
}

}  // namespace

std::string_view parameter_type_name(ParameterType type) {
  for (const TypeName& entry : kTypes)
    if (entry.type == type) return entry.name;
  return {};
}

uint32_t numbers_per_value(ParameterType type) {
  switch (type) {
    case ParameterType::kPoint:
    case ParameterType::kVector:
    case ParameterType::kNormal:
    case ParameterType::kColor:
      return 3;
    default:
      return 1;
  }
}

/// Finds the parameter that a list holds already: by looking through short lists, by a table in
/// long ones, so that a list of any length is read in linear time.
class RepeatedNames {
 public:
  Parameter* find(std::vector<Parameter>& list, const Parameter& wanted) {
    if (list.size() < kShort) {
      for (Parameter& parameter : list)
        if (parameter.type == wanted.type && parameter.name == wanted.name) return &parameter;
      return nullptr;
    }
    for (; seen_ < list.size(); ++seen_) rows_.emplace(key(list[seen_]), seen_);
    const auto found = rows_.find(key(wanted));
    return found == rows_.end() ? nullptr : &list[found->second];
  }

 private:
  static constexpr size_t kShort = 32;
  static std::string key(const Parameter& parameter) {
    return static_cast<char>('a' + int(parameter.type)) + parameter.name;
  }
  std::unordered_map<std::string, size_t> rows_;
  size_t seen_ = 0;
};

void StatementReader::fail_expected(std::string_view what) const {
  diagnostics_.fail(token_.loc, fmt::format("{} needs {}, found {}, write {}", directive_, what,
                                            describe(token_), usage_));
}

std::string StatementReader::string() {
  if (token_.kind != TokenKind::kString) fail_expected("a string in quotes");
  std::string text(token_.text);
  next();
  return text;
}

double StatementReader::number() {
  if (token_.kind != TokenKind::kNumber) fail_expected("a number");
  const double result = to_double(token_);
  next();
  return result;
}

std::vector<double> StatementReader::array(size_t count) {
  if (token_.kind != TokenKind::kOpen) fail_expected("[");
  const SourceLoc opened = token_.loc;
  std::vector<double> numbers;
  for (;;) {
    lexer_.read_numbers(numbers);
    next();
    if (token_.kind != TokenKind::kNumber) break;
    numbers.push_back(to_double(token_));
  }
  if (token_.kind != TokenKind::kClose) fail_expected("numbers and ]");
  if (count != 0 && numbers.size() != count)
    diagnostics_.fail(opened, fmt::format("{} needs {} numbers, found {}, write {}", directive_,
                                          count, numbers.size(), usage_));
  next();
  return numbers;
}

std::vector<Parameter> StatementReader::parameters() {
  std::vector<Parameter> list;
  RepeatedNames names;
  while (token_.kind == TokenKind::kString) parameter(list, names);
  return list;
}

void StatementReader::parameter(std::vector<Parameter>& list, RepeatedNames& names) {
  Parameter parameter;
  parameter.loc = token_.loc;
  const std::string declared(token_.text);
  const std::string shown = quote(declared);
  std::string_view type_word, name;
  split(declared, type_word, name);
  parameter.name = name;

  const TypeName* type =
      std::find_if(kTypes.begin(), kTypes.end(), [&](auto& t) { return t.name == type_word; });
  // LuxRender looks at the beginning of the word only.
  if (type == kTypes.end() && !name.empty()) {
    type = std::find_if(kTypes.begin(), kTypes.end(),
                        [&](auto& t) { return type_word.starts_with(t.name); });
    if (type != kTypes.end())
      diagnostics_.warning(parameter.loc,
                           fmt::format("type of {} taken as {}, write that", shown, type->name));
  }
  const bool rgb = type_word == "rgb" || type_word == "spectrum";
  const bool known = (type != kTypes.end() || rgb) && !name.empty();
  parameter.type = rgb || !known ? ParameterType::kColor : type->type;
  if (name.empty()) {
    diagnostics_.error(parameter.loc,
                       fmt::format("parameter {} has no type or no name, skipped, write \"type "
                                   "name\" as in \"float fov\"",
                                   shown));
  } else if (!known) {
    std::vector<std::string_view> candidates;
    for (const TypeName& t : kTypes) candidates.push_back(t.name);
    diagnostics_.error(parameter.loc,
                       fmt::format("parameter {} has an unknown type{}, skipped, types are "
                                   "integer, float, bool, point, vector, normal, color, string and "
                                   "texture",
                                   shown, did_you_mean(type_word, candidates)));
  }
  next();
  if (!value(parameter, shown, !known)) return;
  if (rgb) {
    if (parameter.floats.size() != 3) {
      diagnostics_.error(parameter.loc,
                         fmt::format("parameter {} has an unknown type, skipped, write {} "
                                     "with three numbers",
                                     shown, quote(fmt::format("color {}", name))));
      return;
    }
    diagnostics_.warning(parameter.loc, fmt::format("parameter {} read as {}, write that", shown,
                                                    quote(fmt::format("color {}", name))));
  }
  if (Parameter* earlier = names.find(list, parameter)) {
    diagnostics_.warning(parameter.loc,
                         fmt::format("parameter {} is given twice, this one counts and the one at "
                                     "{} does not, remove one",
                                     shown, diagnostics_.place(earlier->loc)),
                         fmt::format("parameter {} is given twice", shown));
    *earlier = std::move(parameter);
    return;
  }
  list.push_back(std::move(parameter));
}

/// Reads the value of a parameter. False: there is nothing to keep (reported, unless `skip`, which
/// reads over a value of whatever type).
bool StatementReader::value(Parameter& parameter, std::string_view shown, bool skip) {
  floats_.clear();
  integers_.clear();
  strings_.clear();
  const bool bare = token_.kind != TokenKind::kOpen;
  std::string raw;
  if (bare && token_.kind == TokenKind::kString) {
    strings_.emplace_back(token_.text);
    raw = token_.raw;
    const SourceLoc at = token_.loc;
    next();
    // Rather `"float fov" "float x" [1]`: the string was the next parameter.
    if (token_.kind == TokenKind::kOpen || token_.kind == TokenKind::kNumber)
      diagnostics_.fail(at, fmt::format("parameter {} has no value, found the string {} in its "
                                        "place, write {} [value]",
                                        shown, quote(strings_[0]), shown));
    if (!skip && is_file_name(parameter)) strings_[0] = file_name(std::move(strings_[0]), raw, at);
  } else if (bare && token_.kind == TokenKind::kNumber) {
    if (!skip && parameter.type == ParameterType::kInteger)
      integers_.push_back(to_integer(token_));
    else
      floats_.push_back(to_float(token_));
    next();
  } else if (bare) {
    diagnostics_.fail(token_.loc, fmt::format("parameter {} has no value, found {} in its place, "
                                              "write {} [value]",
                                              shown, describe(token_), shown));
  } else {
    array_value(parameter, shown, skip);
  }
  if (skip) return false;
  if (floats_.empty() && integers_.empty() && strings_.empty()) {
    diagnostics_.warning(parameter.loc,
                         fmt::format("parameter {} has an empty value, taken as not given", shown));
    return false;
  }
  if (!check_value(parameter, shown, bare, !strings_.empty())) return false;
  parameter.floats.assign(floats_.begin(), floats_.end());
  parameter.integers.assign(integers_.begin(), integers_.end());
  parameter.strings.assign(std::make_move_iterator(strings_.begin()),
                           std::make_move_iterator(strings_.end()));
  return true;
}

void StatementReader::array_value(Parameter& parameter, std::string_view shown, bool skip) {
  const SourceLoc opened = token_.loc;
  const bool integers = !skip && parameter.type == ParameterType::kInteger;
  for (;;) {
    if (strings_.empty()) {
      if (integers)
        lexer_.read_numbers(integers_);
      else
        lexer_.read_numbers(floats_);
    }
    next();
    const bool numbers = !integers_.empty() || !floats_.empty();
    if ((token_.kind == TokenKind::kString && numbers) ||
        (token_.kind == TokenKind::kNumber && !strings_.empty()))
      diagnostics_.fail(token_.loc, fmt::format("parameter {} mixes numbers and strings, found {}, "
                                                "use one kind",
                                                shown, describe(token_)));
    if (token_.kind == TokenKind::kString) {
      strings_.push_back(!skip && is_file_name(parameter)
                             ? file_name(std::string(token_.text), token_.raw, token_.loc)
                             : std::string(token_.text));
    } else if (token_.kind == TokenKind::kNumber) {
      if (integers)
        integers_.push_back(to_integer(token_));
      else
        floats_.push_back(to_float(token_));
    } else {
      break;
    }
  }
  if (token_.kind == TokenKind::kClose) {
    next();
    return;
  }
  if (token_.kind == TokenKind::kWord && strings_.empty() &&
      (token_.text == "nan" || token_.text == "inf" || token_.text == "NaN" ||
       token_.text == "Infinity"))
    diagnostics_.fail(token_.loc, fmt::format("parameter {} holds {}, write a finite number", shown,
                                              token_.text));
  if (token_.kind == TokenKind::kWord && (token_.text == "true" || token_.text == "false"))
    diagnostics_.fail(token_.loc,
                      fmt::format("parameter {} holds {} without quotes, write [\"{}\"]", shown,
                                  token_.text, token_.text));
  diagnostics_.fail(
      token_.loc, fmt::format("the array of {} opened at {} is not closed, found {}, add ]", shown,
                              diagnostics_.place(opened), describe(token_)));
}

/// Holds the value against the declared type. May change the type (a bare string names a texture).
bool StatementReader::check_value(Parameter& parameter, std::string_view shown, bool bare,
                                  bool has_strings) {
  const auto skip = [&](std::string_view why) {
    diagnostics_.error(parameter.loc, fmt::format("parameter {} needs {}, skipped", shown, why));
    return false;
  };
  switch (parameter.type) {
    case ParameterType::kString:
      return has_strings || skip("strings, not numbers");
    case ParameterType::kTexture:
      return (has_strings && strings_.size() == 1) || skip("the name of one texture");
    case ParameterType::kBool:
      if (!has_strings) return skip("\"true\" or \"false\", not numbers");
      if (bare)
        diagnostics_.warning(parameter.loc,
                             fmt::format("parameter {} has no brackets, LuxRender would ignore it, "
                                         "write {} [{}]",
                                         shown, shown, quote(strings_[0])));
      for (std::string& text : strings_) {
        if (text == "true" || text == "false") continue;
        diagnostics_.warning(parameter.loc, fmt::format("parameter {} is {}, taken as false, write "
                                                        "\"true\" or \"false\"",
                                                        shown, quote(text)));
        text = "false";
      }
      return true;
    default:
      break;
  }
  if (has_strings && !bare) return skip("numbers, not strings");
  if (has_strings) {
    diagnostics_.warning(parameter.loc, fmt::format("parameter {} names a texture, write {}", shown,
                                                    quote("texture " + parameter.name)));
    parameter.type = ParameterType::kTexture;
    return true;
  }
  const uint32_t group = numbers_per_value(parameter.type);
  if (const size_t rest = floats_.size() % group) {
    const size_t kept = floats_.size() - rest;
    diagnostics_.warning(
        parameter.loc,
        fmt::format(
            "parameter {} has {} numbers, which is no multiple of {}, {}", shown, floats_.size(),
            group, kept == 0 ? std::string("skipped") : fmt::format("the last {} left out", rest)));
    floats_.resize(kept);
    if (kept == 0) return false;
  }
  return true;
}

/// `C:\new\tree.png` is read as an escaped string by LuxRender and is never meant so. If the name
/// with its escapes resolved is not there, the name as written is taken, with / for \.
std::string StatementReader::file_name(std::string decoded, std::string_view raw,
                                       SourceLoc loc) const {
  if (raw == decoded) return decoded;
  bool odd = false;  // an escape that no writer of file names uses
  for (size_t i = 0; i + 1 < raw.size(); ++i)
    if (raw[i] == '\\') {
      ++i;
      odd = odd || (raw[i] != '\\' && raw[i] != '"');
    }
  if (!odd) return decoded;
  std::error_code ignored;
  if (may_look_ && decoded.find('\0') == std::string::npos &&
      std::filesystem::exists(std::filesystem::path(directory_) / decoded, ignored))
    return decoded;
  diagnostics_.warning(loc, fmt::format("the backslashes in {} are taken as folder separators, "
                                        "write / instead",
                                        quote(raw)));
  std::string slashed(raw);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  return slashed;
}

void StatementReader::fail_number(const Token& token, bool overflow, std::string_view type) const {
  diagnostics_.fail(token.loc,
                    overflow ? fmt::format("the number {} is too large for {}, write a "
                                           "smaller one",
                                           token.text.substr(0, 80), type)
                             : fmt::format("{} is not a number, write digits with an optional "
                                           "point and exponent",
                                           token.text.substr(0, 80)));
}

namespace {
template <class T>
NumberStatus whole_number(const Token& token, T& value) {
  const char* end = token.text.data() + token.text.size();
  const NumberRead<T> read = read_number<T>(token.text.data(), end);
  value = read.value;
  return read.status != NumberStatus::kNotANumber && read.end != end ? NumberStatus::kNotANumber
                                                                     : read.status;
}
}  // namespace

double StatementReader::to_double(const Token& token) const {
  double result = 0;
  const NumberStatus status = whole_number(token, result);
  if (status != NumberStatus::kOk)
    fail_number(token, status == NumberStatus::kOverflow, "a 64-bit float");
  return result;
}

float StatementReader::to_float(const Token& token) const {
  float result = 0;
  const NumberStatus status = whole_number(token, result);
  if (status != NumberStatus::kOk)
    fail_number(token, status == NumberStatus::kOverflow, "a 32-bit float");
  return result;
}

int32_t StatementReader::to_integer(const Token& token) const {
  int32_t result = 0;
  const NumberStatus status = whole_number(token, result);
  if (status == NumberStatus::kOk) return result;
  // 5.0 and 1e3 are integers, too; what has a fraction loses it, as in LuxRender.
  double wide = 0;
  const NumberStatus wide_status =
      status == NumberStatus::kOverflow ? status : whole_number(token, wide);
  if (wide_status == NumberStatus::kNotANumber) fail_number(token, false, {});
  if (wide_status == NumberStatus::kOverflow || !(wide > -2147483649.0 && wide < 2147483648.0))
    fail_number(token, true, "a 32-bit integer");
  result = int32_t(wide);
  if (double(result) != wide)
    diagnostics_.warning(token.loc, fmt::format("{} is not an integer, taken as {}",
                                                token.text.substr(0, 80), result));
  return result;
}

}  // namespace yat
