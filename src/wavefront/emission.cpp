#include "wavefront/emission.h"

#include <algorithm>

namespace yat {

namespace {

uint32_t emission_word(const LightView& lights, uint32_t light, uint32_t word) {
  return lights.emission.words[size_t(light) * row_words<EmissionRow> + word];
}

}  // namespace

EmissionStage::EmissionStage(const Scene& scene, const KernelTable& kernels, uint32_t chunk_rows)
    : kernels_(kernels),
      textures_(scene.emission_programs, scene.colour.light, kernels, chunk_rows),
      programs_(uint32_t(scene.emission_programs.size())),
      stride_(padded_rows(chunk_rows) + kRowPad) {
  if (scene.emission.size() == 0) return;
  for (uint32_t i = 0; i < scene.emission.size() && !by_direction_; ++i)
    by_direction_ = scene.emission.row(i).map != kNone;
  light_.resize(stride_);
  factor_.resize(3 * size_t(stride_));
  tinted_.resize(3 * size_t(stride_));
  if (!programs_) return;
  parameter_.resize(stride_);
  order_.resize(stride_);
  points_.resize(chunk_rows);
  at_a_point_.resize(chunk_rows);
}

void EmissionStage::fill_ones(uint32_t n) {
  for (float* column : columns(factor_).c) std::fill_n(column, n, 1.f);
}

PathState<ConstColumn> EmissionStage::tint(const Bin& bin, const TextureStage::Chunk& chunk) {
  const Surface<Column>& surfaces = chunk.surfaces;
  const Columns factor = columns(factor_), tinted = columns(tinted_);
  if (bin.emission_program != kNone) {
    for (uint32_t i = 0; i < chunk.n; ++i)
      parameter_[i] =
          surfaces.light[i] == kNone
              ? 0
              : emission_word(chunk.scene.lights, surfaces.light[i], kEmissionParameterWord);
    // As light samples see it: without the normals of vertices.
    Surface<Column> shining = surfaces;
    shining.parameter = parameter_.data();
    shining.ns_x = surfaces.ng_x;
    shining.ns_y = surfaces.ng_y;
    shining.ns_z = surfaces.ng_z;
    const ParameterView made = textures_.run(
        bin.emission_program,
        {chunk.scene, chunk.geometry, chunk.order, chunk.instance, shining, chunk.paths, chunk.n});
    for (int c = 0; c < 3; ++c)
      std::copy_n(reinterpret_cast<const float*>(made.columns[c]), chunk.n, factor.c[c]);
  } else {
    fill_ones(chunk.n);
  }
  if (bin.emission_by_direction) {
    const float* const direction[3] = {surfaces.wo_x, surfaces.wo_y, surfaces.wo_z};
    kernels_.apply_emission_maps(chunk.scene, surfaces.light, direction, 1, factor.c, chunk.n);
  }
  PathState<ConstColumn> out = chunk.paths;
  const float* const throughput[3] = {out.throughput_r, out.throughput_g, out.throughput_b};
  kernels_.multiply_colours(throughput, factor.c, tinted.c, chunk.n);
  out.throughput_r = tinted.c[0];
  out.throughput_g = tinted.c[1];
  out.throughput_b = tinted.c[2];
  return out;
}

void EmissionStage::scale(const SceneView& scene, const LightSample<Column>& samples, uint32_t n) {
  const Columns factor = columns(factor_);
  fill_ones(n);
  for (uint32_t program = 0; program < programs_; ++program) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; ++i) {
      // What does not shine here is not looked at: there may be no point.
      const bool lit =
          samples.weight_r[i] != 0 || samples.weight_g[i] != 0 || samples.weight_b[i] != 0;
      if (lit && emission_word(scene.lights, light_[i], kEmissionProgramWord) == program)
        order_[count++] = i;
    }
    if (!count) continue;
    kernels_.make_light_points(scene, light_.data(), order_.data(),
                               as_const_columns<LightSample>(samples), points_.columns(), count);
    const ParameterView made =
        textures_.run(program, points_.view(), at_a_point_.view(), scene.texels, count);
    for (int c = 0; c < 3; ++c) {
      const auto* from = reinterpret_cast<const float*>(made.columns[c]);
      for (uint32_t i = 0; i < count; ++i) factor.c[c][order_[i]] = from[i];
    }
  }
  if (by_direction_) {
    const float* const direction[3] = {samples.wi_x, samples.wi_y, samples.wi_z};
    kernels_.apply_emission_maps(scene, light_.data(), direction, -1, factor.c, n);
  }
  float* const weight[3] = {samples.weight_r, samples.weight_g, samples.weight_b};
  kernels_.multiply_colours(weight, factor.c, weight, n);
}

}  // namespace yat
