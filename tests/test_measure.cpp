// Medians and the memory of this process, on which every benchmark's table stands.

#include "measure.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

namespace yat::bench {
namespace {

TEST(Measure, Median) {
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({9, 1, 2}), 2);
  EXPECT_EQ(median({8, 1, 2, 4}), 3);
}

TEST(Measure, GeometricMean) {
  EXPECT_EQ(geometric_mean({}), 0);
  EXPECT_NEAR(geometric_mean({2, 8}), 4, 1e-12);
  EXPECT_NEAR(geometric_mean({0.5, 0.5, 4}), 1, 1e-12);
}

TEST(Measure, ClocksGoOn) {
  const double wall = wall_seconds(), thread = thread_seconds(), process = process_seconds();
  double sum = 0;
  while (thread_seconds() - thread < 0.01) sum += wall_seconds();
  EXPECT_GT(sum, 0);
  EXPECT_GE(wall_seconds() - wall, 0.009);
  EXPECT_GE(process_seconds() - process, 0.009);
}

TEST(Measure, PeakOfMemoryStartsAnew) {
  constexpr size_t kBytes = size_t(64) << 20;
  if (!reset_peak_bytes()) GTEST_SKIP() << "this system cannot reset the peak";
  const uint64_t before = resident_bytes();
  {
    const auto block = std::make_unique<char[]>(kBytes);
    std::memset(block.get(), 1, kBytes);
    EXPECT_GE(peak_resident_bytes(), before + kBytes * 9 / 10);
  }
  ASSERT_TRUE(reset_peak_bytes());
  EXPECT_LT(peak_resident_bytes(), before + kBytes / 2);
}

TEST(Measure, OriginNamesProgramAndMachine) {
  const Json json = origin("bench_test");
  EXPECT_EQ(json["program"], "bench_test");
  EXPECT_GT(json["machine"]["cores"], 0);
  EXPECT_FALSE(std::string(json["compiler"]).empty());
}

}  // namespace
}  // namespace yat::bench
