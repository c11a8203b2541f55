// Plain traversal and the kernels agree: two programs written apart, on the same trees.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "judge.h"
#include "kernels/dispatch.h"
#include "traced_set.h"

namespace yat::bench {
namespace {

std::vector<Hit<Value>> answers(const Config& config, const RaySet& set) {
  TracedSet traced(config, set);
  traced.trace();
  std::vector<Hit<Value>> hits(traced.rows());
  for (uint32_t i = 0; i < traced.rows(); ++i) hits[i] = traced.hit(i);
  return hits;
}

TraceKernel kernel_of(const KernelTable& table, const std::string& name) {
  for (const TraceKernel& kernel : trace_kernels(table))
    if (kernel.name == name) return kernel;
  throw std::logic_error("no kernel " + name);
}

void expect_agreement(const BenchScene& scene, bool strict_kd_tree) {
  ThreadPool pool(1);
  for (const IsaEntry& entry : built_isas()) {
    if (!entry.here) continue;
    const KernelTable& table = *entry.table();
    const Tree tree =
        build_tree(scene.rows.view(), {}, {std::max(4u, table.lanes), strict_kd_tree}, pool);
    for (const RaySet& set : record_rays(scene, table, tree.view, 64, 64)) {
      const auto scalar = answers({&table, kernel_of(table, "scalar"), "auto", &tree, 1024}, set);
      for (const char* name : {"render", "stream"}) {
        const auto kernel = answers({&table, kernel_of(table, name), "auto", &tree, 1024}, set);
        const Differences d = compare(scene, set, kernel, scalar);
        const std::string what = std::string(table.isa) + ", " + name + ", " + set.name;
        EXPECT_EQ(d.hit_miss, 0u) << what;
        EXPECT_EQ(d.yat_wrong + d.other_wrong + d.unjudged, 0u) << what;
        EXPECT_EQ(d.yat_t_off + d.other_t_off, 0u) << what;
      }
    }
  }
}

TEST(ScalarTrace, AgreesWithTheKernels) {
  expect_agreement(cornell_box(), false);
  expect_agreement(rough_sphere(6000), false);
  expect_agreement(columns_hall(6000), true);
}

TEST(ScalarTrace, StreamsAndThreadsChangeNothing) {
  const BenchScene scene = rough_sphere(6000);
  ThreadPool pool(1);
  const KernelTable& table = select_kernels();
  const Tree tree = build_tree(scene.rows.view(), {}, {std::max(4u, table.lanes), false}, pool);
  const TraceKernel kernel = kernel_of(table, "render");
  for (const RaySet& set : record_rays(scene, table, tree.view, 64, 64)) {
    TracedSet whole({&table, kernel, "auto", &tree, 8192}, set);
    TracedSet cut({&table, kernel, "auto", &tree, 48}, set);
    whole.trace();
    cut.trace_on(3);
    for (uint32_t i = 0; i < whole.rows(); ++i) {
      ASSERT_EQ(whole.hit(i).prim, cut.hit(i).prim) << set.name << " " << i;
      ASSERT_EQ(whole.hit(i).t, cut.hit(i).t) << set.name << " " << i;
    }
  }
}

TEST(ScalarTrace, BadRaysMiss) {
  const BenchScene scene = cornell_box();
  ThreadPool pool(1);
  const KernelTable& table = select_kernels();
  const Tree tree = build_tree(scene.rows.view(), {}, {std::max(4u, table.lanes), false}, pool);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const RaySet set{"bad",
                   false,
                   {{0, 0, 0, 0, 0, 0, kRayFar},
                    {nan, 0, 0, 0, 0, 1, kRayFar},
                    {0, 0, 0, 0, nan, 1, kRayFar},
                    {0, 0, 0, 0, 0, 1, nan},
                    {0, 0, 0, 0, 0, 1, kRayFar}}};
  const auto hits = answers({&table, kernel_of(table, "scalar"), "auto", &tree, 16}, set);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(hits[size_t(i)].prim, kNone) << i;
  EXPECT_NE(hits[4].prim, kNone);
}

}  // namespace
}  // namespace yat::bench
