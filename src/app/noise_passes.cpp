#include "app/noise_passes.h"

#include <algorithm>
#include <bit>

#include "kernels/strata.h"
#include "wavefront/allocation.h"

namespace yat {

namespace {

constexpr uint32_t kFirstCount = 4;
constexpr uint32_t kHalfSamples = uint32_t(1) << 29;

/// What fits of `step` further samples in each half before the time limit, at the speed so far.
uint32_t fitting(uint32_t step, uint32_t done, double seconds, double time_limit) {
  if (time_limit <= 0 || !done || seconds <= 0) return step;
  const double fits = std::max(0., time_limit - seconds) * double(done) / seconds;
  if (fits >= double(step)) return step;
  return std::bit_floor(std::max(1u, uint32_t(fits)));
}

/// Paths that the render will have had when the error, which falls with their number, is on target.
uint64_t expected_paths(const NoiseEstimate& noise, double target, uint64_t paths, uint64_t most) {
  const double needed = double(paths) * std::max(1., noise.high() / target);
  return needed < double(most) ? uint64_t(needed) : most;
}

}  // namespace

uint32_t second_half(const Plan& plan) {
  if (!is_stratified(plan.sampler)) return kHalfSamples;
  const uint32_t set = plan.set_columns * plan.set_rows;
  return kHalfSamples / set * set;
}

uint32_t next_half_count(uint32_t n) {
  if (n < kFirstCount) return kFirstCount;
  const uint32_t power = std::bit_floor(n);
  return n - power < power / 2 ? power + power / 2 : 2 * power;
}

namespace {

/// One render to a noise target.
class NoiseRender {
 public:
  NoiseRender(const PassContext& context, const PassLimits& limits, FilmParts& halves)
      : context_(context),
        limits_(limits),
        halves_(halves),
        pixels_(uint64_t(halves.width()) * halves.height()),
        first_index_{0, second_half(context.plan)},
        runner_(context) {
    if (limits.adaptive != Adaptive::kOff)
      pilot_.emplace(halves.width(), halves.height(), halves.features(), 2);
  }

  RenderTotals run() {
    if (run_uniform()) {
      const bool pays = weigh_blocks();
      end_pilot();
      if (pays)
        run_adaptive();
      else
        run_uniform();
    }
    end_pilot();
    RenderTotals totals = runner_.finish();
    if (!noise_) noise_ = halves_.noise(context_.pool);
    if (noise_->pixels) totals.noise = noise_;
    totals.noise_target = limits_.noise_target;
    totals.adaptive = halves_.weigh == Weigh::kEqually;
    return totals;
  }

 private:
  uint64_t most() const { return limits_.samples.end * pixels_; }
  bool render(uint32_t half, FilmParts& into, RenderOptions options) {
    options.features = into[half].features_or_null();
    return runner_.run(options, into[half].film);
  }
  /// Samples [first, end) of every pixel of a half. While there is a pilot the second half of what
  /// there is then goes to films of its own, which beside the first tell the variance.
  bool render_range(uint32_t half, uint32_t first, uint32_t end) {
    const uint32_t middle = pilot_ && first ? std::max(first, end / 2) : end;
    RenderOptions options;
    options.first_sample = first_index_[half] + first;
    options.end_sample = first_index_[half] + middle;
    if (middle > first && !render(half, halves_, options)) return false;
    if (middle == end) return true;
    options.first_sample = first_index_[half] + middle;
    options.end_sample = first_index_[half] + end;
    return render(half, *pilot_, options);
  }
  NoiseEstimate noise_so_far() {
    if (!pilot_) return halves_.noise(context_.pool);
    Film whole[2] = {halves_[0].film, halves_[1].film};
    for (uint32_t half = 0; half < 2; ++half) whole[half].merge((*pilot_)[half].film);
    return estimate_noise(whole[0], whole[1], halves_.weigh, context_.pool);
  }
  /// Whether the round just done, which ends with so many samples in the picture, is the last.
  bool reached(uint64_t samples) {
    noise_ = noise_so_far();
    runner_.expect(expected_paths(*noise_, limits_.noise_target, samples, most()));
    return noise_->high() <= limits_.noise_target;
  }

  /// How many times as many samples the target needs, at most those that are allowed; more than 1.
  double factor() const {
    return std::min(noise_->high() / limits_.noise_target,
                    double(limits_.samples.end / 2) / double(done_));
  }
  /// Samples of each half after the next uniform round. Leaps where the target is far: error may
  /// fall faster than 1 / n, and the estimate be high, so not all the way.
  uint32_t next_uniform() const {
    if (!done_) return kFirstCount;
    const double far = noise_->low() / limits_.noise_target / kCaution;
    const double leap = pilot_ ? std::min(far, factor() / kMostFactor) : far;
    return std::max(next_half_count(done_), nice_count(leap * double(done_)));
  }

