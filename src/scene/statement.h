#pragma once
// Tokens -> the arguments of a directive: strings, numbers, and lists of `"type name" value`.

#include <string>
#include <vector>

#include "base/error.h"
#include "scene/description.h"
#include "scene/lexer.h"

namespace yat {

/// Reads arguments, one token ahead. Throws Error where the text cannot be a scene; what is merely
/// odd is reported and left out.
class StatementReader {
 public:
  StatementReader(Lexer& lexer, Diagnostics& diagnostics, std::string directory, bool may_look)
      : lexer_(lexer),
        diagnostics_(diagnostics),
        directory_(std::move(directory)),
        may_look_(may_look) {}

  const Token& token() const { return token_; }
  void next() { token_ = lexer_.next(); }

  /// For messages: the directive whose arguments are read, and how it is written.
  void begin(std::string_view directive, std::string_view usage) {
    directive_ = directive;
    usage_ = usage;
  }
  std::string string();
  double number();
  /// `[numbers]`; count 0: any number of them.
  std::vector<double> array(size_t count);
  std::vector<Parameter> parameters();

 private:
  [[noreturn]] void fail_expected(std::string_view what) const;
  void parameter(std::vector<Parameter>& parameters, class RepeatedNames& names);
  bool value(Parameter& parameter, std::string_view shown, bool skip);
  void array_value(Parameter& parameter, std::string_view shown, bool skip);
  bool check_value(Parameter& parameter, std::string_view shown, bool bare, bool has_strings);
  std::string file_name(std::string decoded, std::string_view raw, SourceLoc loc) const;
  double to_double(const Token& token) const;
  float to_float(const Token& token) const;
  int32_t to_integer(const Token& token) const;
  [[noreturn]] void fail_number(const Token& token, bool overflow, std::string_view type) const;

  Lexer& lexer_;
  Diagnostics& diagnostics_;
  std::string directory_;
  bool may_look_;  ///< at the file system, to see whether a file is there
  Token token_;
  std::string_view directive_, usage_;
  // Arrays grow here and are copied out at their size.
  std::vector<float> floats_;
  std::vector<int32_t> integers_;
  std::vector<std::string> strings_;
};

/// "float", "point", ...
std::string_view parameter_type_name(ParameterType type);

/// Numbers that make one value of the type: 3 for points, vectors, normals and colours.
uint32_t numbers_per_value(ParameterType type);

}  // namespace yat
