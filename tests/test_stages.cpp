// The first and the last stage kernel, classify and accumulate, against scalar code at every count.

#include "kernel_columns.h"

namespace yat {
namespace {

class Stages : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Stages);

TEST_P(Stages, ClassifyGivesBinsMissesAndLastVertices) {
  const KernelTable& k = kernels();
  Random random(1);
  AlignedArray<uint32_t> prim_bin(100);
  for (uint32_t& b : prim_bin) b = 1 + random.below(600);
  const uint32_t first_lasting = 300;
  for (const uint32_t n : tail_counts(k.lanes)) {
    GuardedTable<Hit> hits(n);
    GuardedColumn<uint32_t> depth(n), bin(n);
    for (uint32_t i = 0; i < n; ++i) {
      hits.set(i, {1, 0, 0, random.below(5) ? random.below(100) : kNone});
      depth[i] = random.below(8) | random.below(3) << 16;
    }
    k.classify_hits(prim_bin.data(), first_lasting, 5, hits.view(), depth.data(), bin.data(), n);
    EXPECT_TRUE(bin.untouched());
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t prim = hits.row(i).prim;
      uint32_t wanted = prim == kNone ? 0 : prim_bin[prim];
      if ((depth[i] & 0xffff) >= 5 && wanted < first_lasting) wanted = 0;
      EXPECT_EQ(bin[i], wanted);
    }
  }
}

TEST_P(Stages, FreeShadowRaysAreAddedOnce) {
  const KernelTable& k = kernels();
  Random random(4);
  for (const uint32_t n : tail_counts(k.lanes)) {
    GuardedTable<ShadowRay> rays(n);
    GuardedColumn<uint32_t> occluded(n);
    GuardedTable<SampleSum> sums(2 * n);
    for (uint32_t i = 0; i < 2 * n; ++i) sums.set(i, {float(i), 1, 2, i});
    for (uint32_t i = 0; i < n; ++i) {
      ShadowRay<Value> r{};
      r.add_r = random.unit(), r.add_g = random.unit(), r.add_b = random.unit();
      r.slot = 2 * (n - 1 - i);
      rays.set(i, r);
      occluded[i] = random.below(2);
    }
    k.add_unoccluded(rays.view(), occluded.data(), sums.columns(), n);
    EXPECT_TRUE(sums.untouched(2 * n));
    for (uint32_t i = 0; i < n; ++i) {
      const ShadowRay<Value> r = rays.row(i);
      const SampleSum<Value> s = sums.row(r.slot), other = sums.row(r.slot + 1);
      const float free = occluded[i] ? 0.f : 1.f;
      EXPECT_EQ(s.r, float(r.slot) + free * r.add_r);
      EXPECT_EQ(s.g, 1 + free * r.add_g);
      EXPECT_EQ(s.b, 2 + free * r.add_b);
      EXPECT_EQ(s.pixel, r.slot);
      EXPECT_EQ(other.r, float(r.slot + 1));
    }
  }
}

}  // namespace
}  // namespace yat
