#pragma once
// The parts of compile_scene(), one per kind of statement. Each reads its plugins through
// Parameters, so that diagnostics are alike everywhere.

#include <compare>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/analytic_shape.h"
#include "scene/compile.h"
#include "scene/compile_programs.h"
#include "scene/compile_textures.h"
#include "scene/description.h"
#include "scene/parameters.h"

namespace yat {

struct LightTables;
class EmissionCompiler;

/// CIE XYZ -> linear Rec.709 (lxs section 9).
inline glm::dvec3 xyz_to_rec709(const glm::dvec3& c) {
  return {3.24097 * c.x - 1.53738 * c.y - .49861 * c.z,
          -.96924 * c.x + 1.87597 * c.y + .04156 * c.z,
          .05563 * c.x - .20398 * c.y + 1.05697 * c.z};
}

// ---- Rendering options (lxs 3, 4) ------------------------------------------------------------

FilmSettings compile_film(const Description& description, const CompileOptions& options,
                          Diagnostics& diagnostics);

struct FilterTables {
  FilterKind kind = FilterKind::kBox;
  float radius_x = .5f, radius_y = .5f;            ///< [pixels]
  std::vector<float> quantile_x, quantile_y;       ///< kProduct
  std::vector<float> marginal, conditional, sign;  ///< kTable
};
/// The tables of FilterView for the statement; without one, LuxRender's default (mitchell).
FilterTables compile_filter(const std::optional<Plugin>& filter, Diagnostics& diagnostics);

struct CameraSetup {
  CameraView view{};
  CameraKind kind = CameraKind::kPinhole;
  bool autofocus = false;  ///< the focal distance is to be found in the scene
};
CameraSetup compile_camera(const Description& description, const FilmSettings& film,
                           const glm::dvec3& center, Diagnostics& diagnostics);
/// World position of the camera; the origin if its transform cannot be inverted.
glm::dvec3 camera_position(const Description& description);

struct IntegratorSettings {
  int32_t max_depth = 16;
  bool direct_only = false;
  bool show_environment = true;  ///< to camera rays
};
IntegratorSettings compile_integrator(const std::optional<Plugin>& integrator,
                                      Diagnostics& diagnostics);

// ---- Textures and materials (lxs 7, 8) -------------------------------------------------------

/// A colour parameter that may be a texture. One that varies over the surface is noted in
/// textures.varying(), for whoever binds it to the material's fields; returned is then about its
/// mean.
glm::dvec3 color_parameter(Parameters& parameters, std::string_view name,
                           const glm::dvec3& fallback, TextureCompiler& textures);
/// The same for a float parameter.
double float_parameter(Parameters& parameters, std::string_view name, double fallback,
                       TextureCompiler& textures);
/// The same for lights, over which nothing can vary: about the mean then, with a warning.
glm::dvec3 color_parameter(Parameters& parameters, std::string_view name,
                           const glm::dvec3& fallback, const Description& description);
double float_parameter(Parameters& parameters, std::string_view name, double fallback,
                       const Description& description);

/// Where a shape's material is in the parameter tables.
struct MaterialRef {
  MaterialKind kind = MaterialKind::kMatte;
  uint32_t row = 0;           ///< of the kind's table, or of the program's
  uint32_t program = kNone;   ///< row of Scene::programs, or kNone: nothing is textured
  UvUse uv = UvUse::kUnread;  ///< what its textures want of the shape's texture coordinates
  bool tangents = false;      ///< looks different from other sides: needs dp/du
  uint32_t split = kNone;     ///< row of Scene::splits
  Passing passing = Passing::kSolid;
  uint32_t id = 0;  ///< SurfaceIds::material
  /// About what it gives back of the light that it gets, in bands; 1 where nothing is known.
  glm::vec3 albedo{1.f};
};

// ---- Shapes (lxs 5) --------------------------------------------------------------------------

/// A triangle mesh in object space. Spans are into the description, or into `owned`.
struct Mesh {
  std::span<const float> positions;  ///< 3 per vertex
  std::span<const float> normals;    ///< 3 per vertex, or empty: flat
  std::span<const float> uvs;        ///< 2 per vertex, or empty
  std::vector<uint32_t> indices;     ///< 3 per triangle, all below the vertex count
  std::vector<float> owned_positions, owned_normals, owned_uvs;
  bool normals_from_file = false;  ///< bad ones are worth a warning
  Mesh() = default;
  Mesh(Mesh&&) = default;  // spans into `owned` stay right when moved, not when copied
  Mesh& operator=(Mesh&&) = default;
  uint32_t vertices() const { return uint32_t(positions.size() / 3); }
  uint32_t triangles() const { return uint32_t(indices.size() / 3); }
};

/// A shape ready to be placed: exactly one of the four.
struct CompiledShape {
  enum class Kind { kMesh, kSphere, kPlane, kAnalytic } kind = Kind::kMesh;
  Mesh mesh;
  double radius = 1;           ///< whole sphere, object space
  AnalyticShape analytic;      ///< also of a whole sphere: what it is where it is no more round
  glm::dvec3 normal{0, 0, 1};  ///< plane through the origin, object space
  std::optional<double> light_area;  ///< quadrics: the area of light power, object space (lxs 6.2)
};

/// Reads a shape's parameters. Empty when it cannot be used (the reason has been reported).
std::optional<CompiledShape> compile_shape(const ShapeEntry& shape, const Description& description,
                                           Diagnostics& diagnostics);

/// Finds a data file by lxs 1.5; empty if there is none. `loc` is the parameter that names it.
std::string find_data_file(const std::string& name, SourceLoc loc, const Description& description,
                           Diagnostics& diagnostics);

/// An affine map to world space and what follows from it.
struct Placement {
  glm::dmat3 linear{1.0};
  glm::dvec3 origin{0.0};
  glm::dmat3 normal_map{1.0};   ///< inverse transpose of linear
  bool mirrored = false;        ///< determinant < 0
  std::optional<double> scale;  ///< of a similarity transform
  glm::dvec3 point(const glm::dvec3& p) const { return linear * p + origin; }
};

/// Empty, and reported as an error, for a singular or non-finite matrix.
std::optional<Placement> make_placement(const Matrix& matrix, SourceLoc loc,
                                        const std::string& what, Diagnostics& diagnostics);

/// World-space area of a mesh; triangles with non-finite vertices count nothing.
double mesh_area(const Mesh& mesh, const Placement& placement);

/// How what a shape emits varies: over it, and with the direction (compile_emission.h).
struct EmissionLook {
  uint32_t program = kNone;       ///< row of Scene::emission_programs
  uint32_t parameter = 0;         ///< row of the program's constants
  UvUse uv = UvUse::kUnread;      ///< what the program wants of the shape's texture coordinates
  uint32_t distribution = kNone;  ///< of directions: EmissionCompiler's
  bool varies() const { return program != kNone || distribution != kNone; }
};
/// Whether a shape emits, and how: what bins distinguish.
struct Shining {
  bool emissive = false;
  uint32_t program = kNone;
  bool by_direction = false;
};

/// One copy of a shape in the world.
struct PlacedShape {
  const CompiledShape* shape = nullptr;
  SourceLoc loc;
  Placement placement;
  bool reverse_orientation = false;
  MaterialRef material;
  uint32_t object_id = 0;    ///< SurfaceIds::object
  glm::dvec3 radiance{0.0};  ///< bands; > 0 in one of them: emissive
  EmissionLook look = {};    ///< of it
  Shining shining() const {
    return emissive() ? Shining{true, look.program, look.distribution != kNone} : Shining{};
  }
  SurfaceIds ids() const { return {object_id, material.id}; }
  bool emissive() const { return radiance.x > 0 || radiance.y > 0 || radiance.z > 0; }
};

struct Bounds;
/// Grows `bounds` by the finite points of the shape; planes have none.
void add_to_bounds(const PlacedShape& placed, Bounds& bounds);

struct MeshRows {
  bool flat = true;       ///< no vertex rows were appended: the face's normal is all there is
  uint32_t left_out = 0;  ///< triangles without area or with a vertex that is not finite
};
/// Appends the triangles of a placed mesh, relative to `center`, their outside by lxs 2.5, and
/// their vertex rows unless the mesh turns out flat; or are kept for their
/// texture coordinates. parameter = 0, light = kNone.
MeshRows add_mesh_rows(const PlacedShape& placed, const Mesh& mesh, const glm::dvec3& center,
                       UvUse uv, std::vector<TriangleRow<Value>>& triangles,
                       std::vector<TriangleVertexRow<Value>>& vertices, Diagnostics& diagnostics);
/// The light that a triangle is.
LightRow<Value> triangle_light(const TriangleRow<Value>& row, const glm::dvec3& radiance);

/// Whether a bin's primitives are in the scene's own tables, or in shared objects.
enum class Placing : uint32_t { kOnce, kByInstance };

/// What tells bins apart, in the order in which they are numbered.
struct BinKey {
  bool lasting = false;  ///< first: those that paths at their last vertex still visit are the last
  Placing placing = Placing::kOnce;
  GeometryKind geometry = GeometryKind::kTriangleFlat;
  MaterialKind material = MaterialKind::kMatte;
  uint32_t split = kNone;
  Passing passing = Passing::kSolid;
  uint32_t program = kNone;  ///< of textures
  bool emissive = false;
  bool tangents = false;
  uint32_t emission_program = kNone;  ///< of textures
  bool emission_by_direction = false;
  static BinKey of(GeometryKind geometry, const MaterialRef& material, const Shining& shining,
                   Placing placing);
  auto operator<=>(const BinKey&) const = default;
};

/// The bins of a scene: in the order of their keys, so that they do not depend on the order of
/// shapes.
class BinKeys {
 public:
  void add(const BinKey& key) { bin_of_key_.emplace(key, 0); }
  /// Writes scene.bins (no primitives counted yet) and first_lasting_bin. An error if there are
  /// more than kMaxBins.
  void number(Scene& scene, Diagnostics& diagnostics);
  uint32_t bin(const BinKey& key) const { return bin_of_key_.at(key); }

