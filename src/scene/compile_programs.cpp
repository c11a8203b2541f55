#include "scene/compile_programs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "kernels/textures/image.h"

namespace yat {

namespace {

/// Columns in use, the lowest free one first, so that equal graphs get equal columns.
class ColumnPool {
 public:
  uint16_t take() {
    const auto free = std::find(used_.begin(), used_.end(), false);
    const auto column = uint16_t(free - used_.begin());
    if (free == used_.end())
      used_.push_back(true);
    else
      *free = true;
    return column;
  }
  void release(uint16_t column) { used_[column] = false; }
  uint32_t most() const { return uint32_t(used_.size()); }

 private:
  std::vector<bool> used_;
};

void add_to_key(std::vector<uint32_t>& key, const auto& steps) {
  key.push_back(uint32_t(steps.size()));
  for (const auto& step : steps) {
    key.insert(key.end(), {uint32_t(step.kind), step.variant, uint32_t(step.in.size()),
                           uint32_t(step.out.size())});
    for (const auto& in : step.in) key.insert(key.end(), in.begin(), in.end());
    key.insert(key.end(), step.out.begin(), step.out.end());
  }
}

/// What programs must have in common to be one.
std::vector<uint32_t> shape_key(const auto& program) {
  std::vector<uint32_t> key = {uint32_t(program.material), program.normal_map};
  key.insert(key.end(), program.bump_columns.begin(), program.bump_columns.end());
  add_to_key(key, program.steps);
  add_to_key(key, program.bump_steps);
  for (const auto& f : program.fields) key.insert(key.end(), {f.field, f.column});
  return key;
}

/// Steps of nodes under construction, and where their outputs lie.
struct Layout {
  const TextureGraph& graph;
  ColumnPool pool;
  std::map<uint32_t, std::vector<uint16_t>> columns;

  uint16_t channel(const TextureGraph::Input& in, uint32_t k) const {
    const std::vector<uint16_t>& of = columns.at(in.node);
    return of.size() == 1 ? of[0] : of[std::min<size_t>(in.channel + k, of.size() - 1)];
  }

