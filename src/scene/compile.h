#pragma once
// Description -> Scene: everything that rendering needs, in columns.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "film/settings.h"
#include "kernels/table.h"
#include "scene/colour_model.h"
#include "scene/compiled.h"
#include "scene/description.h"
#include "scene/image_store.h"
#include "scene/instances.h"
#include "scene/light_tree.h"
#include "scene/texture_program.h"
#include "scene/tree_build.h"

namespace yat {

/// What becomes of light that meets a surface and is not scattered.
enum class Passing : uint32_t {
  kSolid,  ///< it stops
  kVeil,   ///< a part of it goes on
  kAll,    ///< it goes on: there is no surface for it
};

/// A material but for its parameters: what takes one way through the stages.
struct MaterialForm {
  MaterialKind kind = MaterialKind::kMatte;
  uint32_t split = kNone;    ///< row of Scene::splits, if the kind is made of others
  uint32_t program = kNone;  ///< row of Scene::programs, if textures make its parameters
  auto operator<=>(const MaterialForm&) const = default;
};
/// What a material is made of. Its record holds the children's rows.
struct MaterialSplit {
  MaterialForm child[2];
  bool turned[2] = {};  ///< what is the surface's outside is the child's inside
  /// Of a mixture: the children give back unlike amounts of light, which they are chosen by.
  bool unequal = false;
  auto operator<=>(const MaterialSplit&) const = default;
};
/// Materials may be made of others this many times over.
inline constexpr uint32_t kMaxSplitDepth = 8;

/// Rows of the scene that take the same way through the stages. Bin 0 is for paths that have ended.
struct Bin {
  GeometryKind geometry = GeometryKind::kTriangleFlat;
  MaterialKind material = MaterialKind::kMatte;
  bool emissive = false;
  bool tangents = false;    ///< the material needs dp/du
  bool instanced = false;   ///< triangles of shared objects; else rows of the scene's own tables
  uint64_t primitives = 0;  ///< in this bin; those of an object count once per instance
  uint32_t split = kNone;   ///< row of Scene::splits, if the material is made of others
  Passing passing = Passing::kSolid;
  uint32_t program = kNone;  ///< row of Scene::programs: what makes the material's parameters
  uint32_t emission_program = kNone;  ///< row of Scene::emission_programs: what emission varies by
  bool emission_by_direction = false;
  bool emission_varies() const { return emission_program != kNone || emission_by_direction; }
};
inline constexpr uint32_t kMaxBins = 1024;  ///< in practice below 40

/// What trying a shape with every ray costs, in halves of a sphere. Shapes that together cost more
/// than kTriedPrice have a tree (docs/decisions.md).
inline constexpr uint32_t kSpherePrice = 2;
inline constexpr uint32_t kShapePrice[kShapeKinds] = {10, 5, 50};  ///< by ShapeKind
inline constexpr uint32_t kTriedPrice = 40;

/// --tree: which tree over the triangles.
enum class TreeChoice {
  kFromScene,  ///< a strict kd-tree where the scene says Accelerator "kdtree", else the best
  kAuto,       ///< the best for the triangles
  kKd,         ///< a strict kd-tree
};
/// What becomes of ObjectInstance.
enum class InstanceMode {
  kAuto,   ///< as kSharedTriangles says
  kCopy,   ///< every instance is a copy in the scene's own tables
  kShare,  ///< every object that can be is stored once
};
/// --energy-compensation: whether the light that facets of a rough lobe throw onto each other is
/// added back. Only lobes that are not LuxRender's have a form with it: its own are what scenes
/// were made for (docs/decisions.md).
enum class EnergyCompensation { kAuto, kOn, kOff };  // kAuto: as kOn
/// An object with more than one instance is stored once if it has this many triangles, from which
/// on rays find it as soon as they find copies (docs/decisions.md), ...
inline constexpr uint64_t kSharedTriangles = 1024;
/// ... or if its copies would hold more than this together, some 40 MB.
inline constexpr uint64_t kCopiedTriangles = 1 << 18;

/// --light-choice: how a surface chooses the light that it asks for.
enum class LightChoosing {
  kAuto,     ///< by the tree from kTreeLights on; else by power, half or more to those with a
             ///< place; two lights of weight, one a sky or a sun, are both asked; even skies are
             ///< not, where others are or all is matte
  kPower,    ///< by power alone
  kTree,     ///< by power, distance and direction, if two lights have a place
  kUniform,  ///< each alike: what the others are proved against
  kAll,      ///< all are asked, up to kMostAskedLights of them; else as kAuto
};
/// Lights that a surface may ask: each is a shadow ray, and memory for a batch of them.
inline constexpr uint32_t kMostAskedLights = 8;
/// Lights with a place from which on a tree over them pays (docs/decisions.md).
inline constexpr uint32_t kTreeLights = 4;

/// Numbers by which compositors tell things apart.
struct SurfaceIds {
  /// Of the Shape statement, from 1 on; of what an object placed: the number of Shape statements
  /// and that of the ObjectInstance. 0: a lamp without a shape.
  uint32_t object = 0;
  uint32_t material = 0;  ///< of the material's statement, from 1 on; 0: the default
};

struct CompileOptions {
  uint32_t block_width = 16;  ///< lanes of the kernels that will run: width of the tree's blocks
  uint32_t width = 0, height = 0;  ///< --resolution; 0: as the film says
  float crop[4] = {0, 1, 0, 1};    ///< --crop, fractions x0 x1 y0 y1; used if crop_given
  bool crop_given = false;
  TreeChoice tree = TreeChoice::kFromScene;
  ColourMode colour = ColourMode::kBands;
  InstanceMode instances = InstanceMode::kAuto;
  LightChoosing light_choice = LightChoosing::kAuto;
  /// Whether kAuto may leave even skies to chance: not where light samples are all that finds it
  /// (LightSampling::kLights).
  bool leaves_even_skies = true;
  bool ids = false;      ///< for feature pictures: Scene::prim_ids and what instances have
  bool keep_uv = false;  ///< the same: texture coordinates also where nothing is textured
  /// Direct light, mirrors and glass alone, or all light; empty: as SurfaceIntegrator says.
  std::optional<bool> direct_only;
  uint64_t image_bytes = ImageStore::kDefaultLimit;  ///< --texture-cache: most memory for texels
  EnergyCompensation compensation = EnergyCompensation::kAuto;
};

/// The compiled scene: owns all columns.
struct Scene {
  glm::dvec3 center{0.0};  ///< world position of the scene-space origin
  float radius = 1;        ///< around the origin: holds the camera and all but planes [m]
  FilmSettings film;
  ColourModel colour = colour_model(ColourMode::kBands);  ///< of all colours below
  int32_t max_depth = 16;                                 ///< from SurfaceIntegrator
  bool direct_only = false;                               ///< SurfaceIntegrator "directlighting"
  bool show_environment = true;                           ///< to camera rays
  /// Sum of "nsamples" over the lights: shadow rays of YART's ray tracer at a hit.
  uint64_t light_samples = 0;
  uint64_t hash = 0;  ///< of the scene text

