// Records, columns and tables: what all else stands on.

#include <gtest/gtest.h>

#include "soa/columns.h"
#include "soa/records.h"

namespace yat {
namespace {

TEST(Table, RowsRoundTripAndColumnsAreAligned) {
  Table<Ray> rays(21);
  for (uint32_t i = 0; i < 21; ++i) {
    Ray<Value> ray{};
    ray.org_x = float(i);
    ray.t_max = float(100 + i);
    rays.set(i, ray);
  }
  for (uint32_t i = 0; i < 21; ++i) {
    EXPECT_EQ(rays.row(i).org_x, float(i));
    EXPECT_EQ(rays.row(i).t_max, float(100 + i));
    EXPECT_EQ(rays.row(i).dir_y, 0.f);
  }
  for_each_field(
      [](auto, const auto& column) { EXPECT_EQ(reinterpret_cast<uintptr_t>(column) % 64, 0u); },
      rays.columns());
}

TEST(Table, ColumnsDoNotOverlap) {
  Table<PathState> paths(16);
  uint32_t fields = 0;
  for_each_field(
      [&](auto index, const auto& column) {
        for (uint32_t i = 0; i < 32; ++i) std::memset(&column[i], int(index + 1), 4);
        ++fields;
      },
      paths.columns());
  EXPECT_EQ(fields, field_count<PathState>);
  for_each_field(
      [&](auto index, const auto& column) {
        for (uint32_t i = 0; i < 32; ++i) {
          uint32_t expected = 0x01010101u * (index + 1), found;
          std::memcpy(&found, &column[i], 4);
          EXPECT_EQ(found, expected);
        }
      },
      paths.columns());
}

TEST(RowTable, RowsRoundTrip) {
  RowTable<Hit> hits(5);
  for (uint32_t i = 0; i < 5; ++i) hits.set(i, Hit<Value>{float(i), .25f, .5f, i * 7});
  for (uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(hits.row(i).t, float(i));
    EXPECT_EQ(hits.row(i).prim, i * 7);
  }
  EXPECT_EQ(row_words<Hit>, 8u);
  EXPECT_EQ(row_words<Surface>, 32u);
}

TEST(Fields, NamesFollowTheDeclaration) {
  EXPECT_EQ(Hit<Value>::field_list(), "t, u, v, prim");
}

}  // namespace
}  // namespace yat
