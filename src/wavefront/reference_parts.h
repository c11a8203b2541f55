#pragma once
// Parts of the oracle (reference.h): geometry, optics and lights in double precision, one row at a
// time. Formulas are those of textbooks and of the scene format, not those of the kernels; only
// what decides between paths (warps of random numbers, choice of lobe and light) is the same.

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "scene/compile.h"
#include "wavefront/plan.h"

namespace yat::reference {

using Vec = glm::dvec3;

struct RaySegment {
  Vec origin, direction;  ///< unit direction
  double t_max;
};

struct Point {
  double t;  ///< distance along the ray
  Vec position;
  Vec ng, ns;     ///< unit; the shape's outside
  Vec along;      ///< dp/du of any length, or 0
  double offset;  ///< what a ray that leaves must keep off: rounding of this arithmetic
  double u, v;    ///< texture coordinates
  Vec du, dv;     ///< dp/du, dp/dv; 0 where there are none
  uint32_t bin;   ///< row of Scene::bins
  uint32_t parameter, light;
  uint32_t prim;  ///< as in Hit
};

struct CameraStart {
  RaySegment ray;
  double weight;  ///< sign of the pixel filter; 0 where the camera sees nothing
};
/// The camera's ray for a sample: lxs 3.2, 3.3, 12.3.
CameraStart camera_ray(const Scene& scene, const Plan& plan, uint32_t x, uint32_t y,
                       uint32_t sample);
/// The ray of raster position (px, py) through the place of the lens that (u, v) names.
RaySegment camera_segment(const CameraView& camera, CameraKind kind, double px, double py, double u,
                          double v);

/// Texture coordinates of a point of the sphere.
glm::dvec2 sphere_uv(const SphereRow<Value>& row, const Vec& position);
/// The nearest hit in (0, t_max], by trying every primitive.
std::optional<Point> nearest(const Scene& scene, const RaySegment& ray);
/// Unit, across the shading normal: along dp/du where there is one.
Vec tangent_of(const Point& point);
/// Whether anything solid lies strictly between the two points.
bool occluded(const Scene& scene, const Vec& from, const Vec& to);
/// What the veils between two points, nothing solid in between, let pass.
Vec through_veils(const Scene& scene, const Vec& from, const Vec& to);

// ---- Warps -------------------------------------------------------------------------------------

/// Orthonormal frame about z (Duff et al. 2017).
struct Axes {
  Vec x, y, z;
  explicit Axes(const Vec& normal);
  /// x as nearly along `tangent` as it can be.
  Axes(const Vec& normal, const Vec& tangent);
  Vec to_local(const Vec& v) const { return {glm::dot(x, v), glm::dot(y, v), glm::dot(z, v)}; }
  Vec to_scene(const Vec& v) const { return v.x * x + v.y * y + v.z * z; }
};
/// Concentric (Shirley, Chiu 1997).
glm::dvec2 disc(double u, double v);
Vec cosine_hemisphere(double u, double v);
/// Uniform in the cone with 1 - cos(half angle) = measure.
Vec cone(double measure, double u, double v);

// ---- Textures: reference_textures.h ------------------------------------------------------------

/// Diameter of what a ray stands for where it meets a surface: `distance` from the last scattering
/// vertex, which chose it with density pdf (0: a pixel's width from the camera), under this cosine.
double footprint(const Scene& scene, double distance, double pdf, double cosine);
/// The colour that a row of Scene::emission_programs has there.
Vec light_texture(const Scene& scene, uint32_t program, uint32_t row, const Point& point,
                  double width);
/// Bends the shading normal as the material's bump or normal map says.
void bend_normal(const Scene& scene, uint32_t program, uint32_t row, Point& point, double width);
/// The record of the material there, with what textures make of it. width: footprint().
std::vector<uint32_t> material_parameters(const Scene& scene, MaterialKind kind, uint32_t program,
                                          uint32_t row, const Point& point, double width);

// ---- Materials: reference_materials.h ----------------------------------------------------------

struct Bounce {
  Vec wi;          ///< local
  Vec weight;      ///< f |cos| / pdf
  double pdf = 0;  ///< solid angle; 0: delta
};

/// Where a surface is seen from.
struct LocalView {
  Vec wo;  ///< local, wo.z >= 0
  bool outside;
  double distance = 0;  ///< from the last scattering vertex or the camera [m]
};

/// A material seen from somewhere.
class Bsdf {
 public:
  /// parameters: its record (material_parameters).
  Bsdf(MaterialKind kind, std::vector<uint32_t> parameters, const LocalView& view)
      : kind_(kind), parameters_(std::move(parameters)), view_(view) {}
  Vec evaluate(const Vec& wi) const;
  double pdf(const Vec& wi) const;
  Bounce sample(double lobe, double u, double v) const;

