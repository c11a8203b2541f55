#pragma once
// A record is declared once and used in four shapes:
//
//   Ray<Value>           one row, plain members
//   Ray<Lanes<A>::Of>    W rows in registers                     (soa/simd.h)
//   Ray<Column>          n rows in memory, one array per field   (soa/columns.h owns them)
//   Ray<ConstColumn>     the same, read-only
//
// and, for tables that are read at random rows, RowTable (soa/columns.h) keeps the same fields
// side by side so that one row is one or two cache lines.
//
// Every field is 4 bytes wide (float, uint32_t or int32_t): a row of a batch is then one lane in
// each register, whatever the field.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace yat {

template <class T>
using Value = T;
template <class T>
using Column = T*;
template <class T>
using ConstColumn = const T*;

/// "Not there", for every row index.
inline constexpr uint32_t kNone = 0xffffffffu;

/// Columns are padded to a multiple of this many rows and aligned to 64 bytes, so that a kernel of
/// any width may read and write whole registers at the end of a column.
inline constexpr uint32_t kRowPad = 16;

constexpr uint32_t padded_rows(uint32_t n) {
  return (n + kRowPad - 1) / kRowPad * kRowPad;
}

#define YAT_INLINE inline __attribute__((always_inline))

/// Lists the fields of a record, in declaration order. A field that is declared but not listed
/// fails the static_assert(all_fields_listed<...>) that follows every record.
#define YAT_FIELDS(...)                                                   \
  __attribute__((always_inline)) constexpr auto fields() noexcept {       \
    return std::tie(__VA_ARGS__);                                         \
  }                                                                       \
  __attribute__((always_inline)) constexpr auto fields() const noexcept { \
    return std::tie(__VA_ARGS__);                                         \
  }                                                                       \
  static constexpr std::string_view field_list() noexcept {               \
    return #__VA_ARGS__;                                                  \
  }

template <template <template <class> class> class Record>
inline constexpr uint32_t field_count =
    std::tuple_size_v<decltype(std::declval<Record<Column>&>().fields())>;

template <template <template <class> class> class Record>
inline constexpr bool all_fields_listed =
    sizeof(Record<Column>) == field_count<Record> * sizeof(void*) &&
    sizeof(Record<Value>) == field_count<Record> * sizeof(uint32_t);

/// The number of the field with this name. A name that is not there does not compile.
template <template <template <class> class> class Record>
consteval uint32_t field_number(std::string_view name) {
  std::string_view list = Record<Value>::field_list();
  for (uint32_t number = 0;; ++number) {
    const std::size_t end = list.find(',');
    std::string_view field = list.substr(0, end);
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    if (field == name) return number;
    if (end == std::string_view::npos) throw "no such field";
    list.remove_prefix(end + 1);
  }
}

namespace detail {
template <std::size_t I, class F, class... Records>
YAT_INLINE constexpr void visit_field(F&& f, Records&&... records) {
  f(std::integral_constant<uint32_t, I>{}, std::get<I>(records.fields())...);
}
template <class F, std::size_t... I, class... Records>
YAT_INLINE constexpr void visit_fields(F&& f, std::index_sequence<I...>, Records&&... records) {
  (visit_field<I>(f, records...), ...);
}
}  // namespace detail

/// Calls f(index, field_of_first, field_of_second, ...) for every field of the records, which must
/// be shapes of one record type. `index` is an integral_constant.
template <class F, class First, class... Rest>
YAT_INLINE constexpr void for_each_field(F&& f, First&& first, Rest&&... rest) {
  constexpr std::size_t n = std::tuple_size_v<decltype(first.fields())>;
  detail::visit_fields(f, std::make_index_sequence<n>{}, first, rest...);
}

/// The element type of field `f` of a Column or ConstColumn.
template <class Pointer>
using element_t = std::remove_const_t<std::remove_pointer_t<std::remove_reference_t<Pointer>>>;

/// Read-only view of the same columns.
template <template <template <class> class> class Record>
YAT_INLINE Record<ConstColumn> as_const_columns(const Record<Column>& columns) {
  Record<ConstColumn> out;
  for_each_field([](auto, auto& to, const auto& from) { to = from; }, out, columns);
  return out;
}

/// The columns from row `first` on. `first` must keep the alignment that the callee asks for.
template <class Columns>
YAT_INLINE Columns columns_from(const Columns& columns, uint32_t first) {
  Columns out;
  for_each_field([first](auto, auto& to, const auto& from) { to = from + first; }, out, columns);
  return out;
}

/// One row of columns, as a Value record. For scalar code: tests, the reference, scheduling.
template <template <template <class> class> class Record, template <class> class Shape>
Record<Value> get_row(const Record<Shape>& columns, uint32_t row) {
  Record<Value> out;
  for_each_field([row](auto, auto& to, const auto& from) { to = from[row]; }, out, columns);
  return out;
}

/// Writes one row of columns from a Value record.
template <template <template <class> class> class Record>
void set_row(const Record<Column>& columns, uint32_t row, const Record<Value>& value) {
  for_each_field([row](auto, const auto& to, const auto& from) { to[row] = from; }, columns, value);
}

}  // namespace yat