 private:
  std::map<BinKey, uint32_t> bin_of_key_;
};

/// Rows of LightView::emission under construction, of the lights that do not shine evenly; see
/// compile_emission.cpp.
class EmissionRows {
 public:
  /// prim: as in Hit. Shapes other than triangles have no distribution of directions.
  void add(uint32_t light, const EmissionLook& look, uint32_t prim);
  /// vertices: with the texture coordinates, or null; mirrored: the light's b and c are those of
  /// the vertices 2 and 1.
  void add_triangle(uint32_t light, const EmissionLook& look, uint32_t prim,
                    const LightRow<Value>& triangle, const TriangleVertexRow<Value>* vertices,
                    bool mirrored);
  /// Writes scene.emission, a row per light, and the maps of directions into the tables.
  void finish(uint32_t lights, const EmissionCompiler& emission, LightTables& tables,
              Scene& scene) const;

 private:
  struct Entry {
    uint32_t light;
    EmissionRow<Value> row;
    uint32_t distribution;
    glm::dmat3 axes;  ///< of the map's own space in the scene, columns
  };
  std::vector<Entry> entries_;
};

/// Collects rows in scene space; see compile_geometry.cpp.
class GeometryRows {
 public:
  /// ids: whether the scene gets prim_ids; rectangles: whether pairs of triangles shine as one.
  GeometryRows(const glm::dvec3& center, bool ids, bool rectangles, Diagnostics& diagnostics)
      : center_(center), ids_(ids), rectangles_(rectangles), diagnostics_(diagnostics) {}
  void add(const PlacedShape& placed);
  void add_keys(BinKeys& keys) const;
  /// Writes tables and the tree's input into the scene. `occludes` stays empty if all do.
  void finish(const BinKeys& keys, Scene& scene, std::vector<uint8_t>& occludes);
  std::vector<LightRow<Value>>& lights() { return lights_; }
  EmissionRows& emission() { return emission_; }

