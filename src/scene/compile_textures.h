#pragma once
// Texture statements (lxs 8) -> nodes of a graph, and constants.
//
// What does not vary over a surface is folded here, in doubles and linear Rec.709; what does
// becomes nodes, in which colours are transport bands: colours multiply as spectra do
// (colour_model.h).

#include <algorithm>
#include <deque>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/colour_model.h"
#include "scene/description.h"
#include "scene/image_store.h"
#include "scene/parameters.h"
#include "scene/texture_graph.h"

namespace yat {

/// Luminance of linear Rec.709, scaled so that (1,1,1) has 1 (lxs section 9).
inline double luminance(const glm::dvec3& c) {
  return .21264 * c.x + .71517 * c.y + .07219 * c.z;
}

/// What a texture is, before it is known which surface it is on.
struct TextureValue {
  bool colour = false;         ///< else a number, in all three of `constant`
  glm::dvec3 constant{0.};     ///< linear Rec.709; of what varies: about its mean
  uint32_t node = kNone;       ///< of what varies: bands, or a number
  double least = 0, most = 0;  ///< no channel leaves this range
  bool normal_map = false;     ///< a colour that says where normals point; for bumpmap only
  bool varies() const { return node != kNone; }

  static TextureValue number(double value) {
    return {false, glm::dvec3(value), kNone, value, value};
  }
  static TextureValue of_colour(const glm::dvec3& rgb) {
    return {true, rgb, kNone, std::min({rgb.x, rgb.y, rgb.z}), std::max({rgb.x, rgb.y, rgb.z})};
  }
};

/// What the textures' spectra are taken for.
enum class TextureUse { kReflectance, kLight };

class TextureCompiler {
 public:
  /// images: where to read images to, instead of a store of its own of `image_bytes`.
  TextureCompiler(const Description& description, const ColourModel& colour,
                  Diagnostics& diagnostics, uint64_t image_bytes = ImageStore::kDefaultLimit,
                  TextureUse use = TextureUse::kReflectance, ImageStore* images = nullptr)
      : use_(use),
        description_(description),
        colour_(colour),
        diagnostics_(diagnostics),
        own_images_(image_bytes),
        images_(images ? *images : own_images_),
        done_(description.textures.size()) {}
  TextureCompiler(const TextureCompiler&) = delete;
  TextureCompiler& operator=(const TextureCompiler&) = delete;

  /// The texture that a parameter names, as a colour or a number, converted with a warning where it
  /// is the other; empty if there is none.
  std::optional<TextureValue> texture(const Parameter& parameter, bool colour, int depth = 0);

  /// The texture of a "bumpmap": a height, or a normal map's colour as it is in the file.
  std::optional<TextureValue> bump(const Parameter& parameter);

  /// A parameter of a material or texture: texture or constant.
  TextureValue color(Parameters& parameters, std::string_view name, const glm::dvec3& fallback,
                     int depth = 0);
  TextureValue number(Parameters& parameters, std::string_view name, double fallback,
                      int depth = 0);

  /// The node of a value; constants become one.
  TextureGraph::Input node(const TextureValue& value);

  /// Parameters that were found to vary, since the list was last taken: whoever builds a material
  /// binds them.
  struct Varying {
    std::string_view parameter;
    TextureValue value;
  };
  std::vector<Varying>& varying() { return varying_; }

  /// YART maps textures by the space of the shape that they are on: object to world of the shape
  /// that is being compiled, and whether a texture has looked at it since it was last set.
  void set_shape(const Matrix& to_world) {
    shape_to_world_ = to_world;
    saw_shape_ = false;
  }
  const Matrix& shape_to_world() {
    saw_shape_ = true;
    return shape_to_world_;
  }
  bool saw_shape() const { return saw_shape_; }

  TextureUse use() const { return use_; }
  const Description& description() const { return description_; }
  const ColourModel& colour() const { return colour_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  TextureGraph& graph() { return graph_; }
  const TextureGraph& graph() const { return graph_; }
  ImageStore& images() { return images_; }

 private:
  std::optional<TextureValue> value(uint32_t row, int depth);

  TextureUse use_;
  const Description& description_;
  const ColourModel& colour_;
  Diagnostics& diagnostics_;
  TextureGraph graph_;
  ImageStore own_images_;
  ImageStore& images_;  ///< these, or those of another compiler
  std::vector<std::optional<std::optional<TextureValue>>> done_;  ///< outer: compiled yet?
  std::vector<Varying> varying_;
  Matrix shape_to_world_{1.};
  bool saw_shape_ = false;
};

/// What the compiler of a texture class works with.
struct TextureContext {
  TextureCompiler& textures;
  Parameters& p;
  const TextureEntry& entry;
  int depth;
  std::deque<std::string> names = {};  ///< made up while reading: Parameters keeps views of names
  bool colour() const { return entry.kind == "color"; }
  std::string_view keep(std::string name) { return names.emplace_back(std::move(name)); }
  /// An input of the texture's own kind.
  TextureValue input(std::string_view name, double fallback) {
    return colour() ? textures.color(p, name, glm::dvec3(fallback), depth + 1)
                    : textures.number(p, name, fallback, depth + 1);
  }
  TextureValue number(std::string_view name, double fallback) {
    return textures.number(p, name, fallback, depth + 1);
  }
  TextureGraph& graph() { return textures.graph(); }
  Diagnostics& diagnostics() { return textures.diagnostics(); }
  SourceLoc loc() const { return entry.plugin.loc; }
  /// "texture \"name\"", to begin a message with.
  std::string what() const { return "texture \"" + entry.name + "\""; }
};

/// s, t of a texture by its mapping (lxs 8.1); with the footprint in channels 2 and 3.
TextureGraph::Input map_2d(TextureContext& c, bool footprint);
/// x, y, z of a texture by its coordinates (lxs 8.2). own_scale: "scale" is the mapping's.
TextureGraph::Input map_3d(TextureContext& c, bool own_scale = true);

struct TextureClass {
  std::string_view name;
  TextureValue (*compile)(TextureContext&);
};
std::span<const TextureClass> arithmetic_textures();
std::span<const TextureClass> image_textures();
std::span<const TextureClass> pattern_textures();
std::span<const TextureClass> noise_textures();
std::span<const TextureClass> blender_textures();
std::span<const TextureClass> spectral_textures();

}  // namespace yat
