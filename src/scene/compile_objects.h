#pragma once
// From shape statements to places: shapes once in the world, copies of objects, and objects that
// are stored once with their instances.
//
//   ShapePlacer ─> PlacedShape ──────────────────> GeometryRows ─> Scene's tables
//               └> SharedShapes ─> ObjectCompiler ─> Scene::instances

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scene/compile_emission.h"
#include "scene/compile_materials.h"
#include "scene/compile_parts.h"
#include "scene/tree_top.h"

namespace yat {

/// Objects to store once, and where they are.
struct SharedShapes {
  struct Object {
    uint32_t row = kNone;             ///< of Description::objects
    std::vector<PlacedShape> meshes;  ///< in object space, by their own transforms
  };
  struct Instance {
    uint32_t object = kNone;  ///< row of `objects`
    /// Row of `materials`: one material per mesh.
    uint32_t materials = kNone;
    Placement placement;
    SourceLoc loc;
    uint32_t id = 0;  ///< SurfaceIds::object
  };
  std::vector<Object> objects;
  std::vector<Instance> instances;
  std::vector<std::vector<MaterialRef>> materials;
};

/// Reads every shape that is seen, once, and decides what is copied and what is shared.
class ShapePlacer {
 public:
  ShapePlacer(const Description& description, const ColourModel& colour,
              const CompileOptions& options, Diagnostics& diagnostics);
  void place_all();
  /// Places a sphere that shines, of the default material.
  void place_lamp(const SphereLamp& lamp, SourceLoc loc);
  /// Sum of "nsamples" over the shapes that shine.
  uint64_t light_samples() const { return light_samples_; }
  const std::vector<PlacedShape>& placed() const { return placed_; }
  /// Points into this object.
  const SharedShapes& shared() const { return shared_; }
  MaterialCompiler& materials() { return materials_; }
  EmissionCompiler& emission() { return emission_; }
  uint32_t shapes_read() const { return shapes_read_; }

 private:
  /// A shape's own part, shared by all places it is put at.
  struct ShapeInfo {
    bool read = false;
    std::optional<CompiledShape> shape;
    glm::dvec3 radiance{0.0};  ///< bands, of its area light, by the area before instancing
    EmissionLook look = {};
    bool emissive() const { return radiance.x > 0 || radiance.y > 0 || radiance.z > 0; }
  };
  /// What a mesh is to rays: instances that differ in this cannot share a tree.
  enum class Presence : uint8_t { kAbsent, kSeeThrough, kVeil, kSolid };

  const ShapeInfo& info(uint32_t index);
  void make_light(const ShapeEntry& entry, ShapeInfo& info);
  void place(uint32_t index, const Matrix& to_world, uint32_t material, uint32_t object_id,
             SourceLoc loc);
  /// Of what the instance places.
  uint32_t object_id(const InstanceEntry& instance) const {
    return uint32_t(description_.shapes.size() +
                    size_t(&instance - description_.instances.data())) +
           1;
  }
  void copy(const InstanceEntry& instance, uint32_t index);
  void note_mirrored_light(const PlacedShape& placed, bool mirrored, SourceLoc loc);
  Presence presence(const ShapeInfo& info, const MaterialRef& material) const;
  /// The object's row in shared_, if its instances are to share it.
  std::optional<uint32_t> share(uint32_t object, uint64_t instances, const InstanceEntry& first);
  bool place_shared(uint32_t shared, const InstanceEntry& instance);
  bool is_mesh(uint32_t index) {
    return info(index).shape && info(index).shape->kind == CompiledShape::Kind::kMesh;
  }

