#pragma once
// Values of options as text, read whole or refused.

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string_view>

#include "base/error.h"

namespace yat {

/// `part` of an option's `text`, the whole of it, as a number in [least, most]. Throws UsageError.
template <class T>
T number(std::string_view option, std::string_view text, std::string_view part, T least, T most) {
  T value{};
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (part.empty() || error != std::errc() || end != part.data() + part.size())
    throw UsageError(
        fmt::format("{} {}: \"{}\" is not a number that fits here", option, text, part));
  if (!(value >= least && value <= most))
    throw UsageError(
        fmt::format("{} {}: {} is not within {} to {}", option, text, value, least, most));
  return value;
}

/// Exactly N numbers between separators. `form`: what the text should look like. Throws UsageError.
template <class T, size_t N>
std::array<T, N> numbers(std::string_view option, std::string_view text, char separator, T least,
                         T most, std::string_view form) {
  std::array<T, N> values{};
  std::string_view rest = text;
  for (size_t i = 0; i < N; ++i) {
    const size_t end = rest.find(separator);
    if ((end == std::string_view::npos) != (i + 1 == N))
      throw UsageError(fmt::format("{} {}: write it as {}", option, text, form));
    values[i] = number<T>(option, text, rest.substr(0, end), least, most);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  return values;
}

}  // namespace yat
