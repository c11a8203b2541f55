// Invariant 3: one picture, to the bit, for any threads, batch, tiles and split of the samples; and
// invariant 6: what is not finite costs its own sample only.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "per_isa.h"
#include "render_scenes.h"
#include "wavefront/pilot.h"

namespace yat {
namespace {

constexpr uint32_t kWidth = 37, kHeight = 23, kSamples = 6;

class Determinism : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Determinism);

TEST_P(Determinism, SameBitsForAnyThreadsBatchTileAndSplit) {
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels());
  for (const SamplerKind sampler :
       {SamplerKind::kSobol, SamplerKind::kIndependent, SamplerKind::kZSobol}) {
    PlanOptions options;
    options.sampler = sampler;
    options.seed = 5;
    const Plan plan = make_plan(scene, kernels(), options);
    const Film expected = render_film(scene, plan, 0, kSamples);
    ASSERT_EQ(expected.total_samples(), uint64_t(kWidth) * kHeight * kSamples);
    for (const uint32_t threads : {1u, 2u, 3u, 7u})
      for (const uint32_t batch_rows : {16u, 1000u, 8192u})
        for (const uint32_t tile : {0u, 5u, 64u}) {
          if (batch_rows == 16 && tile != 0) continue;  // slow, and tiles do not matter to it
          EXPECT_TRUE(
              same_bits(expected, render_film(scene, plan, 0, kSamples, threads, batch_rows, tile)))
              << threads << " threads, " << batch_rows << " rows, tile " << tile;
        }
    Film merged = render_film(scene, plan, 2, kSamples, 2);
    merged.merge(render_film(scene, plan, 0, 2, 3, 500));
    EXPECT_TRUE(same_bits(expected, merged)) << "two ranges merged";
    // Adding to a film that already holds samples is a merge, too.
    Film grown(kWidth, kHeight);
    ThreadPool pool(2);
    for (uint32_t sample = 0; sample < kSamples; ++sample) {
      RenderOptions one;
      one.first_sample = sample;
      one.end_sample = sample + 1;
      render(scene, plan, one, pool, grown);
    }
    EXPECT_TRUE(same_bits(expected, grown)) << "one sample at a time";
  }
}

TEST_P(Determinism, ShadowRaysThatPlayRouletteDoSoWhereverTheyAreTraced) {
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels());
  PlanOptions options;
  options.seed = 5;
  options.shadow_roulette = .3;
  Plan plan = make_plan(scene, kernels(), options);
  set_shadow_bound(scene, plan);
  ASSERT_GT(plan.transport.shadow_bound, 0.f);
  const Film expected = render_film(scene, plan, 0, kSamples);
  ASSERT_EQ(expected.total_samples(), uint64_t(kWidth) * kHeight * kSamples);
  for (const uint32_t threads : {1u, 2u, 7u})
    for (const uint32_t batch_rows : {16u, 1000u})
      EXPECT_TRUE(
          same_bits(expected, render_film(scene, plan, 0, kSamples, threads, batch_rows, 5)))
          << threads << " threads, " << batch_rows << " rows";
  Film merged = render_film(scene, plan, 2, kSamples, 2);
  merged.merge(render_film(scene, plan, 0, 2, 3, 500));
  EXPECT_TRUE(same_bits(expected, merged)) << "two ranges merged";
  // A crop finds the bound anew, from the whole picture.
  Scene part = compile_text(everything_text(kWidth, kHeight), kernels());
  part.film.crop_x0 = 11, part.film.crop_x1 = 30, part.film.crop_y0 = 4, part.film.crop_y1 = 21;
  Plan of_part = make_plan(part, kernels(), options);
  set_shadow_bound(part, of_part);
  const Film crop = render_film(part, of_part, 0, kSamples);
  for (uint32_t y = 0; y < crop.height(); ++y)
    for (uint32_t x = 0; x < crop.width(); ++x)
      ASSERT_TRUE(same_bits(crop.at(x, y), expected.at(x + 11, y + 4))) << x << ' ' << y;
}

TEST_P(Determinism, TheSeedChangesThePicture) {
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels());
  PlanOptions options;
  const Film a = render_film(scene, make_plan(scene, kernels(), options), 0, 2);
  options.seed = 1;
  EXPECT_FALSE(same_bits(a, render_film(scene, make_plan(scene, kernels(), options), 0, 2)));
}

TEST_P(Determinism, ACropIsThatPartOfThePicture) {
  const Scene whole = compile_text(everything_text(kWidth, kHeight), kernels());
  Scene part = compile_text(everything_text(kWidth, kHeight), kernels());
  part.film.crop_x0 = 11, part.film.crop_x1 = 30, part.film.crop_y0 = 4, part.film.crop_y1 = 21;
  const Film all = render_film(whole, make_plan(whole, kernels(), {}), 0, 3);
  const Film crop = render_film(part, make_plan(part, kernels(), {}), 0, 3, 2);
  for (uint32_t y = 0; y < crop.height(); ++y)
    for (uint32_t x = 0; x < crop.width(); ++x)
      ASSERT_TRUE(same_bits(crop.at(x, y), all.at(x + 11, y + 4))) << x << ' ' << y;
}

