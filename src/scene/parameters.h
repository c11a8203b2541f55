#pragma once
// Typed access to the parameters of a directive, with the diagnostics that go with it: a parameter
// of another type than asked for, a scalar with several numbers, a name that nobody asked for.

#include <glm/vec3.hpp>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/description.h"

namespace yat {

/// Reads one plugin's parameters. Every query marks what it finds as used; report_unused() warns
/// about the rest. A parameter of another type is used where the conversion is obvious (integer and
/// float; one number as a grey; point, vector, normal and color of three numbers; "true" as a
/// bool) with a warning, and otherwise left alone with a warning. Not found: the fallback.
class Parameters {
 public:
  /// `what` is how messages name the directive: `material "matte"`.
  Parameters(const Plugin& plugin, std::string what, Diagnostics& diagnostics);

  float number(std::string_view name, float fallback);
  int32_t integer(std::string_view name, int32_t fallback);
  bool flag(std::string_view name, bool fallback);
  std::string text(std::string_view name, std::string_view fallback);
  /// One point, vector, normal or color.
  glm::dvec3 triple(std::string_view name, ParameterType type, glm::dvec3 fallback);

  /// All numbers of an array (float, point, vector, normal, color); empty if not given. The span is
  /// into the description, or into `storage` if the numbers had to be converted.
  std::span<const float> floats(std::string_view name, ParameterType type,
                                std::vector<float>& storage);
  /// All numbers of an integer array; empty if not given.
  std::span<const int32_t> integers(std::string_view name, std::vector<int32_t>& storage);

  /// The parameter if it is given as a texture, else null.
  const Parameter* texture(std::string_view name);

  /// Row of Description::materials that a string parameter names; kNone if it is not given, or
  /// named none (which the parser has reported).
  uint32_t material(std::string_view name);

  /// Whether the name is given under any type. Does not count as use.
  bool given(std::string_view name) const;
  /// Where the parameter is, or the directive.
  SourceLoc loc(std::string_view name) const;

  /// Names that are known but change nothing here.
  void accept(std::initializer_list<std::string_view> names);
  /// Warns if one of these is given: `message` says what happens without them.
  void unsupported(std::initializer_list<std::string_view> names, std::string_view message);
  /// Everything is known: nothing will be reported.
  void accept_all();

  /// Warns, once per directive type and name, about what nobody asked for.
  void report_unused();

  const Plugin& plugin() const { return plugin_; }
  const std::string& what() const { return what_; }
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  const Parameter* find(std::string_view name, ParameterType type);
  bool is(const Parameter& parameter, std::string_view name) const {
    return parameter.name == name || (plugin_.any_case && same_but_case(parameter.name, name));
  }
  void warn_converted(const Parameter& parameter, ParameterType wanted, std::string_view how);
  void warn_unusable(const Parameter& parameter, ParameterType wanted);
  void warn_count(const Parameter& parameter, size_t count, size_t wanted);

  const Plugin& plugin_;
  std::string what_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;  ///< every name asked for: what a typo may have meant
};

}  // namespace yat
