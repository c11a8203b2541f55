#pragma once
// Running texture kernels on made-up surfaces, and the oracle beside them.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <deque>
#include <random>
#include <vector>

#include "kernel_columns.h"
#include "kernels/table.h"
#include "soa/columns.h"
#include "wavefront/reference_textures.h"

namespace yat {

/// n surfaces at random places, with random inputs for a step.
class TextureRows {
 public:
  explicit TextureRows(uint32_t n, uint32_t seed = 1)
      : n_(n), surfaces_(n), derivatives_(n), random_(seed) {
    for (uint32_t i = 0; i < n; ++i) {
      Surface<Value> s{};
      s.pos_x = between(-3, 3), s.pos_y = between(-3, 3), s.pos_z = between(-3, 3);
      s.u = between(-2, 3), s.v = between(-2, 3);
      glm::vec3 normal(between(-1, 1), between(-1, 1), between(-1, 1));
      normal = glm::normalize(normal + glm::vec3(0, 0, .01f));
      s.ns_x = normal.x, s.ns_y = normal.y, s.ns_z = normal.z;
      s.prim = uint32_t(random_() % 1000);
      s.parameter = i % kRows;
      surfaces_.set(i, s);
      derivatives_.set(i, {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1),
                           between(-1, 1), between(-1, 1), between(0, .2f)});
    }
  }
  static constexpr uint32_t kRows = 5;  ///< of constants

  float between(float a, float b) { return std::uniform_real_distribution<float>(a, b)(random_); }
  std::mt19937& random() { return random_; }

  /// A step's record repeated with changes, as rows of constants.
  template <template <template <class> class> class Record, class Make>
  void constants(Make make) {
    row_words_ = row_words<Record>;
    words_.resize(size_t(kRows) * row_words_);
    for (uint32_t r = 0; r < kRows; ++r)
      for_each_field(
          [&](auto i, const auto& field) { std::memcpy(&words_[r * row_words_ + i], &field, 4); },
          make(r));
  }
  /// A new input column, random in [a, b].
  std::vector<float>& input(float a, float b) {
    auto& column = inputs_.emplace_back(n_ + kRowPad);
    for (uint32_t i = 0; i < n_; ++i) column[i] = between(a, b);
    return column;
  }

  /// Output columns of the kernel and of the oracle, for inputs that take `inputs` columns each.
  struct Outputs {
    std::vector<std::vector<float>> found;
    std::vector<std::vector<double>> expected;
  };
  Outputs run(const KernelTable& kernels, StepKind kind, uint32_t variant, uint32_t outputs,
              uint32_t columns_per_input, const TexelView& texels = {},
              const BandBasis& basis = colour_model(ColourMode::kBands).reflectance) const {
    Outputs out;
    out.found.assign(outputs, std::vector<float>(n_ + kRowPad, -77));
    out.expected.assign(outputs, std::vector<double>(n_));
    const auto column = [&](size_t input, uint32_t channel) {
      return std::min(input * columns_per_input + std::min(channel, columns_per_input - 1),
                      inputs_.size() - 1);
    };
    const size_t inputs = inputs_.size() / columns_per_input;
    TextureStepView step;
    step.variant = variant;
    step.constants = {words_.data(), kRows, nullptr};
    for (size_t k = 0; k < inputs; ++k)
      for (uint32_t c = 0; c < 3; ++c) step.in[k][c] = inputs_[column(k, c)].data();
    for (uint32_t k = 0; k < outputs; ++k) step.out[k] = out.found[k].data();
    kernels.run_texture[uint32_t(kind)]({surfaces_.view(), derivatives_.view(), texels, basis},
                                        step, n_);

    for (uint32_t i = 0; i < n_; ++i) {
      const Surface<Value> s = surfaces_.row(i);
      const SurfaceDerivatives<Value> d = derivatives_.row(i);
      const reference::TexturePlace at{
          {s.pos_x, s.pos_y, s.pos_z}, {s.ns_x, s.ns_y, s.ns_z}, double(s.u),     double(s.v),
          {d.du_x, d.du_y, d.du_z},    {d.dv_x, d.dv_y, d.dv_z}, double(d.width), s.prim};
      reference::StepPlace place{at, variant, {}, {}, outputs, texels, basis};
      for (size_t k = 0; k < inputs; ++k)
        for (uint32_t c = 0; c < 3; ++c) place.input[k][c] = double(inputs_[column(k, c)][i]);
      reference::run_step(kind, &words_[size_t(s.parameter) * row_words_], place);
      for (uint32_t k = 0; k < outputs; ++k) out.expected[k][i] = place.output[k];
    }
    return out;
  }

  /// Share of outputs that are off by more than `tolerance`, absolute below 1 and relative above.
  static double share_off(const Outputs& out, double tolerance) {
    uint64_t off = 0, count = 0;
    for (size_t k = 0; k < out.expected.size(); ++k)
      for (size_t i = 0; i < out.expected[k].size(); ++i, ++count) {
        const double expected = out.expected[k][i], found = double(out.found[k][i]);
        off += !(std::fabs(found - expected) <= tolerance * std::fmax(1, std::fabs(expected)));
      }
    return double(off) / double(count);
  }

  Table<Surface>& surfaces() { return surfaces_; }

 private:
  uint32_t n_;
  Table<Surface> surfaces_;
  Table<SurfaceDerivatives> derivatives_;
  std::mt19937 random_;
  uint32_t row_words_ = 0;
  std::vector<uint32_t> words_;
  std::deque<std::vector<float>> inputs_;  ///< references to columns stay right
};

}  // namespace yat
