#pragma once
// A render against the scalar reference: path by path, and picture by picture.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render_scenes.h"
#include "wavefront/reference.h"

namespace yat {

/// Share of paths whose radiance agrees with the reference's to `tolerance` of it. As the random
/// numbers are the same, the noise of the whole picture cancels too: its mean must agree closely.
inline double agreement(const Scene& scene, const Plan& plan, uint32_t samples, double largest_bias,
                        double tolerance = 1e-4) {
  const uint32_t width = scene.film.crop_width(), height = scene.film.crop_height();
  uint64_t same = 0;
  double difference = 0, total = 0;
  for (uint32_t sample = 0; sample < samples; ++sample) {
    const std::vector<float> rgb = render_film(scene, plan, sample, sample + 1).resolve();
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const glm::dvec3 expected = reference_sample(scene, plan, x, y, sample);
        const float* p = &rgb[3 * (size_t(y) * width + x)];
        const glm::dvec3 found(p[0], p[1], p[2]);
        same += glm::length(found - expected) <= tolerance * glm::length(expected);
        difference += found.x + found.y + found.z - (expected.x + expected.y + expected.z);
        total += expected.x + expected.y + expected.z;
      }
  }
  EXPECT_LT(std::fabs(difference / total), largest_bias);
  return double(same) / double(uint64_t(width) * height * samples);
}

/// z-test of block means against the reference with other random numbers. A block's variance
/// comes from its samples. At |z| < 4.5 a right renderer passes all of up to 200 tests with
/// probability 99.8 % (normal approximation).
inline void expect_same_picture(const Scene& scene, const KernelTable& kernels, uint32_t max_depth,
                                uint32_t samples, uint32_t block) {
  PlanOptions options;
  options.max_depth = max_depth;
  options.sampler = SamplerKind::kIndependent;
  options.seed = 1;
  const Plan plan = make_plan(scene, kernels, options);
  options.seed = 2;
  const Plan other = make_plan(scene, kernels, options);
  const uint32_t width = scene.film.crop_width(), height = scene.film.crop_height();
  const uint32_t across = (width + block - 1) / block, down = (height + block - 1) / block;
  // Per block and channel, the block's sum for each sample.
  std::vector<std::vector<double>> ours(across * down * 3, std::vector<double>(samples)),
      theirs = ours;
  for (uint32_t sample = 0; sample < samples; ++sample) {
    const std::vector<float> rgb = render_film(scene, plan, sample, sample + 1).resolve();
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const glm::dvec3 expected = reference_sample(scene, other, x, y, sample);
        const uint32_t b = y / block * across + x / block;
        for (uint32_t k = 0; k < 3; ++k) {
          ours[3 * b + k][sample] += double(rgb[3 * (size_t(y) * width + x) + k]);
          theirs[3 * b + k][sample] += expected[int(k)];
        }
      }
  }
  double worst = 0;
  for (size_t i = 0; i < ours.size(); ++i) {
    const Estimate a = estimate(ours[i]), b = estimate(theirs[i]);
    const double error = std::hypot(a.error, b.error);
    if (error == 0) {
      EXPECT_EQ(a.mean, b.mean);
      continue;
    }
    const double z = (a.mean - b.mean) / error;
    worst = std::max(worst, std::fabs(z));
    EXPECT_LT(std::fabs(z), 4.5) << "block " << i / 3 << " channel " << i % 3 << ": " << a.mean
                                 << " against " << b.mean << " +- " << error;
  }
  testing::Test::RecordProperty("worst_z", std::to_string(worst));
}

}  // namespace yat