  /// Rounds that are alike for all pixels. Returns whether the pilot is large enough and there is
  /// more to do.
  bool run_uniform() {
    const uint32_t most_each = limits_.samples.end / 2;
    while (done_ < most_each && !runner_.over()) {
      const uint32_t step = fitting(std::min(next_uniform(), most_each) - done_, done_,
                                    runner_.seconds(), context_.time_limit);
      noise_.reset();
      fold_pilot();
      for (uint32_t half = 0; half < 2; ++half)
        if (!render_range(half, done_, done_ + step)) return false;
      done_ += step;
      if (reached(2 * done_ * pixels_)) return false;
      if (pilot_ && done_ >= kLeastPilot && factor() <= kMostFactor && factor() >= kLeastFactor)
        return true;
    }
    return false;
  }

  void end_pilot() {
    fold_pilot();
    pilot_.reset();
  }
  /// Moves what is in the pilot's films to the halves.
  void fold_pilot() {
    if (!pilot_) return;
    for (uint32_t half = 0; half < 2; ++half) {
      halves_[half].film.merge((*pilot_)[half].film);
      if (halves_[half].features) halves_[half].features->merge(*(*pilot_)[half].features);
    }
    pilot_.emplace(halves_.width(), halves_.height(), halves_.features(), 2);
  }
  /// Each half's weights, by what the other half's pilot was like. Returns whether they pay.
  bool weigh_blocks() {
    const SampleMap map(context_.scene.film);
    std::vector<double> noise[2];
    for (uint32_t half = 0; half < 2; ++half) {
      noise[half] = block_noise(halves_[half].film, (*pilot_)[half].film, Weigh::kByCount,
                                kWorkBlock, context_.pool);
      weights_[1 - half] = sample_weights(noise[half], map.columns, map.rows);
    }
    if (limits_.adaptive == Adaptive::kOn) return true;
    double gain = 0;
    for (uint32_t half = 0; half < 2; ++half) gain += .5 * gain_of(weights_[half], noise[half]);
    return gain >= kLeastGain;
  }

  void run_adaptive() {
    halves_.weigh = Weigh::kEqually;
    SampleMap map(context_.scene.film);
    const std::vector<uint32_t> block_pixels = pixels_of_blocks(map);
    std::vector<uint32_t> counts[2];
    for (std::vector<uint32_t>& c : counts) c.assign(map.blocks.size(), done_);
    uint64_t total = 2 * done_ * pixels_;
    while (total < most() && !runner_.over()) {
      const uint64_t wanted = std::min(most(), next_total(total));
      const double scale = scale_for(weights_, block_pixels, done_, wanted);
      uint64_t next = 0;
      std::vector<uint32_t> next_counts[2];
      for (uint32_t half = 0; half < 2; ++half) {
        next_counts[half] = sample_counts(weights_[half], scale, done_);
        next += total_samples(next_counts[half], block_pixels);
      }
      // Steps of all blocks at once may be larger than what is left.
      if (next <= total) break;
      noise_.reset();
      for (uint32_t half = 0; half < 2; ++half) {
        for (size_t i = 0; i < map.blocks.size(); ++i)
          map.blocks[i] = {first_index_[half] + counts[half][i],
                           first_index_[half] + next_counts[half][i]};
        RenderOptions options;
        options.samples = &map;
        if (!render(half, halves_, options)) return;
        counts[half] = next_counts[half];
      }
      total = next;
      if (reached(total)) return;
    }
  }
  /// Samples of the picture after the next round: sqrt(2) times as many, more where the target is
  /// far, or what fits into the time.
  uint64_t next_total(uint64_t total) const {
    const double far = noise_->low() / limits_.noise_target / kCaution;
    double more = (std::clamp(far, 1.4142, kMostFactor) - 1) * double(total);
    if (context_.time_limit > 0)
      more =
          std::min(more, std::max(0., context_.time_limit / runner_.seconds() - 1) * double(total));
    return total + uint64_t(more);
  }
  std::vector<uint32_t> pixels_of_blocks(const SampleMap& map) const {
    std::vector<uint32_t> pixels;
    pixels.reserve(map.blocks.size());
    for (uint32_t y = 0; y < halves_.height(); y += kWorkBlock)
      for (uint32_t x = 0; x < halves_.width(); x += kWorkBlock)
        pixels.push_back(std::min(kWorkBlock, halves_.width() - x) *
                         std::min(kWorkBlock, halves_.height() - y));
    return pixels;
  }

  static constexpr uint32_t kLeastPilot = 8;  ///< samples of each half
  static constexpr double kLeastFactor = 1.5, kMostFactor = 8;
  static constexpr double kCaution = 1.5;
  /// Noisy blocks take more time per sample, too; and relMSE is not all that counts.
  static constexpr double kLeastGain = 1.5;

  const PassContext& context_;
  const PassLimits& limits_;
  FilmParts& halves_;
  const uint64_t pixels_;
  const uint32_t first_index_[2];
  PassRunner runner_;
  std::optional<FilmParts> pilot_;  ///< second parts of the halves, until the weights are known
  std::vector<double> weights_[2];
  uint32_t done_ = 0;  ///< samples of every pixel of each half
  std::optional<NoiseEstimate> noise_;
};

}  // namespace

RenderTotals render_to_noise(const PassContext& context, const PassLimits& limits,
                             FilmParts& halves) {
  return NoiseRender(context, limits, halves).run();
}

}  // namespace yat