  RowTable<TriangleRow> triangles;
  RowTable<TriangleVertexRow> triangle_vertices;
  RowTable<SphereRow> spheres;
  RowTable<PlaneRow> planes;
  RowTable<ShapeRow> shapes;                       ///< by kind, veils last in each
  std::array<RowRange, kShapeKinds> shape_rows{};  ///< see ShapesView
  Tree shape_tree;                                 ///< over spheres and shapes, if many
  AlignedArray<uint32_t> prim_bin;
  std::vector<SurfaceIds> prim_ids;  ///< per primitive row, if asked for
  Tree tree;
  Tree veils;  ///< of the triangles that are veils, again
  /// Spheres and planes from these on are veils.
  uint32_t first_veil_sphere = 0, first_veil_plane = 0;
  std::array<RowRange, kShapeKinds> veil_shape_rows{};  ///< other shapes that are veils
  Tree veil_shape_tree;  ///< over spheres and shapes that are, if many
  Instances instances;
  RowTable<LightRow> lights;
  uint32_t asked_lights = 0;  ///< lights from this row on are found by chance alone: probability 0
  RowTable<EmissionRow> emission;  ///< per light, where that of any varies
  std::vector<TextureProgram> emission_programs;
  bool every_light = false;  ///< surfaces ask all lights, each of probability 1; else one of them
  RowTable<LightChoice> light_choice;
  LightTree light_tree;
  float light_tree_scale = 1, far_light = 0;  ///< LightTreeView::scale, far
  uint32_t first_far_light = 0;               ///< row of the first light without a place
  RowTable<LightMapRow> light_maps;
  RowTable<SkyRow> skies;
  AlignedArray<float> light_texels, light_cells;
  std::vector<MaterialSplit> splits;  ///< of children before their parents
  std::array<AlignedArray<uint32_t>, kMaterialKinds> parameters;  ///< row_words<its record> per row
  std::array<uint32_t, kMaterialKinds> parameter_rows{};
  std::vector<TextureProgram> programs;
  Texels texels;
  AlignedArray<float> filter_quantile_x, filter_quantile_y;
  AlignedArray<float> filter_marginal, filter_conditional, filter_sign;
  CameraView camera{};
  FilterView filter{};
  SamplerKind sampler = SamplerKind::kSobol;  ///< from the Sampler statement
  std::vector<Bin> bins;                      ///< bins[0] is the ended bin
  /// Bins from here on are visited by paths at their last vertex too: for the emission of the
  /// surface or, where it is see-through, of what lies behind.
  uint32_t first_lasting_bin = 1;
  uint32_t light_kinds = 0;
  uint32_t first_environment = 0;  ///< row of lights: from there on rays that miss find them
  bool all_occlude = true;
  CameraKind camera_kind = CameraKind::kPinhole;
  bool autofocus = false;  ///< focus_camera() (wavefront/focus.h) has to be called
  uint32_t shapes_read = 0, degenerate_triangles = 0;

  /// Views into this object; valid while it lives and is not moved.
  SceneView view() const;
  size_t bytes() const;
};

/// Builds the scene. Data files (PLY, images) are looked up from description.directory. Throws
/// Error when no picture can come of it (no film size, nothing to see and no light, ...);
/// everything else that cannot be used is reported once and left out or replaced as
/// docs/scene-format.md says.
Scene compile_scene(const Description& description, const CompileOptions& options, ThreadPool& pool,
                    Diagnostics& diagnostics);

}  // namespace yat
