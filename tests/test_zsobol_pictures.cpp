// zsobol in rendered pictures: as much error as sobol in pixels, less where pixels are seen
// together.

#include "bias_scenes.h"
#include "gaussian_blur.h"

namespace yat {
namespace {

constexpr uint32_t kSeeds = 16;
using Picture = std::vector<double>;  ///< luminances

Picture render_grey(const Scene& scene, SamplerKind sampler, uint32_t samples, uint32_t seed) {
  PlanOptions options;
  options.sampler = sampler;
  options.sample_set = samples;
  options.max_depth = 4;
  options.seed = seed;
  const std::vector<float> rgb =
      render_film(scene, make_plan(scene, select_kernels(), options), 0, samples).resolve();
  Picture grey;
  for (size_t i = 0; i < rgb.size(); i += 3)
    grey.push_back(.2126 * double(rgb[i]) + .7152 * double(rgb[i + 1]) +
                   .0722 * double(rgb[i + 2]));
  return grey;
}

/// Errors of pictures of seeds 1 .. kSeeds.
std::vector<Picture> errors_of(const Scene& scene, SamplerKind sampler, uint32_t samples,
                               const Picture& truth) {
  std::vector<Picture> out;
  for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
    out.push_back(render_grey(scene, sampler, samples, seed));
    for (size_t i = 0; i < truth.size(); ++i) out.back()[i] -= truth[i];
  }
  return out;
}
std::vector<double> blurred_squares(const std::vector<Picture>& errors, double sigma) {
  std::vector<double> out;
  for (const Picture& error : errors) out.push_back(mean_square(blurred(error, kProofSide, sigma)));
  return out;
}

/// `gain`: by how much less the mean square of a blurred error must be, at least.
void compare(const std::string& text, uint32_t samples, double gain) {
  const Scene scene = compile_text(text, select_kernels());
  const Picture truth = render_grey(scene, SamplerKind::kSobol, 1024, 1000);
  const std::vector<Picture> own = errors_of(scene, SamplerKind::kSobol, samples, truth);
  const std::vector<Picture> shared = errors_of(scene, SamplerKind::kZSobol, samples, truth);
  double own_square = 0, shared_square = 0;
  for (uint32_t i = 0; i < kSeeds; ++i) {
    own_square += mean_square(own[i]);
    shared_square += mean_square(shared[i]);
  }
  EXPECT_NEAR(shared_square / own_square, 1, .1) << samples << " samples";
  for (const double sigma : {1., 2.}) {
    const double surely =
        surely_times_less(blurred_squares(own, sigma), blurred_squares(shared, sigma));
    testing::Test::RecordProperty(
        "gain_" + std::to_string(samples) + "_" + std::to_string(int(sigma)),
        std::to_string(surely));
    EXPECT_GT(surely, gain) << samples << " samples, blurred by " << sigma;
  }
}

TEST(ZSobolPictures, BlurredErrorFallsInARoom) {
  compare(box_text(), 4, 1.1);
}
TEST(ZSobolPictures, BlurredErrorFallsOnRoughMetal) {
  compare(plates_text(), 4, 1.2);
}
// Six of the eight samples that pixels have in their common sequence.
TEST(ZSobolPictures, PartsOfSetsGainToo) {
  compare(box_text(), 6, 1);
}

}  // namespace
}  // namespace yat
