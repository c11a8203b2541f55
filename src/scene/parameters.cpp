#include "scene/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/statement.h"

namespace yat {

namespace {

bool is_triple(ParameterType type) {
  return type == ParameterType::kPoint || type == ParameterType::kVector ||
         type == ParameterType::kNormal || type == ParameterType::kColor;
}

bool is_numbers(ParameterType type) {
  return type == ParameterType::kFloat || is_triple(type);
}

}  // namespace

Parameters::Parameters(const Plugin& plugin, std::string what, Diagnostics& diagnostics)
    : plugin_(plugin), what_(std::move(what)), diagnostics_(diagnostics) {}

const Parameter* Parameters::find(std::string_view name, ParameterType type) {
  known_.emplace_back(name);
  // The last one counts; one of the right type before any other; a texture is asked for as such.
  const Parameter* other = nullptr;
  for (auto it = plugin_.parameters.rbegin(); it != plugin_.parameters.rend(); ++it) {
    if (!is(*it, name)) continue;
    if (it->type == type) {
      it->used = true;
      return &*it;
    }
    if (!other && it->type != ParameterType::kTexture) other = &*it;
  }
  if (other) other->used = true;
  return other;
}

void Parameters::warn_converted(const Parameter& parameter, ParameterType wanted,
                                std::string_view how) {
  diagnostics_.warning(parameter.loc,
                       fmt::format("parameter \"{} {}\" of {} should be \"{} {}\": {}",
                                   parameter_type_name(parameter.type), parameter.name, what_,
                                   parameter_type_name(wanted), parameter.name, how));
}

void Parameters::warn_unusable(const Parameter& parameter, ParameterType wanted) {
  warn_converted(parameter, wanted, "the default is used");
}

void Parameters::warn_count(const Parameter& parameter, size_t count, size_t wanted) {
  diagnostics_.warning(
      parameter.loc,
      fmt::format("parameter \"{} {}\" of {} has {} value{} where {} wanted: the default is used",
                  parameter_type_name(parameter.type), parameter.name, what_, count,
                  count == 1 ? "" : "s", wanted == 1 ? "one is" : fmt::format("{} are", wanted)));
}

float Parameters::number(std::string_view name, float fallback) {
  const Parameter* p = find(name, ParameterType::kFloat);
  if (!p) return fallback;
  if (p->type == ParameterType::kInteger) {
    if (p->integers.size() != 1) return warn_count(*p, p->integers.size(), 1), fallback;
    warn_converted(*p, ParameterType::kFloat, "the number is used");
    return float(p->integers[0]);
  }
  if (p->type != ParameterType::kFloat) return warn_unusable(*p, ParameterType::kFloat), fallback;
  if (p->floats.size() != 1) return warn_count(*p, p->floats.size(), 1), fallback;
  return p->floats[0];
}

int32_t Parameters::integer(std::string_view name, int32_t fallback) {
  const Parameter* p = find(name, ParameterType::kInteger);
  if (!p) return fallback;
  if (p->type == ParameterType::kFloat) {
    if (p->floats.size() != 1) return warn_count(*p, p->floats.size(), 1), fallback;
    // Also false for a NaN: there is no integer to make of it.
    if (!(std::abs(p->floats[0]) < 2147483648.0f))
      return warn_unusable(*p, ParameterType::kInteger), fallback;
    warn_converted(*p, ParameterType::kInteger, "the number is used without its fraction");
    return int32_t(p->floats[0]);
  }
  if (p->type != ParameterType::kInteger)
    return warn_unusable(*p, ParameterType::kInteger), fallback;
  if (p->integers.size() != 1) return warn_count(*p, p->integers.size(), 1), fallback;
  return p->integers[0];
}

bool Parameters::flag(std::string_view name, bool fallback) {
  const Parameter* p = find(name, ParameterType::kBool);
  if (!p) return fallback;
  const bool is_text = p->type == ParameterType::kString || p->type == ParameterType::kBool;
  if (!is_text) return warn_unusable(*p, ParameterType::kBool), fallback;
  if (p->strings.size() != 1) return warn_count(*p, p->strings.size(), 1), fallback;
  const std::string& value = p->strings[0];
  if (value != "true" && value != "false") {
    if (p->type == ParameterType::kString) return warn_unusable(*p, ParameterType::kBool), fallback;
    diagnostics_.warning(
        p->loc, fmt::format("\"{}\" is neither \"true\" nor \"false\": false is used", value));
    return false;
  }
  if (p->type == ParameterType::kString)
    warn_converted(*p, ParameterType::kBool, "the value is used");
  return value == "true";
}

std::string Parameters::text(std::string_view name, std::string_view fallback) {
  const Parameter* p = find(name, ParameterType::kString);
  if (!p) return std::string(fallback);
  if (p->type != ParameterType::kString)
    return warn_unusable(*p, ParameterType::kString), std::string(fallback);
  if (p->strings.size() != 1) return warn_count(*p, p->strings.size(), 1), std::string(fallback);
  return p->strings[0];
}

uint32_t Parameters::material(std::string_view name) {
  const Parameter* p = find(name, ParameterType::kString);
  return p ? p->material : 0xffffffffu;
}

glm::dvec3 Parameters::triple(std::string_view name, ParameterType type, glm::dvec3 fallback) {
  const Parameter* p = find(name, type);
  if (!p) return fallback;
  if (type == ParameterType::kColor && p->type == ParameterType::kFloat && p->floats.size() == 1) {
    warn_converted(*p, type, "the number is used as a grey");
    return glm::dvec3(double(p->floats[0]));
  }
  if (type == ParameterType::kColor && p->type == ParameterType::kInteger &&
      p->integers.size() == 1) {
    warn_converted(*p, type, "the number is used as a grey");
    return glm::dvec3(double(p->integers[0]));
  }
  if (p->type == ParameterType::kInteger && p->integers.size() == 3) {
    warn_converted(*p, type, "the numbers are used");
    return {p->integers[0], p->integers[1], p->integers[2]};
  }
  if (!is_numbers(p->type)) return warn_unusable(*p, type), fallback;
  if (p->floats.size() != 3) return warn_count(*p, p->floats.size(), 3), fallback;
  if (p->type != type) warn_converted(*p, type, "the numbers are used");
  return {double(p->floats[0]), double(p->floats[1]), double(p->floats[2])};
}

std::span<const float> Parameters::floats(std::string_view name, ParameterType type,
                                          std::vector<float>& storage) {
  const Parameter* p = find(name, type);
  if (!p) return {};
  if (p->type == ParameterType::kInteger) {
    warn_converted(*p, type, "the numbers are used");
    storage.assign(p->integers.begin(), p->integers.end());
    return storage;
  }
  if (!is_numbers(p->type)) return warn_unusable(*p, type), std::span<const float>{};
  if (p->type != type) warn_converted(*p, type, "the numbers are used");
  return p->floats;
}

std::span<const int32_t> Parameters::integers(std::string_view name,
                                              std::vector<int32_t>& storage) {
  const Parameter* p = find(name, ParameterType::kInteger);
  if (!p) return {};
  if (p->type == ParameterType::kFloat) {
    const bool fits = std::all_of(p->floats.begin(), p->floats.end(),
                                  [](float x) { return std::abs(x) < 2147483648.0f; });
    if (fits) {
      warn_converted(*p, ParameterType::kInteger, "the numbers are used without their fractions");
      storage.clear();
      for (float x : p->floats) storage.push_back(int32_t(x));
      return storage;
    }
  }
  if (p->type != ParameterType::kInteger)
    return warn_unusable(*p, ParameterType::kInteger), std::span<const int32_t>{};
  return p->integers;
}

const Parameter* Parameters::texture(std::string_view name) {
  known_.emplace_back(name);
  for (auto it = plugin_.parameters.rbegin(); it != plugin_.parameters.rend(); ++it)
    if (is(*it, name) && it->type == ParameterType::kTexture) {
      it->used = true;
      return &*it;
    }
  return nullptr;
}

bool Parameters::given(std::string_view name) const {
  return std::any_of(plugin_.parameters.begin(), plugin_.parameters.end(),
                     [&](const Parameter& p) { return is(p, name); });
}

SourceLoc Parameters::loc(std::string_view name) const {
  for (auto it = plugin_.parameters.rbegin(); it != plugin_.parameters.rend(); ++it)
    if (is(*it, name)) return it->loc;
  return plugin_.loc;
}

void Parameters::accept(std::initializer_list<std::string_view> names) {
  for (std::string_view name : names) {
    known_.emplace_back(name);
    for (const Parameter& p : plugin_.parameters)
      if (is(p, name)) p.used = true;
  }
}

void Parameters::unsupported(std::initializer_list<std::string_view> names,
                             std::string_view message) {
  for (std::string_view name : names) {
    if (given(name))
      diagnostics_.warning(loc(name), fmt::format("parameter \"{}\" of {} is not yet supported: {}",
                                                  name, what_, message));
    accept({name});
  }
}

void Parameters::accept_all() {
  for (const Parameter& p : plugin_.parameters) p.used = true;
}

void Parameters::report_unused() {
  for (const Parameter& p : plugin_.parameters) {
    if (p.used) continue;
    p.used = true;
    // A texture nobody could take is a parameter of the wrong type, not an unknown name.
    const bool known = std::any_of(known_.begin(), known_.end(),
                                   [&](std::string_view name) { return is(p, name); });
    if (p.type == ParameterType::kTexture && known)
      diagnostics_.warning(p.loc, fmt::format("parameter \"{}\" of {} cannot be a texture: the "
                                              "default is used",
                                              p.name, what_));
    else
      diagnostics_.warning(
          p.loc, fmt::format("parameter \"{} {}\" of {} is not used{}", parameter_type_name(p.type),
                             p.name, what_,
                             known ? "" : did_you_mean(p.name, {known_.begin(), known_.end()})));
  }
}

}  // namespace yat
