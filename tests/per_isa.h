#pragma once
// GoogleTest over every kernel table that runs on this machine.
//
//   class Traverse : public yat::PerIsa {};
//   YAT_INSTANTIATE_PER_ISA(Traverse);
//   TEST_P(Traverse, FindsTheNearestHit) { kernels().intersect_closest(...); }
//
// A test that never asks for kernels() fails: it would say nothing of the instruction set.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kernels/dispatch.h"

namespace yat {

class PerIsa : public testing::TestWithParam<const IsaEntry*> {
 protected:
  const KernelTable& kernels() {
    asked_ = true;
    return *GetParam()->table();
  }
  void TearDown() override {
    if (!IsSkipped()) {
      EXPECT_TRUE(asked_) << "the test called no kernel of " << GetParam()->name;
    }
  }

 private:
  bool asked_ = false;
};

inline std::vector<const IsaEntry*> isas_here() {
  std::vector<const IsaEntry*> entries;
  for (const IsaEntry& entry : built_isas())
    if (entry.here) entries.push_back(&entry);
  return entries;
}

#define YAT_INSTANTIATE_PER_ISA(Fixture)                                                   \
  INSTANTIATE_TEST_SUITE_P(Isa, Fixture, testing::ValuesIn(yat::isas_here()),              \
                           [](const testing::TestParamInfo<const yat::IsaEntry*>& entry) { \
                             return std::string(entry.param->name);                        \
                           })

/// Every count at which a kernel's tail can go wrong: 0 to 3 W + 1.
inline std::vector<uint32_t> tail_counts(uint32_t lanes) {
  std::vector<uint32_t> counts;
  for (uint32_t n = 0; n <= 3 * lanes + 1; ++n) counts.push_back(n);
  return counts;
}

}  // namespace yat
