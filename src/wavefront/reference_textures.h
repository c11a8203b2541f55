#pragma once
// Textures of the oracle: programs step by step in doubles. For each record NAMEParameters of the
// registry there is an overload
//
//   void run(const NAMEParameters<Value>&, StepPlace&)
//
// that reads place.in(k, channel) and calls place.out(k, value). Formulas are those of the scene
// format, not those of the kernels.

#include <array>
#include <vector>

#include "kernels/textures/all.h"
#include "scene/texture_program.h"
#include "wavefront/reference_parts.h"

namespace yat::reference {

/// Where a texture is looked up.
struct TexturePlace {
  Vec position, normal;  ///< scene space; shading normal
  double u = 0, v = 0;
  Vec du{0.}, dv{0.};
  double width = 0;  ///< footprint()
  uint32_t prim = 0;
};

struct StepPlace {
  const TexturePlace& at;
  uint32_t variant;
  std::array<std::array<double, 3>, kTextureInputs> input{};
  std::array<double, kTextureOutputs> output{};
  uint32_t outputs;  ///< that are wanted
  TexelView texels;
  BandBasis basis;

  double in(uint32_t k, uint32_t channel = 0) const { return input[k][channel]; }
  Vec colour(uint32_t k) const { return {in(k, 0), in(k, 1), in(k, 2)}; }
  void out(uint32_t k, double value) { output[k] = value; }
  void out(const Vec& c) {
    for (int k = 0; k < 3; ++k) output[size_t(k)] = c[k];
  }
  uint32_t form(uint32_t forms) const { return (variant & 255) % forms; }
};

// Patterns and noise: reference_patterns.cpp.
void run_pattern(const CheckerboardParameters<Value>&, StepPlace&);
void run_pattern(const BilerpParameters<Value>&, StepPlace&);
void run_pattern(const BrickParameters<Value>&, StepPlace&);
void run_pattern(const DotsParameters<Value>&, StepPlace&);
void run_pattern(const UvColourParameters<Value>&, StepPlace&);
void run_pattern(const UvMaskParameters<Value>&, StepPlace&);
void run_pattern(const HarlequinParameters<Value>&, StepPlace&);
void run_pattern(const NoiseParameters<Value>&, StepPlace&);
void run_pattern(const MarbleParameters<Value>&, StepPlace&);
void run_pattern(const BlenderParameters<Value>&, StepPlace&);

/// One step whose constants are these words.
void run_step(StepKind kind, const uint32_t* constants, StepPlace& place);

}  // namespace yat::reference