  const Description& description_;
  const ColourModel& colour_;
  InstanceMode mode_;
  bool keep_uv_;
  Diagnostics& diagnostics_;
  MaterialCompiler materials_;
  EmissionCompiler emission_;
  std::vector<ShapeInfo> shapes_;  // never resized: PlacedShape points into it
  std::vector<std::optional<std::optional<AreaLight>>> area_lights_;  // outer: read yet?
  std::vector<std::vector<uint32_t>> members_;                        // shapes of each object
  std::vector<PlacedShape> placed_;
  SharedShapes shared_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> material_rows_;  // (shared, override) -> row
  std::optional<CompiledShape> lamp_sphere_;
  uint64_t light_samples_ = 0;
  uint64_t copied_ = 0;
  uint32_t shapes_read_ = 0;
};

/// Turns shared objects into rows and trees.
class ObjectCompiler {
 public:
  /// rectangles: as in GeometryRows.
  ObjectCompiler(const SharedShapes& shapes, const Description& description, bool rectangles,
                 Diagnostics& diagnostics)
      : shapes_(shapes),
        description_(description),
        rectangles_(rectangles),
        diagnostics_(diagnostics) {}
  /// Triangles and trees of the objects, each in a space about its own middle.
  void build(const TreeOptions& options, ThreadPool& pool, Scene& scene);
  void add_to_bounds(Bounds& bounds) const;
  void add_keys(BinKeys& keys) const;
  /// Rows of the instances, the lights that they are, and the top tree, once scene.center and the
  /// bins are known.
  /// ids: whether the instances get SurfaceIds.
  void finish(const BinKeys& keys, bool ids, Scene& scene, std::vector<LightRow<Value>>& lights,
              EmissionRows& emission);

 private:
  /// One shape of an object: which of the object's triangles, and what kind.
  struct Run {
    uint32_t first, end;  ///< triangles of the object
    GeometryKind geometry;
    Shining shining;
    uint32_t mesh;  ///< number among the object's meshes
    /// Emissive ones, counted from `first`: with which each is one light (rectangle_lights.h), or
    /// kNone. Empty where the emission varies.
    std::vector<uint32_t> partner = {};
  };
  struct Object {
    std::vector<Run> runs;
    uint32_t first_triangle = 0;
    glm::dvec3 center{0.0};     ///< of object space in the coordinates of the object's shapes
    std::vector<TopBox> boxes;  ///< about all triangles, object space; empty: nothing to see
    glm::dvec3 half{0.0};       ///< largest |coordinate| along each axis
    bool emissive = false;
  };
  /// An instance's map as kernels have it.
  struct Map {
    glm::dmat3 to_scene{1.0}, to_object{1.0};  ///< rounded to float, the inverse after it
    glm::dvec3 origin{0.0};                    ///< scene space, rounded to float
    /// What rounding both ways makes of one unit in each direction of scene space.
    glm::dvec3 growth{1.0};
  };
  static Map map_of(const Placement& placement, const glm::dvec3& object_center,
                    const glm::dvec3& scene_center);
  static TopBox placed_bounds(const Object& object, const Map& map);
  static InstanceRow<Value> row_of(const Object& object, const Map& map);
  /// The most that an instance's material wants of the mesh's texture coordinates.
  UvUse uv_use(uint32_t object, uint32_t mesh) const;
  BinKey key(const Run& run, const MaterialRef& material) const;
  /// For each triangle of a mesh that shines the one with which it is one light in all instances.
  std::vector<uint32_t> find_partners(uint32_t object, const PlacedShape& mesh,
                                      std::span<const TriangleRow<Value>> triangles) const;
  /// The light of a triangle and, unless it is null, its partner in an instance; the triangle's
  /// normal in the scene is that of `map`.
  static LightRow<Value> placed_light(const TriangleRow<Value>& triangle,
                                      const TriangleRow<Value>* partner, const Map& map,
                                      const glm::dvec3& radiance);
  /// Appends a row per shape; lights are not known yet. Returns the first.
  uint32_t add_shapes(const SharedShapes::Instance& instance, const BinKeys& keys,
                      std::vector<InstanceShapeRow<Value>>& shapes,
                      std::vector<uint32_t>& material_ids) const;
  /// Appends the instance's lights and writes where they begin into `shapes`, its rows.
  void add_lights(const SharedShapes::Instance& instance, const InstanceRow<Value>& row,
                  const Map& map, InstanceShapeRow<Value>* shapes, const Scene& scene,
                  std::vector<LightRow<Value>>& lights, EmissionRows& emission) const;

  const SharedShapes& shapes_;
  const Description& description_;
  bool rectangles_;
  Diagnostics& diagnostics_;
  std::vector<Object> objects_;
};

}  // namespace yat
