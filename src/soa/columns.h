#pragma once
// Owning storage for records: Table (one array per field) and RowTable (fields side by side).
// Scene and scheduling code only; kernels see the pointers.

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "soa/fields.h"

namespace yat {

struct FreeAligned {
  void operator()(void* p) const { std::free(p); }
};

/// `bytes` of zeroed memory aligned to a cache line, or to 2 MB where that much is asked for (the
/// system may then back it with huge pages). Throws std::bad_alloc.
std::unique_ptr<std::byte[], FreeAligned> allocate_aligned(size_t bytes);
/// The same, but the memory holds anything: for what is written whole at once.
std::unique_ptr<std::byte[], FreeAligned> allocate_unset(size_t bytes);

/// A growable-once array of T: 64-byte aligned, padded by at least kRowPad elements, zeroed.
template <class T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(size_t n) { resize(n); }
  AlignedArray(std::span<const T> values) {
    resize(values.size());
    if (!values.empty()) std::memcpy(data(), values.data(), values.size_bytes());
  }
  /// Discards the contents.
  void resize(size_t n) {
    memory_ = allocate_aligned((n + kRowPad) * sizeof(T));
    size_ = n;
  }
  /// The same, but only the padding is zeroed: for whoever writes every element.
  void resize_unset(size_t n) {
    memory_ = allocate_unset((n + kRowPad) * sizeof(T));
    std::memset(static_cast<void*>(data() + n), 0, kRowPad * sizeof(T));
    size_ = n;
  }
  T* data() { return reinterpret_cast<T*>(memory_.get()); }
  const T* data() const { return reinterpret_cast<const T*>(memory_.get()); }
  T& operator[](size_t i) { return data()[i]; }
  const T& operator[](size_t i) const { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  size_t bytes() const { return memory_ ? (size_ + kRowPad) * sizeof(T) : 0; }

 private:
  std::unique_ptr<std::byte[], FreeAligned> memory_;
  size_t size_ = 0;
};

/// Columns of a record: capacity rows, padded to kRowPad plus one whole register, so that a
/// compressing store of W lanes may start at any row below capacity.
template <template <template <class> class> class Record>
class Table {
 public:
  Table() = default;
  explicit Table(uint32_t capacity) { resize(capacity); }

  /// Discards the contents; all fields become zero.
  void resize(uint32_t capacity) {
    capacity_ = capacity;
    const size_t stride = padded_rows(capacity) + kRowPad;
    memory_ = allocate_aligned(stride * sizeof(uint32_t) * field_count<Record>);
    for_each_field(
        [&](auto index, auto& column) {
          column = reinterpret_cast<std::remove_reference_t<decltype(column)>>(
              memory_.get() + stride * sizeof(uint32_t) * index);
        },
        columns_);
  }
  const Record<Column>& columns() const { return columns_; }
  Record<ConstColumn> view() const { return as_const_columns<Record>(columns_); }
  uint32_t capacity() const { return capacity_; }
  size_t bytes() const {
    return capacity_ ? (padded_rows(capacity_) + kRowPad) * sizeof(uint32_t) * field_count<Record>
                     : 0;
  }
  Record<Value> row(uint32_t i) const { return get_row<Record>(columns_, i); }
  void set(uint32_t i, const Record<Value>& value) { set_row<Record>(columns_, i, value); }

 private:
  Record<Column> columns_{};
  std::unique_ptr<std::byte[], FreeAligned> memory_;
  uint32_t capacity_ = 0;
};

/// Words per row of a RowTable: the field count rounded up to 8 or a multiple of 16, so that a row
/// of up to 16 fields lies in one cache line.
template <template <template <class> class> class Record>
inline constexpr uint32_t row_words =
    field_count<Record> <= 8 ? 8 : (field_count<Record> + 15) / 16 * 16;

/// Read-only view of a RowTable: field f of row r is word r * row_words + f.
template <template <template <class> class> class Record>
struct Rows {
  const uint32_t* words = nullptr;
  uint32_t count = 0;
};

/// A table that kernels read at random rows, fields of a row side by side.
template <template <template <class> class> class Record>
class RowTable {
 public:
  RowTable() = default;
  explicit RowTable(uint32_t rows) { resize(rows); }
  /// Discards the contents; all fields become zero.
  void resize(uint32_t rows) {
    words_.resize(size_t(rows) * row_words<Record>);
    count_ = rows;
  }
  void set(uint32_t row, const Record<Value>& value) {
    for_each_field(
        [&](auto index, const auto& field) {
          std::memcpy(words_.data() + size_t(row) * row_words<Record> + index, &field, 4);
        },
        value);
  }
  Record<Value> row(uint32_t r) const {
    Record<Value> out;
    for_each_field(
        [&](auto index, auto& field) {
          std::memcpy(&field, words_.data() + size_t(r) * row_words<Record> + index, 4);
        },
        out);
    return out;
  }
  Rows<Record> view() const { return {words_.data(), count_}; }
  uint32_t size() const { return count_; }
  size_t bytes() const { return words_.bytes(); }

 private:
  AlignedArray<uint32_t> words_;
  uint32_t count_ = 0;
};

}  // namespace yat
