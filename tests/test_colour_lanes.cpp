// kernels/colour_bands.h on registers against the scalar code, built here for one instruction set.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/colour_bands.h"
#include "scene/colour_model.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {
namespace {

using A = NativeArch;

TEST(ColourLanes, AgreeWithTheScalarCode) {
  std::mt19937 engine(9);
  const auto smaller = [](const Float<A>& x, const Float<A>& y) { return xsimd::min(x, y); };
  const ColourModel& model = colour_model(ColourMode::kBands);
  for (int trial = 0; trial < 1000; ++trial) {
    float in[3][kLanes<A>];
    for (auto& channel : in)
      for (float& x : channel) x = float(engine() >> 8) * 0x1p-24f;
    in[1][0] = in[2][0] = in[0][0];  // a grey lane among others
    ColourTriple<Float<A>> rgb{load<A>(in[0], 0), load<A>(in[1], 0), load<A>(in[2], 0)};
    for (const BandBasis* basis : {&model.reflectance, &model.light}) {
      const ColourTriple<Float<A>> bands = bands_of(rgb, *basis, smaller);
      const ColourTriple<Float<A>> back = rgb_of(bands, model.film);
      for (uint32_t i = 0; i < kLanes<A>; ++i) {
        const glm::dvec3 expected = to_bands({in[0][i], in[1][i], in[2][i]}, *basis);
        const glm::dvec3 found(bands.r.get(i), bands.g.get(i), bands.b.get(i));
        const glm::dvec3 expected_back = to_rgb(expected, model.film);
        const glm::dvec3 found_back(back.r.get(i), back.g.get(i), back.b.get(i));
        for (int k = 0; k < 3; ++k) {
          // A handful of roundings of numbers up to 1.2.
          EXPECT_NEAR(found[k], expected[k], 6e-7);
          EXPECT_NEAR(found_back[k], expected_back[k], 1e-6);
        }
      }
      EXPECT_EQ(bands.g.get(0), in[0][0]);
      EXPECT_EQ(back.b.get(0), in[0][0]);
    }
  }
}

}  // namespace
}  // namespace yat::YAT_ISA
