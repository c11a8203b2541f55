#pragma once
// Which programs the textured materials of a scene need: one per shape of graph and material kind.

#include <cstdint>
#include <map>
#include <vector>

#include "scene/texture_graph.h"
#include "scene/texture_program.h"

namespace yat {

class TexturePrograms {
 public:
  /// Fields field .. field + channels - 1 of the material's record come from these channels.
  struct Binding {
    uint32_t field, channels;
    TextureGraph::Input input;
  };
  /// A bump or normal map; node kNone: none.
  struct Bump {
    TextureGraph::Input input;
    bool normal_map = false;
    float distance = .001f;  ///< between lookups of the height [scene units]
  };
  struct Ref {
    uint32_t program, row;
  };
  /// A material whose record is `parameters` but for the bindings.
  Ref add(MaterialKind kind, const std::vector<uint32_t>& parameters,
          const std::vector<Binding>& bindings, const Bump& bump, const TextureGraph& graph);
  /// A light whose bands are this colour.
  Ref add_light(TextureGraph::Input colour, const TextureGraph& graph) {
    return add(kNoMaterial, {}, {{0, 3, colour}}, {}, graph);
  }
  UvUse uv(uint32_t program) const { return programs_[program].uv; }

  /// Tables of all programs, once the scene's centre and all images are known.
  std::vector<TextureProgram> finish(const TextureGraph& graph, const glm::dvec3& center,
                                     const ImageStore& images) const;

 private:
  struct Step {
    StepKind kind;
    uint32_t variant;
    std::vector<std::array<uint16_t, 3>> in;
    std::vector<uint16_t> out;
  };
  struct Program {
    MaterialKind material;
    std::vector<Step> steps;
    std::vector<TextureProgram::Field> fields;
    std::vector<Step> bump_steps;
    std::array<uint32_t, 3> bump_columns{};
    bool normal_map = false;
    uint32_t columns = 0;
    UvUse uv = UvUse::kUnread;
    bool derivatives = false;
    std::vector<std::vector<uint32_t>> nodes;       ///< per row: the node of each step
    std::vector<std::vector<uint32_t>> bump_nodes;  ///< per row, likewise
    std::vector<std::vector<uint32_t>> parameters;  ///< per row: the material's record
    std::vector<float> bump_distance;               ///< per row
  };
  static Program make_program(MaterialKind kind, const std::vector<Binding>& bindings,
                              const Bump& bump, const std::vector<uint32_t>& nodes,
                              const std::vector<uint32_t>& bump_nodes, const TextureGraph& graph);

  std::vector<Program> programs_;
  std::map<std::vector<uint32_t>, uint32_t> known_;
};

}  // namespace yat
