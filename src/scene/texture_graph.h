#pragma once
// Textures as an expression graph, while the scene is compiled. Nodes come in the order in which
// they can be evaluated; equal nodes are one node.

#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

#include "scene/image_store.h"
#include "scene/registry.h"
#include "soa/columns.h"

namespace yat {

class TextureGraph {
 public:
  /// Channels of a node from `channel` on. A node with one channel stands in for three equal ones.
  struct Input {
    uint32_t node = kNone;
    uint32_t channel = 0;
    bool operator==(const Input&) const = default;
  };
  struct Node {
    StepKind kind = StepKind::kConstant;
    uint32_t variant = 0;
    std::vector<uint32_t> constants;  ///< the record's fields
    std::vector<Input> inputs;
    uint32_t outputs = 1;
    /// World-space affine rows (x, y, z, offset) that the first constants are, once the place of
    /// the scene-space origin is known.
    std::vector<double> world_rows;
  };

  uint32_t add(Node node);

  template <template <template <class> class> class Record>
  uint32_t add(StepKind kind, uint32_t variant, const Record<Value>& constants,
               std::vector<Input> inputs, uint32_t outputs, std::vector<double> world_rows = {}) {
    Node node{kind,
              variant,
              std::vector<uint32_t>(field_count<Record>),
              std::move(inputs),
              outputs,
              std::move(world_rows)};
    for_each_field([&](auto i, const auto& field) { std::memcpy(&node.constants[i], &field, 4); },
                   constants);
    return add(std::move(node));
  }

  const Node& operator[](uint32_t node) const { return nodes_[node]; }
  /// `nodes` and all that they depend on, in order.
  std::vector<uint32_t> closure(std::span<const uint32_t> nodes) const;
  /// A node's constants as kernels read them: world-space rows about `center`, images where they
  /// lie now.
  std::vector<uint32_t> resolved(uint32_t node, const glm::dvec3& center,
                                 const ImageStore& images) const;

 private:
  std::vector<Node> nodes_;
  std::map<std::vector<uint64_t>, uint32_t> known_;
};

}  // namespace yat