 private:
  void add_mesh(const PlacedShape& placed, const Mesh& mesh);
  void add_sphere(const PlacedShape& placed);
  void add_plane(const PlacedShape& placed);
  void add_shape(const PlacedShape& placed);
  /// The other shapes in the order of their table: by kind, veils last, as they came. Writes the
  /// ranges into the scene, and the lights' rows.
  std::vector<uint32_t> order_shapes(Scene& scene);
  /// Trees over spheres and shapes where there are many; the orders are those of the tables.
  void build_shape_trees(const std::vector<uint32_t>& sphere_order,
                         const std::vector<uint32_t>& shape_order, Scene& scene) const;

  /// Rows [first, ..) of a primitive kind that share a bin.
  struct Run {
    uint32_t first;
    BinKey key;
    SurfaceIds ids;
  };
  glm::dvec3 center_;
  bool ids_, rectangles_;
  Diagnostics& diagnostics_;
  std::vector<TriangleRow<Value>> triangles_;
  std::vector<Run> triangle_runs_;
  std::vector<TriangleVertexRow<Value>> vertices_;  ///< of runs with kTriangleVertex, in order
  std::vector<SphereRow<Value>> spheres_;
  std::vector<PlaneRow<Value>> planes_;
  std::vector<ShapeRow<Value>> analytic_;
  std::vector<BinKey> sphere_keys_, plane_keys_, analytic_keys_;
  std::vector<SurfaceIds> sphere_ids_, plane_ids_, analytic_ids_;
  std::vector<TopBox> sphere_boxes_, analytic_boxes_;  ///< what rays meet lies within
  std::vector<LightRow<Value>> lights_;
  EmissionRows emission_;
  std::map<uint32_t, EmissionLook> shape_looks_;  ///< of lights that are no triangles
  uint32_t degenerate_ = 0;
};

/// The tree of the triangles that are veils, once prim_bin is known.
void build_veils(const TreeOptions& options, ThreadPool& pool, Scene& scene);

// ---- Lights (lxs 6) --------------------------------------------------------------------------

/// What an AreaLightSource statement asks for.
struct AreaLight {
  glm::dvec3 color{1.0};  ///< L * gain in bands, negative channels of L clamped to 0
  double luminance = 1;   ///< Y(L), gain left out
  double power = 100, efficacy = 17;
  uint32_t samples = 1;  ///< nsamples
  EmissionLook look = {};
  SourceLoc loc;
};
/// Empty if the statement cannot be used (reported).
std::optional<AreaLight> compile_area_light(const AreaLightEntry& entry,
                                            const Description& description,
                                            EmissionCompiler& emission, Diagnostics& diagnostics);
/// Radiance in bands by the power rule of lxs 6.2 for a shape of this area [m2].
glm::dvec3 area_light_radiance(const AreaLight& light, double area, Diagnostics& diagnostics);

/// Box around everything finite.
struct Bounds {
  glm::dvec3 min{1e300}, max{-1e300};
  void add(const glm::dvec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  bool empty() const { return !(min.x <= max.x); }
  glm::dvec3 center() const { return .5 * min + .5 * max; }
  double radius() const { return empty() ? 0 : .5 * glm::length(max - min); }
};

/// What YART's path tracer makes of a point light: a sphere of radius .05 at the origin of its CTM,
/// whatever "from" says (lxs 12.5).
struct SphereLamp {
  static constexpr double kRadius = .05;
  glm::dvec3 center{0.0};    ///< world
  glm::dvec3 radiance{0.0};  ///< bands
  uint32_t samples = 1;      ///< nsamples
};
/// Empty for other lights.
std::optional<SphereLamp> compile_sphere_lamp(const LightEntry& entry,
                                              const Description& description,
                                              const ColourModel& colour, Diagnostics& diagnostics);

/// Appends the rows of a LightSource, and what they need in tables.
void compile_light(const LightEntry& entry, const Description& description,
                   const ColourModel& colour, const glm::dvec3& center, LightTables& tables,
                   std::vector<LightRow<Value>>& rows, Diagnostics& diagnostics);

/// Emitted power [W, luminance-weighted] of a light row: what it is chosen by.
double light_power(const LightRow<Value>& light, const ColourModel& colour, double scene_radius);

/// Fills the scene's light tables (its colour model and radius must be set): what lights are chosen
/// by, maps.
void finish_lights(std::vector<LightRow<Value>> rows, const LightTables& tables,
                   const CompileOptions& options, ThreadPool& pool, Scene& scene);

}  // namespace yat
