#include "wavefront/textures.h"

#include <algorithm>

namespace yat {

TextureStage::TextureStage(std::span<const TextureProgram> programs, const BandBasis& basis,
                           const KernelTable& kernels, uint32_t chunk_rows)
    : kernels_(kernels), stride_(padded_rows(chunk_rows) + kRowPad), basis_(basis) {
  uint32_t most = 0;
  bool derivatives = false, bumps = false;
  for (const TextureProgram& program : programs) {
    most = std::max(most, program.columns + program_record(program.material).fields);
    derivatives = derivatives || program.derivatives;
    bumps = bumps || !program.bump_steps.empty();
  }
  if (!most) return;
  columns_.resize(size_t(most) * stride_);
  if (derivatives) derivatives_.resize(chunk_rows);
  if (bumps) {
    moved_.resize(size_t(5) * stride_);
    heights_.resize(size_t(3) * stride_);
  }

  programs_.reserve(programs.size());
  for (const TextureProgram& source : programs) {
    Program& program = programs_.emplace_back();
    program.source = &source;
    for (const TextureStep& step : source.steps) program.steps.push_back(view_of(step));
    for (const TextureStep& step : source.bump_steps) program.bump_steps.push_back(view_of(step));
    const RecordSize record = program_record(source.material);
    program.row_words = record.row_words;
    program.fields.resize(record.fields);
    program.spread.resize(record.fields);
    for (const TextureProgram::Field& field : source.fields)
      program.fields[field.field] = reinterpret_cast<const uint32_t*>(column(field.column));
    program.spreads = false;
    uint32_t next = source.columns;
    for (uint32_t f = 0; f < record.fields; ++f) {
      if (program.fields[f]) continue;
      program.fields[f] = program.spread[f] = reinterpret_cast<uint32_t*>(column(next++));
      program.spreads = true;
    }
  }
}

TextureStepView TextureStage::view_of(const TextureStep& step) {
  TextureStepView view;
  view.variant = step.variant;
  view.constants = {step.constants.data(), step.rows, nullptr};
  for (size_t k = 0; k < step.in.size(); ++k)
    for (size_t c = 0; c < 3; ++c) view.in[k][c] = column(step.in[k][c]);
  for (size_t k = 0; k < step.out.size(); ++k) view.out[k] = column(step.out[k]);
  return view;
}

void TextureStage::bend(const Program& program, const Chunk& chunk, TextureInput& input) {
  const TextureProgram& source = *program.source;
  const ParameterView rows{source.bump.data(), source.rows, nullptr};
  const auto run = [&] {
    for (size_t s = 0; s < program.bump_steps.size(); ++s)
      kernels_.run_texture[uint32_t(source.bump_steps[s].kind)](input, program.bump_steps[s],
                                                                chunk.n);
  };
  const auto& at = source.bump_columns;
  run();
  if (source.normal_map) {
    kernels_.map_normals(chunk.surfaces, input.derivatives, rows, column(at[0]), column(at[1]),
                         column(at[2]), chunk.n);
    return;
  }
  float* const heights[3] = {heights_.data(), heights_.data() + stride_,
                             heights_.data() + 2 * size_t(stride_)};
  std::copy_n(column(at[0]), chunk.n, heights[0]);
  const Surface<ConstColumn> here = input.surfaces;
  Surface<Column> moved = chunk.surfaces;
  float** const to[5] = {&moved.pos_x, &moved.pos_y, &moved.pos_z, &moved.u, &moved.v};
  for (uint32_t k = 0; k < 5; ++k) *to[k] = moved_.data() + size_t(k) * stride_;
  for (uint32_t axis = 0; axis < 2; ++axis) {
    kernels_.move_surfaces(here, input.derivatives, rows, axis, moved, chunk.n);
    input.surfaces = as_const_columns<Surface>(moved);
    run();
    std::copy_n(column(at[0]), chunk.n, heights[axis + 1]);
  }
  input.surfaces = here;
  kernels_.bend_normals(chunk.surfaces, input.derivatives, rows, heights[0], heights[1], heights[2],
                        chunk.n);
}

ParameterView TextureStage::run(uint32_t number, const Chunk& chunk) {
  const Program& program = programs_[number];
  const TextureProgram& source = *program.source;
  TextureInput input{as_const_columns<Surface>(chunk.surfaces), {}, chunk.scene.texels, basis_};
  if (source.derivatives) {
    kernels_.make_derivatives(chunk.scene, chunk.geometry, chunk.order, chunk.instance,
                              input.surfaces, chunk.paths, derivatives_.columns(), chunk.n);
    input.derivatives = derivatives_.view();
  }
  if (!program.bump_steps.empty()) bend(program, chunk, input);
  return run_steps(program, input, chunk.n);
}

ParameterView TextureStage::run(uint32_t number, const Surface<ConstColumn>& points,
                                const SurfaceDerivatives<ConstColumn>& derivatives,
                                const TexelView& texels, uint32_t n) {
  return run_steps(programs_[number], {points, derivatives, texels, basis_}, n);
}

ParameterView TextureStage::run_steps(const Program& program, const TextureInput& input,
                                      uint32_t n) {
  const TextureProgram& source = *program.source;
  const ParameterView rows{source.parameters.data(), source.rows, nullptr};
  if (source.fields.empty()) return rows;
  for (size_t s = 0; s < program.steps.size(); ++s)
    kernels_.run_texture[uint32_t(source.steps[s].kind)](input, program.steps[s], n);
  if (program.spreads)
    kernels_.spread_parameters(rows, program.row_words, input.surfaces.parameter,
                               program.spread.data(), uint32_t(program.spread.size()), n);
  return {rows.words, rows.count, program.fields.data()};
}

}  // namespace yat