  template <class Step>
  std::vector<Step> steps(const std::vector<uint32_t>& nodes, const std::vector<uint32_t>& kept) {
    // Where each node is read last; what is kept is needed until the end.
    std::map<uint32_t, size_t> last_use;
    for (size_t s = 0; s < nodes.size(); ++s)
      for (const TextureGraph::Input& in : graph[nodes[s]].inputs) last_use[in.node] = s;
    for (const uint32_t node : kept) last_use[node] = nodes.size();
    std::vector<Step> out;
    for (size_t s = 0; s < nodes.size(); ++s) {
      const TextureGraph::Node& node = graph[nodes[s]];
      Step step{node.kind, node.variant, {}, {}};
      for (const TextureGraph::Input& in : node.inputs)
        step.in.push_back({channel(in, 0), channel(in, 1), channel(in, 2)});
      // A kernel may write an output before it has read all inputs: they never share a column.
      for (uint32_t k = 0; k < node.outputs; ++k) step.out.push_back(pool.take());
      columns[nodes[s]] = step.out;
      for (size_t e = 0; e <= s; ++e) {
        const auto use = last_use.find(nodes[e]);
        if (use != last_use.end() && use->second == s)
          for (const uint16_t column : columns.at(nodes[e])) pool.release(column);
      }
      out.push_back(std::move(step));
    }
    return out;
  }
};

bool reads_uv(const TextureGraph::Node& node) {
  return node.kind == StepKind::kMapSurface ||
         (node.kind == StepKind::kMapSolid && (node.variant & 255) == 1);
}
bool has_footprint(const TextureGraph::Node& node) {
  const bool maps = node.kind == StepKind::kMapSurface || node.kind == StepKind::kMapRound ||
                    node.kind == StepKind::kMapPlanar;
  return maps && node.outputs == 4;
}

float as_number(uint32_t word) {
  return std::bit_cast<float>(word);
}

/// One texel of the finest image that is mapped by texture coordinates; 0 where there is none.
BumpParameters<Value> bump_parameters(const std::vector<uint32_t>& nodes, float distance,
                                      const TextureGraph& graph, const ImageStore& images) {
  BumpParameters<Value> p{distance, 0, 0};
  for (const uint32_t n : nodes) {
    const TextureGraph::Node& node = graph[n];
    if (node.kind != StepKind::kImage) continue;
    const TextureGraph::Node& map = graph[node.inputs[0].node];
    if (map.kind != StepKind::kMapSurface) continue;
    ImageParameters<Value> image{};
    for_each_field([&](auto i, auto& field) { std::memcpy(&field, &node.constants[i], 4); }, image);
    const ImageStore::Place place = images.place(image.image);
    const float s_scale = std::fabs(as_number(map.constants[0])),
                t_scale = std::fabs(as_number(map.constants[2]));
    const auto finer = [](float& step, float texels) {
      if (texels > 0 && (step == 0 || 1 / texels < step)) step = 1 / texels;
    };
    finer(p.step_u, float(place.width) * s_scale);
    finer(p.step_v, float(place.height) * t_scale);
  }
  return p;
}

}  // namespace

TexturePrograms::Program TexturePrograms::make_program(MaterialKind kind,
                                                       const std::vector<Binding>& bindings,
                                                       const Bump& bump,
                                                       const std::vector<uint32_t>& nodes,
                                                       const std::vector<uint32_t>& bump_nodes,
                                                       const TextureGraph& graph) {
  Program program;
  program.material = kind;
  std::vector<uint32_t> kept;
  for (const Binding& b : bindings) kept.push_back(b.input.node);
  Layout layout{graph, {}, {}};
  program.steps = layout.steps<Step>(nodes, kept);
  for (const Binding& b : bindings)
    for (uint32_t k = 0; k < b.channels; ++k)
      program.fields.push_back({b.field + k, layout.channel(b.input, k)});
  program.columns = layout.pool.most();
  if (bump.input.node != kNone) {
    Layout bumps{graph, {}, {}};
    program.bump_steps = bumps.steps<Step>(bump_nodes, {bump.input.node});
    for (uint32_t k = 0; k < 3; ++k) program.bump_columns[k] = bumps.channel(bump.input, k);
    program.normal_map = bump.normal_map;
    program.columns = std::max(program.columns, bumps.pool.most());
    program.uv = UvUse::kIfThere;
    program.derivatives = true;
  }
  for (const auto* list : {&nodes, &bump_nodes})
    for (const uint32_t n : *list) {
      if (reads_uv(graph[n])) program.uv = UvUse::kNeeded;
      program.derivatives = program.derivatives || has_footprint(graph[n]);
    }
  return program;
}

TexturePrograms::Ref TexturePrograms::add(MaterialKind kind,
                                          const std::vector<uint32_t>& parameters,
                                          const std::vector<Binding>& bindings, const Bump& bump,
                                          const TextureGraph& graph) {
  std::vector<uint32_t> outputs;
  for (const Binding& b : bindings) outputs.push_back(b.input.node);
  std::vector<uint32_t> nodes = graph.closure(outputs), bump_nodes;
  if (bump.input.node != kNone) bump_nodes = graph.closure(std::span(&bump.input.node, 1));
  Program program = make_program(kind, bindings, bump, nodes, bump_nodes, graph);
  const auto [place, is_new] = known_.try_emplace(shape_key(program), uint32_t(programs_.size()));
  if (is_new) programs_.push_back(std::move(program));
  Program& found = programs_[place->second];
  found.nodes.push_back(std::move(nodes));
  found.bump_nodes.push_back(std::move(bump_nodes));
  found.bump_distance.push_back(bump.distance);
  found.parameters.push_back(parameters);
  return {place->second, uint32_t(found.nodes.size() - 1)};
}

namespace {

/// Steps with their constants: nodes[row][step], the material's row first.
std::vector<TextureStep> finish_steps(const auto& steps,
                                      const std::vector<std::vector<uint32_t>>& nodes,
                                      const TextureGraph& graph, const glm::dvec3& center,
                                      const ImageStore& images) {
  std::vector<TextureStep> out;
  for (size_t s = 0; s < steps.size(); ++s) {
    TextureStep& step = out.emplace_back();
    step.kind = steps[s].kind;
    step.variant = steps[s].variant;
    step.in = steps[s].in;
    step.out = steps[s].out;
    std::vector<std::vector<uint32_t>> constants;
    for (const auto& of_row : nodes) constants.push_back(graph.resolved(of_row[s], center, images));
    const bool same = std::all_of(constants.begin(), constants.end(),
                                  [&](const auto& c) { return c == constants[0]; });
    step.rows = same ? 1 : uint32_t(nodes.size());
    const uint32_t row_words = parameters_size(step.kind).row_words;
    step.constants.resize(size_t(step.rows) * row_words);
    for (uint32_t r = 0; r < step.rows; ++r)
      std::copy(constants[r].begin(), constants[r].end(),
                step.constants.data() + size_t(r) * row_words);
  }
  return out;
}

}  // namespace

std::vector<TextureProgram> TexturePrograms::finish(const TextureGraph& graph,
                                                    const glm::dvec3& center,
                                                    const ImageStore& images) const {
  std::vector<TextureProgram> out;
  for (const Program& program : programs_) {
    TextureProgram& p = out.emplace_back();
    p.material = program.material;
    p.fields = program.fields;
    p.bump_columns = program.bump_columns;
    p.normal_map = program.normal_map;
    p.columns = program.columns;
    p.derivatives = program.derivatives;
    p.uv = program.uv;
    p.rows = uint32_t(program.nodes.size());
    const RecordSize record = program_record(program.material);
    p.parameters.resize(size_t(p.rows) * record.row_words);
    for (uint32_t r = 0; r < p.rows; ++r)
      std::copy(program.parameters[r].begin(), program.parameters[r].end(),
                p.parameters.data() + size_t(r) * record.row_words);
    p.steps = finish_steps(program.steps, program.nodes, graph, center, images);
    p.bump_steps = finish_steps(program.bump_steps, program.bump_nodes, graph, center, images);
    if (p.bump_steps.empty()) continue;
    p.bump.resize(size_t(p.rows) * row_words<BumpParameters>);
    for (uint32_t r = 0; r < p.rows; ++r) {
      const BumpParameters<Value> row =
          bump_parameters(program.bump_nodes[r], program.bump_distance[r], graph, images);
      for_each_field(
          [&](auto i, const auto& field) {
            std::memcpy(p.bump.data() + size_t(r) * row_words<BumpParameters> + i, &field, 4);
          },
          row);
    }
  }
  return out;
}

size_t TextureProgram::bytes() const {
  size_t sum = parameters.bytes() + bump.bytes();
  for (const auto* list : {&steps, &bump_steps})
    for (const TextureStep& step : *list) sum += step.constants.bytes();
  return sum;
}

}  // namespace yat
