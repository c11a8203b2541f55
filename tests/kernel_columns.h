#pragma once
// Columns for kernel tests: filled with a pattern, so that a test sees what a kernel wrote.

#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "per_isa.h"
#include "soa/columns.h"
#include "soa/records.h"

namespace yat {

inline constexpr uint32_t kPattern = 0xcdcdcdcdu;
/// Rows after the padded ones that no kernel may touch.
inline constexpr uint32_t kGuardRows = 32;

/// Columns with room for n rows, their padding, and guard rows behind.
template <template <template <class> class> class Record>
class GuardedTable {
 public:
  explicit GuardedTable(uint32_t n) : n_(n), table_(padded_rows(n) + kGuardRows) {
    for_each_field(
        [&](auto, const auto& column) {
          for (uint32_t i = 0; i < padded_rows(n) + kGuardRows; ++i)
            std::memcpy(&column[i], &kPattern, 4);
        },
        table_.columns());
  }
  const Record<Column>& columns() const { return table_.columns(); }
  Record<ConstColumn> view() const { return table_.view(); }
  Record<Value> row(uint32_t i) const { return table_.row(i); }
  void set(uint32_t i, const Record<Value>& value) { table_.set(i, value); }

  /// Whether all rows from `first` on (default: behind the padding) still hold the pattern.
  bool untouched(uint32_t first = kNone) const {
    bool all = true;
    for_each_field(
        [&](auto, const auto& column) {
          for (uint32_t i = first == kNone ? padded_rows(n_) : first;
               i < padded_rows(n_) + kGuardRows; ++i)
            all = all && std::memcmp(&column[i], &kPattern, 4) == 0;
        },
        table_.columns());
    return all;
  }

 private:
  uint32_t n_;
  Table<Record> table_;
};

/// One column with the same guards.
template <class T>
class GuardedColumn {
 public:
  explicit GuardedColumn(uint32_t n) : n_(n), values_(padded_rows(n) + kGuardRows) {
    for (uint32_t i = 0; i < padded_rows(n) + kGuardRows; ++i)
      std::memcpy(&values_[i], &kPattern, 4);
  }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  T& operator[](uint32_t i) { return values_[i]; }
  const T& operator[](uint32_t i) const { return values_[i]; }
  bool untouched() const {
    for (uint32_t i = padded_rows(n_); i < padded_rows(n_) + kGuardRows; ++i)
      if (std::memcmp(&values_[i], &kPattern, 4) != 0) return false;
    return true;
  }

 private:
  uint32_t n_;
  AlignedArray<T> values_;
};

/// Random inputs with a fixed seed.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  /// In [0, 1), 24 bits, as the samplers give.
  float unit() { return float(engine_() >> 8) * 0x1p-24f; }
  float in(float low, float high) { return low + (high - low) * unit(); }
  uint32_t below(uint32_t n) { return engine_() % n; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 v(in(-1, 1), in(-1, 1), in(-1, 1));
      const double l = glm::length(v);
      if (l > .1 && l <= 1) return v / l;
    }
  }
  glm::dvec3 point(float extent) {
    return {in(-extent, extent), in(-extent, extent), in(-extent, extent)};
  }

 private:
  std::mt19937 engine_;
};

inline glm::dvec3 rounded(const glm::dvec3& v) {
  return {double(float(v.x)), double(float(v.y)), double(float(v.z))};
}

inline void expect_near(const glm::dvec3& found, const glm::dvec3& wanted, double tolerance,
                        const char* what, uint32_t row) {
  EXPECT_LE(glm::length(found - wanted), tolerance)
      << what << " of row " << row << ": (" << found.x << ", " << found.y << ", " << found.z
      << ") for (" << wanted.x << ", " << wanted.y << ", " << wanted.z << ")";
}

/// |found - wanted| <= tolerance * max(|wanted|, floor).
inline void expect_close(double found, double wanted, double tolerance, const char* what,
                         uint32_t row, double floor = 1e-6) {
  EXPECT_LE(std::abs(found - wanted), tolerance * std::max(std::abs(wanted), floor))
      << what << " of row " << row << ": " << found << " for " << wanted;
}

}  // namespace yat
