#pragma once
// What will run for a scene: decided once, from what the scene holds. A stage with no producer is
// not in the loop (invariant 7).

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/table.h"
#include "scene/compile.h"

namespace yat {

enum class Integrator { kPath, kDirect };

/// --light-sampling: the ways by which paths find light. All give the same picture on average, as
/// far as each way alone finds all of the light.
enum class LightSampling {
  kBoth,    ///< light samples and light met by chance, weighted against each other
  kLights,  ///< light samples; by chance only what the camera, mirrors and glass show
  kBsdf,    ///< by chance; light samples only of lights that no ray can meet
};
/// PlanOptions::roulette_depth for paths that go on to their last vertex.
inline constexpr uint32_t kNoRoulette = 0xffffffffu;
/// PlanOptions::shadow_roulette where all shadow rays are traced, and the value that is usual.
inline constexpr double kNoShadowRoulette = 0;
inline constexpr double kUsualShadowRoulette = .2;

/// What is done with surfaces of one material.
struct ShadePlan {
  MaterialKind material = MaterialKind::kMatte;
  uint32_t program = kNone;    ///< row of Scene::programs: textures make its parameters
  bool splits = false;         ///< rows go on to the children, and nothing else is done
  bool veil = false;           ///< its lobe is decided anew at every crossing
  bool solid = false;          ///< no light passes it unturned
  bool unequal = false;        ///< see MaterialSplit
  bool coats = false;          ///< the first child lies over the second (kernels/coat.h)
  uint32_t child[2] = {};      ///< rows of Plan::children
  bool turned[2] = {};         ///< see MaterialSplit
  bool sample_lights = false;  ///< the scene has lights and the material is not delta
  bool all_around = false;     ///< see MaterialTraits
  // Random numbers that the rows need.
  bool draw_choice = false;  ///< which light: there is more than one, and not light_by_place
  bool draw_lobe = false;
  bool draw_direction = false;
  bool draw_roulette = false;
};

/// What is done with the rows of one bin.
struct BinPlan : ShadePlan {
  Bin bin;
  bool emission = false;  ///< rows have a light row: add_emission runs
};

/// Lights of which a surface samples one: all that are asked, or one of them (Scene::every_light).
struct LightGroup {
  RowRange rows;
  uint32_t kinds;   ///< bits by LightKind
  uint32_t kernel;  ///< index into KernelTable::sample_lights or sample_tree_lights
  bool tree;        ///< the tree chooses
};
/// The scene as sample_lights sees it for a group: with its lights alone.
SceneView light_view(const SceneView& scene, const LightGroup& group);

struct Plan {
  const KernelTable* kernels = nullptr;
  SamplerKind sampler = SamplerKind::kSobol;
  TransportOptions transport;
  /// Share of the picture's level that transport.shadow_bound is to be, which set_shadow_bound()
  /// (pilot.h) sees to; kNoShadowRoulette also where no light is sampled.
  double shadow_roulette = kNoShadowRoulette;
  LightSampling light_sampling = LightSampling::kBoth;
  uint32_t set_columns = 8, set_rows = 8;  ///< of the samplers with sets: see DrawKey
  /// Key of all random numbers.
  DrawKey draw_key() const { return {transport.seed, set_columns, set_rows}; }
  std::vector<BinPlan> bins;        ///< parallel to Scene::bins; [0] is the ended bin
  uint32_t first_lasting_bin = 1;   ///< of the scene
  std::vector<ShadePlan> children;  ///< of materials that are made of others
  uint32_t split_levels = 0;        ///< how many times over materials are made of others
  CameraKind camera = CameraKind::kPinhole;
  bool tangents = false;                                    ///< some bin needs dp/du
  bool triangles = false, spheres = false, planes = false;  ///< which intersect stages run
  bool shapes[kShapeKinds] = {};  ///< other analytic shapes, tried one after the other
  bool shape_tree = false;        ///< spheres and shapes have a tree: it stands for both stages
  bool veil_shape_tree = false;   ///< so have those that are veils
  bool instances = false;         ///< shared objects: a second level of trees, and its kernels
  bool instance_mask = false;     ///< as shadow_mask, of shared objects
  bool shadow_mask = false;       ///< some triangle is see-through: the masked any-hit kernel
  bool veils = false;             ///< some surface lets a part of the light pass: shadow rays go on
  bool light_tree = false;        ///< lights are chosen by the tree over them
  bool light_by_place = false;    ///< the number of a light's place chooses the light, too
  bool lights = false;
  std::vector<LightGroup> light_groups;  ///< at least one where there are lights
  bool far_by_tree = false;       ///< whether a light without a place is asked, the tree decides
  bool varying_emission = false;  ///< some light does not shine evenly: light samples are weighed
  bool environment = false;       ///< lights that rays find which leave the scene
};

struct PlanOptions {
  Integrator integrator = Integrator::kPath;
  SamplerKind sampler = SamplerKind::kSobol;
  uint32_t max_depth = 16;
  uint32_t seed = 0;
  LightSampling light_sampling = LightSampling::kBoth;
  /// First vertex at which Russian roulette may end a path, or kNoRoulette.
  uint32_t roulette_depth = TransportOptions{}.roulette_depth;
  double shadow_roulette = kUsualShadowRoulette;  ///< see Plan: in (0, 1], or kNoShadowRoulette
  /// Samples of a pixel that stratified samplers spread together, at most kLargestSet. Rounded down
  /// to a grid's product where the sampler has a grid, and up to a power of two for zsobol.
  uint32_t sample_set = 64;
};

/// "thin lens", for people.
std::string_view camera_kind_name(CameraKind kind);
std::string_view sampler_kind_name(SamplerKind kind);

/// Throws std::logic_error when the table lacks a kernel that the scene needs, and for
/// LightSampling::kLights when the scene has lights that are not asked (Scene::asked_lights).
Plan make_plan(const Scene& scene, const KernelTable& kernels, const PlanOptions& options);

/// One line per stage and kernel that will run, then what is skipped and why.
std::string describe_plan(const Plan& plan, const Scene& scene);

}  // namespace yat
