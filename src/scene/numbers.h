#pragma once
// Numbers in text, the same in every locale (invariant 8).

#include <charconv>
#include <cmath>
#include <limits>

namespace yat {

enum class NumberStatus { kOk, kNotANumber, kOverflow };

template <class T>
struct NumberRead {
  const char* end = nullptr;  ///< behind the number
  T value{};
  NumberStatus status = NumberStatus::kNotANumber;
};

namespace detail {

/// Of a decimal number that the type cannot hold: is it too small rather than too large? Looks at
/// the place of the first digit that is not 0, and the exponent.
inline bool is_underflow(const char* p, const char* end) {
  if (p != end && (*p == '-' || *p == '+')) ++p;
  long magnitude = 0;
  bool digit_seen = false, point_seen = false;
  for (; p != end && *p != 'e' && *p != 'E'; ++p) {
    if (*p == '.') {
      point_seen = true;
    } else {
      if (*p != '0') digit_seen = true;
      if (point_seen ? !digit_seen : digit_seen) magnitude += point_seen ? -1 : 1;
    }
  }
  if (p == end) return magnitude <= 0;
  if (++p != end && *p == '+') ++p;
  long exponent = 0;
  // An exponent that a long cannot hold outweighs any number of digits.
  if (std::from_chars(p, end, exponent).ec == std::errc::result_out_of_range) return *p == '-';
  return exponent < 0 && magnitude < -exponent;
}

}  // namespace detail

/// Reads a decimal number: optional sign, digits with or without a point, optional exponent; no
/// hex, nan or inf. What is too small for T is 0; what is too large is kOverflow. The caller checks
/// what follows `end`.
template <class T>
NumberRead<T> read_number(const char* begin, const char* end) {
  NumberRead<T> read;
  read.end = begin;
  const char* p = begin;
  if (p != end && *p == '+') ++p;  // from_chars knows no plus
  const char* digits = p;
  if (digits != end && *digits == '-' && p == begin) ++digits;
  if (digits == end || !((*digits >= '0' && *digits <= '9') || *digits == '.')) return read;
  const auto [stop, code] = std::from_chars(p, end, read.value);
  if (code == std::errc::invalid_argument) return read;
  read.end = stop;
  read.status = NumberStatus::kOk;
  if constexpr (std::numeric_limits<T>::is_iec559) {
    if (code == std::errc::result_out_of_range) {
      if (detail::is_underflow(p, stop))
        read.value = *p == '-' ? -T(0) : T(0);
      else
        read.status = NumberStatus::kOverflow;
    } else if (std::isinf(read.value)) {
      read.status = NumberStatus::kOverflow;
    }
  } else if (code == std::errc::result_out_of_range) {
    read.status = NumberStatus::kOverflow;
  }
  return read;
}

}  // namespace yat
