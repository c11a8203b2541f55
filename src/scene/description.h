#pragma once
// What the scene file said: directives resolved to plain values, each with its place. Names of
// materials, textures and objects are resolved where they are used (a later redefinition does not
// change earlier users), transforms are multiplied out. Nothing is interpreted here: parameters are
// as written. print_description() writes it back as .lxs.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/dialect.h"

namespace yat {

enum class ParameterType {
  kInteger,
  kFloat,
  kBool,
  kPoint,
  kVector,
  kNormal,
  kColor,
  kString,
  kTexture
};

/// `"type name" value`.
struct Parameter {
  ParameterType type = ParameterType::kFloat;
  std::string name;
  SourceLoc loc;                     ///< of the quoted "type name"
  std::vector<float> floats;         ///< float, point, vector, normal, color
  std::vector<int32_t> integers;     ///< integer
  std::vector<std::string> strings;  ///< string; texture (one: its name); bool: "true" / "false"
  uint32_t texture = 0xffffffffu;    ///< texture: row of Description::textures, or kNone if unknown
  /// A string that names a material of which another is made: row of Description::materials, below
  /// that of the other; kNone if unknown.
  uint32_t material = 0xffffffffu;
  mutable bool used = false;  ///< set by whoever reads it; what stays unread is warned about
};

/// `Directive "type" parameters`.
struct Plugin {
  std::string type;
  SourceLoc loc;
  std::vector<Parameter> parameters;
  bool any_case = false;  ///< names of parameters match whatever their case (YART)
};

/// CTM at a directive: object or light space to world space.
using Matrix = glm::dmat4;

struct MaterialEntry {
  std::string name;  ///< empty for an inline `Material`
  Plugin plugin;
};

struct TextureEntry {
  std::string name;
  std::string kind;  ///< "float", "color", "fresnel"
  Plugin plugin;
  Matrix to_world{1.0};
};

/// MakeNamedVolume.
struct VolumeEntry {
  std::string name;
  Plugin plugin;
};

struct AreaLightEntry {
  Plugin plugin;
};

struct ShapeEntry {
  Plugin plugin;
  Matrix to_world{1.0};
  bool reverse_orientation = false;
  uint32_t material = 0xffffffffu;    ///< row of materials, or kNone: matte with Kd .9
  uint32_t area_light = 0xffffffffu;  ///< row of area_lights, or kNone
  uint32_t object = 0xffffffffu;      ///< row of objects it belongs to, or kNone: placed directly
  uint32_t interior = 0xffffffffu;    ///< row of volumes inside, or kNone
  uint32_t exterior = 0xffffffffu;    ///< row of volumes outside, or kNone
};

struct LightEntry {
  Plugin plugin;
  Matrix to_world{1.0};
};

struct ObjectEntry {
  std::string name;
  SourceLoc loc;
};

struct InstanceEntry {
  uint32_t object = 0xffffffffu;
  Matrix to_world{1.0};
  uint32_t material = 0xffffffffu;  ///< current material, which overrides the shapes' own; or kNone
  SourceLoc loc;
};

/// A sign that the scene may have been made for the other renderer.
struct DialectHint {
  SourceLoc loc;
  std::string message;
};

struct Description {
  std::string file;       ///< path of the main scene file
  std::string directory;  ///< its folder: data files are looked up from here (lxs 1.5)
  uint64_t hash = 0;      ///< FNV-1a of all scene text read, includes too
  Dialect dialect = Dialect::kLuxRender;   ///< rules by which it was read, and is to be compiled
  std::vector<DialectHint> dialect_hints;  ///< at most one of each sort and file

  std::optional<Plugin> camera, film, filter, sampler, integrator, volume_integrator, accelerator,
      renderer;
  Matrix world_to_camera{1.0};

  std::vector<MaterialEntry> materials;
  std::vector<TextureEntry> textures;
  std::vector<VolumeEntry> volumes;
  std::vector<AreaLightEntry> area_lights;
  std::vector<ShapeEntry> shapes;
  std::vector<LightEntry> lights;
  std::vector<ObjectEntry> objects;
  std::vector<InstanceEntry> instances;
};

}  // namespace yat