TEST_P(Determinism, StoppingLeavesWholeSamplesOnly) {
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels());
  const Plan plan = make_plan(scene, kernels(), {});
  std::vector<Film> first;  // first[k]: samples [0, k)
  for (uint32_t k = 0; k <= kSamples; ++k) first.push_back(render_film(scene, plan, 0, k));
  for (const uint32_t threads : {1u, 2u}) {
    std::atomic<bool> stop{false};
    RenderOptions options;
    options.end_sample = kSamples;
    options.batch_rows = 64;
    options.tile_size = 8;
    options.stop = &stop;
    options.progress = [&](uint64_t done, const RenderStats&) { stop = done > 500; };
    ThreadPool pool(threads);
    Film film(kWidth, kHeight);
    const RenderResult result = render(scene, plan, options, pool, film);
    EXPECT_TRUE(result.stopped);
    EXPECT_GT(film.total_samples(), 500u);
    EXPECT_LT(film.total_samples(), uint64_t(kWidth) * kHeight * kSamples);
    EXPECT_EQ(film.total_samples(), result.stats.paths);
    EXPECT_EQ(result.stats.camera_rays, result.stats.paths);
    // A block's samples are begun in order, and those begun were finished: a pixel with k samples
    // has the first k, to the bit.
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const uint64_t k = film.at(x, y).samples;
        ASSERT_LE(k, kSamples);
        ASSERT_TRUE(same_bits(film.at(x, y), first[k].at(x, y))) << x << ' ' << y << ": " << k;
      }
  }
  std::atomic<bool> stop{true};
  RenderOptions options;
  options.stop = &stop;
  ThreadPool pool(2);
  Film film(kWidth, kHeight);
  EXPECT_TRUE(render(scene, plan, options, pool, film).stopped);
  EXPECT_EQ(film.total_samples(), 0u);
}

// ---- Faults ------------------------------------------------------------------------------------

constexpr uint32_t kFaultyPixel = 7u << 16 | 12u, kFaultySample = 3;
const KernelTable* healthy = nullptr;
decltype(KernelTable::add_emission) healthy_emission = nullptr;

/// The real kernel, with one path's throughput spoilt.
void faulty_camera(const SceneView& scene, const CameraSample<ConstColumn>& samples,
                   const float* film_u, const float* film_v, const float* lens_u,
                   const float* lens_v, const Ray<Column>& rays, const PathState<Column>& paths,
                   uint32_t n) noexcept {
  healthy->generate_camera_rays[1](scene, samples, film_u, film_v, lens_u, lens_v, rays, paths, n);
  for (uint32_t i = 0; i < n; ++i)
    if (samples.pixel[i] == kFaultyPixel && samples.sample[i] == kFaultySample)
      paths.throughput_g[i] = std::numeric_limits<float>::quiet_NaN();
}

/// The real kernel, and every sum of the pixel infinite.
void faulty_sums(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                 const PathState<ConstColumn>& paths, const SampleSum<Column>& sums, DropLog& log,
                 uint32_t n) noexcept {
  healthy_emission(scene, surfaces, paths, sums, log, n);
  for (uint32_t i = 0; i < n; ++i)
    if (paths.pixel[i] == kFaultyPixel)
      sums.r[paths.slot[i]] = std::numeric_limits<float>::infinity();
}

TEST_P(Determinism, AFaultCostsItsOwnSampleAndIsCounted) {
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels());
  healthy = &kernels();
  KernelTable faulty = kernels();
  faulty.generate_camera_rays[1] = &faulty_camera;
  const Film clean = render_film(scene, make_plan(scene, kernels(), {}), 0, kSamples);
  RenderResult result;
  const Film film = render_film(scene, make_plan(scene, faulty, {}), 0, kSamples, 2, 0, 0, &result);
  uint64_t dropped = 0;
  for (const uint64_t count : result.stats.dropped) dropped += count;
  EXPECT_GE(dropped, 1u);
  ASSERT_GE(result.drops.kept, 1u);
  EXPECT_EQ(result.drops.entry[0].pixel, kFaultyPixel);
  EXPECT_EQ(result.drops.entry[0].sample, kFaultySample);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x)
      if ((y << 16 | x) != kFaultyPixel) {
        ASSERT_TRUE(same_bits(film.at(x, y), clean.at(x, y))) << x << ' ' << y;
      }
  for (const float value : film.resolve()) ASSERT_TRUE(std::isfinite(value));
}

TEST_P(Determinism, ABrokenSumIsRefusedByTheFilmAndCounted) {
  // Every surface emits, so that the pixel's sums are all spoilt.
  const Scene scene =
      compile_text(view_text("0 -.5 0", "0 0 0", 60, kWidth, kHeight) + light_text("1 1 1") +
                       matte_text(".5 .5 .5") + room_text(1) + "WorldEnd\n",
                   kernels());
  const bool tree = make_plan(scene, kernels(), {}).light_tree;
  healthy_emission = tree ? kernels().add_tree_emission : kernels().add_emission;
  KernelTable faulty = kernels();
  faulty.add_emission = faulty.add_tree_emission = &faulty_sums;
  RenderResult result;
  const Film film = render_film(scene, make_plan(scene, faulty, {}), 0, kSamples, 2, 0, 0, &result);
  EXPECT_EQ(film.at(12, 7).samples, 0u);
  EXPECT_EQ(result.stats.dropped[uint32_t(DropCause::kOther)], kSamples);
  EXPECT_EQ(film.total_samples(), uint64_t(kWidth * kHeight - 1) * kSamples);
  EXPECT_EQ(result.stats.paths, uint64_t(kWidth) * kHeight * kSamples);
  ASSERT_EQ(result.drops.kept, kSamples);
  EXPECT_EQ(result.drops.entry[0].pixel, kFaultyPixel);
}

}  // namespace
}  // namespace yat
