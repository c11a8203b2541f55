#include "scene/texture_graph.h"

#include <algorithm>
#include <bit>

#include "kernels/textures/image.h"

namespace yat {

uint32_t TextureGraph::add(Node node) {
  std::vector<uint64_t> key = {uint64_t(node.kind), node.variant, node.outputs};
  key.insert(key.end(), node.constants.begin(), node.constants.end());
  for (const Input& in : node.inputs) key.push_back(uint64_t(in.node) << 32 | in.channel);
  for (const double d : node.world_rows) key.push_back(std::bit_cast<uint64_t>(d));
  const auto [place, is_new] = known_.try_emplace(std::move(key), uint32_t(nodes_.size()));
  if (is_new) nodes_.push_back(std::move(node));
  return place->second;
}

std::vector<uint32_t> TextureGraph::closure(std::span<const uint32_t> nodes) const {
  std::vector<bool> wanted(nodes_.size());
  for (const uint32_t n : nodes) wanted[n] = true;
  std::vector<uint32_t> found;
  for (auto n = uint32_t(nodes_.size()); n-- > 0;) {
    if (!wanted[n]) continue;
    found.push_back(n);
    for (const Input& in : nodes_[n].inputs) wanted[in.node] = true;
  }
  std::reverse(found.begin(), found.end());
  return found;
}

std::vector<uint32_t> TextureGraph::resolved(uint32_t number, const glm::dvec3& center,
                                             const ImageStore& images) const {
  const Node& node = nodes_[number];
  std::vector<uint32_t> words = node.constants;
  for (size_t row = 0; row + 3 < node.world_rows.size(); row += 4) {
    const double* r = &node.world_rows[row];
    for (size_t k = 0; k < 3; ++k) words[row + k] = std::bit_cast<uint32_t>(float(r[k]));
    const double offset = r[0] * center.x + r[1] * center.y + r[2] * center.z + r[3];
    words[row + 3] = std::bit_cast<uint32_t>(float(offset));
  }
  if (node.kind == StepKind::kImage) {
    ImageParameters<Value> p{};
    for_each_field([&](auto i, auto& field) { std::memcpy(&field, &words[i], 4); }, p);
    const ImageStore::Place place = images.place(p.image);
    p.texels = place.texels;
    p.width = place.width;
    p.height = place.height;
    p.last_level = float(place.levels - 1);
    for_each_field([&](auto i, const auto& field) { std::memcpy(&words[i], &field, 4); }, p);
  }
  return words;
}

}  // namespace yat