 private:
  MaterialKind kind_;
  std::vector<uint32_t> parameters_;
  LocalView view_;
};

/// A coat over a material (lxs 7.3).
struct CoatOver {
  Vec r0, absorbs;  ///< reflectance and optical thickness head-on
  bool outside;     ///< seen from its side
  /// f over that of the bare material; local directions.
  Vec passes(const Vec& wo, const Vec& wi) const;
};

/// What a bin's material is at a point: one of its children, if it is made of others.
struct ChosenMaterial {
  MaterialKind kind;
  uint32_t program;  ///< row of Scene::programs, or kNone
  uint32_t row;
  bool turned;        ///< its outside is the surface's inside
  double weight = 1;  ///< of what it brings
  std::optional<CoatOver> coat = {};
};
/// u in [0, 1) decides; wo in the scene.
ChosenMaterial choose_material(const Scene& scene, const Point& point, const Vec& wo, double width,
                               float u);

// ---- Lights ------------------------------------------------------------------------------------

struct LightPoint {
  Vec wi{0.0};        ///< unit, towards the light
  Vec to{0.0};        ///< where the shadow ray ends
  Vec arriving{0.0};  ///< radiance / pdf
  double pdf = 0;     ///< solid angle, nominal chance included; 0: cannot be hit
};

/// Who is lit: where, and unless all_around only from the side of `up` (unit).
struct Receiver {
  Vec position, up;
  bool all_around;
};
/// Which light a number chooses, and with what chance; `nominal` is what weights go by.
struct LightChance {
  uint32_t light;
  double chance, nominal;
  float left = 0;  ///< of the number, in [0, 1) again; without a tree only
};
LightChance choose_light(const Scene& scene, const Receiver& receiver, float u);
/// LightChance::chance of a light. Nominal is that of a receiver lit from all around.
double chance_of_light(const Scene& scene, const Receiver& receiver, uint32_t light);
inline double nominal_chance(const Scene& scene, const Vec& receiver, uint32_t light) {
  return chance_of_light(scene, {receiver, Vec(0.0), true}, light);
}

/// Without a number for the choice, u chooses, and what is left of it is for the place.
LightPoint sample_light(const Scene& scene, const Receiver& receiver, std::optional<float> choice,
                        float u, float v);
/// A point of that light; LightChance::left is not read.
LightPoint sample_light(const Scene& scene, const Receiver& receiver, const LightChance& chosen,
                        double u, double v);
/// The density of sample_light for the point `at` of its light from `receiver`, by nominal chance.
double light_pdf(const Scene& scene, const Vec& receiver, const Point& at, double cos);
/// Of the light's row.
Vec light_radiance(const Scene& scene, uint32_t light);
/// What the light emits at a point into `direction` (unit), over the radiance of its row; of `at`,
/// position, ng, u, v, du, dv and prim are read. width: footprint().
Vec emission_factor(const Scene& scene, uint32_t light, const Point& at, const Vec& direction,
                    double width);
/// The same at the sampled point whose shadow ray ends at `to`.
Vec emission_factor(const Scene& scene, uint32_t light, const Vec& to, const Vec& direction);

/// What an environment light shows in direction w (unit).
struct SeenEnvironment {
  Vec radiance;
  double pdf;  ///< with which sample_light chooses w for this light, nominal chance included
};
SeenEnvironment see_environment(const Scene& scene, uint32_t light, const Vec& receiver,
                                const Vec& w);

}  // namespace yat::reference
