// Where shapes go: once into the world, as copies of an object, or into a shared object.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/compile_objects.h"

namespace yat {

namespace {

/// Above this many triangles from instances, say what copies cost.
constexpr uint64_t kManyCopies = 1'000'000;

/// Whether a map and its inverse keep their precision as floats.
bool fits_float(const Placement& placement) {
  for (int i = 0; i < 3; ++i) {
    const double length = glm::length(placement.linear[i]);
    const double inverse = glm::length(placement.normal_map[i]);
    if (!(length > 1e-12 && length < 1e12 && inverse > 1e-12 && inverse < 1e12)) return false;
  }
  return true;
}

}  // namespace

ShapePlacer::ShapePlacer(const Description& description, const ColourModel& colour,
                         const CompileOptions& options, Diagnostics& diagnostics)
    : description_(description),
      colour_(colour),
      mode_(options.instances),
      keep_uv_(options.keep_uv),
      diagnostics_(diagnostics),
      materials_(description, colour, options, diagnostics),
      emission_(description, colour, diagnostics, materials_.textures().images()),
      shapes_(description.shapes.size()),
      area_lights_(description.area_lights.size()),
      members_(description.objects.size()) {}

void ShapePlacer::place_all() {
  for (uint32_t i = 0; i < description_.shapes.size(); ++i) {
    const ShapeEntry& entry = description_.shapes[i];
    if (entry.object == kNone)
      place(i, entry.to_world, entry.material, i + 1, entry.plugin.loc);
    else if (entry.object < members_.size())
      members_[entry.object].push_back(i);
  }
  std::vector<uint64_t> count(members_.size());
  for (const InstanceEntry& instance : description_.instances)
    if (instance.object < members_.size()) ++count[instance.object];
  // Outer: decided yet? Inner: the row of a shared object.
  std::vector<std::optional<std::optional<uint32_t>>> decided(members_.size());
  for (const InstanceEntry& instance : description_.instances) {
    if (instance.object >= members_.size()) continue;  // reported by the parser
    auto& shared = decided[instance.object];
    if (!shared) shared.emplace(share(instance.object, count[instance.object], instance));
    const bool is_shared = *shared && place_shared(**shared, instance);
    for (const uint32_t i : members_[instance.object])
      if (!is_shared || !is_mesh(i)) copy(instance, i);
  }
  if (copied_ > kManyCopies)
    diagnostics_.note({}, fmt::format("instances are placed as copies: {} triangles, about {} MB",
                                      copied_, copied_ * 200 / 1'000'000));
}

ShapePlacer::Presence ShapePlacer::presence(const ShapeInfo& info,
                                            const MaterialRef& material) const {
  if (material.passing == Passing::kSolid) return Presence::kSolid;
  if (material.passing == Passing::kVeil) return Presence::kVeil;
  // A null surface that does not shine is not there.
  return info.emissive() ? Presence::kSeeThrough : Presence::kAbsent;
}

void ShapePlacer::copy(const InstanceEntry& instance, uint32_t index) {
  const ShapeEntry& entry = description_.shapes[index];
  place(index, instance.to_world * entry.to_world,
        instance.material != kNone ? instance.material : entry.material, object_id(instance),
        instance.loc);
  if (shapes_[index].shape) copied_ += shapes_[index].shape->mesh.triangles();
}

void ShapePlacer::note_mirrored_light(const PlacedShape& placed, bool mirrored, SourceLoc loc) {
  if (placed.emissive() && mirrored && placed.shape->kind == CompiledShape::Kind::kMesh &&
      placed.shape->mesh.normals.empty())
    diagnostics_.note(loc,
                      "a mesh light under a mirrored transform shines to the side that its "
                      "mesh says, mirrored with it (LuxRender: to the other side)");
}

std::optional<uint32_t> ShapePlacer::share(uint32_t object, uint64_t instances,
                                           const InstanceEntry& first) {
  if (mode_ == InstanceMode::kCopy) return {};
  uint64_t triangles = 0;
  for (const uint32_t i : members_[object])
    if (is_mesh(i)) triangles += shapes_[i].shape->mesh.triangles();
  const bool pays = triangles >= kSharedTriangles || triangles * instances > kCopiedTriangles;
  if (mode_ == InstanceMode::kAuto && (instances < 2 || !pays)) return {};

  SharedShapes::Object shared;
  shared.row = object;
  Diagnostics silent([](Severity, std::string_view) {});
  for (const uint32_t i : members_[object]) {
    if (!is_mesh(i)) continue;
    const ShapeEntry& entry = description_.shapes[i];
    PlacedShape placed;
    placed.shape = &*shapes_[i].shape;
    placed.loc = entry.plugin.loc;
    // Copies say what is wrong with a transform, with the instance's place.
    const auto placement = make_placement(entry.to_world, placed.loc, "", silent);
    if (!placement) return {};
    placed.placement = *placement;
    placed.reverse_orientation = entry.reverse_orientation;
    placed.material = materials_.compile(first.material != kNone ? first.material : entry.material,
                                         {entry.interior, entry.exterior});
    placed.radiance = shapes_[i].radiance;
    placed.look = shapes_[i].look;
    // Shadow rays walk through the veils of the scene's own tables.
    if (placed.material.passing == Passing::kVeil) return {};
    shared.meshes.push_back(std::move(placed));
  }
  if (shared.meshes.empty()) return {};
  shared_.objects.push_back(std::move(shared));
  return uint32_t(shared_.objects.size() - 1);
}

bool ShapePlacer::place_shared(uint32_t shared, const InstanceEntry& instance) {
  const SharedShapes::Object& object = shared_.objects[shared];
  Diagnostics silent([](Severity, std::string_view) {});
  const auto placement = make_placement(instance.to_world, instance.loc, "", silent);
  if (!placement || !fits_float(*placement)) return false;
  const auto [known, is_new] =
      material_rows_.try_emplace({shared, instance.material}, uint32_t(kNone));
  if (is_new) {
    std::vector<MaterialRef> materials;
    bool same = true;
    size_t mesh = 0;
    for (const uint32_t i : members_[object.row]) {
      if (!is_mesh(i)) continue;
      materials.push_back(materials_.compile(
          instance.material != kNone ? instance.material : description_.shapes[i].material,
          {description_.shapes[i].interior, description_.shapes[i].exterior}));
      if (keep_uv_) materials.back().uv = std::max(materials.back().uv, UvUse::kIfThere);
      same = same && presence(shapes_[i], materials.back()) ==
                         presence(shapes_[i], object.meshes[mesh++].material);
    }
    if (same) {
      known->second = uint32_t(shared_.materials.size());
      shared_.materials.push_back(std::move(materials));
    }
  }
  if (known->second == kNone) return false;
  // Again, for what it has to say.
  make_placement(instance.to_world, instance.loc, "the instance", diagnostics_);
  for (const PlacedShape& mesh : object.meshes)
    note_mirrored_light(mesh, mesh.placement.mirrored != placement->mirrored, instance.loc);
  shared_.instances.push_back(
      {shared, known->second, *placement, instance.loc, object_id(instance)});
  return true;
}

void ShapePlacer::place(uint32_t index, const Matrix& to_world, uint32_t material,
                        uint32_t object_id, SourceLoc loc) {
  const ShapeEntry& entry = description_.shapes[index];
  const std::string what = "shape \"" + entry.plugin.type + "\"";
  const ShapeInfo& info = this->info(index);
  if (!info.shape) return;
  auto placement = make_placement(to_world, loc, what, diagnostics_);
  if (!placement) return;
  PlacedShape placed;
  placed.shape = &*info.shape;
  placed.loc = loc;
  placed.placement = *placement;
  placed.reverse_orientation = entry.reverse_orientation;
  placed.material = materials_.compile(material, {entry.interior, entry.exterior}, entry.to_world);
  placed.object_id = object_id;
  if (keep_uv_) placed.material.uv = std::max(placed.material.uv, UvUse::kIfThere);
  placed.radiance = info.radiance;
  placed.look = info.look;
  if (presence(info, placed.material) == Presence::kAbsent) return;
  note_mirrored_light(placed, placed.placement.mirrored, loc);
  placed_.push_back(std::move(placed));
}

void ShapePlacer::place_lamp(const SphereLamp& lamp, SourceLoc loc) {
  if (!lamp_sphere_) {
    lamp_sphere_.emplace();
    lamp_sphere_->kind = CompiledShape::Kind::kSphere;
    lamp_sphere_->radius = SphereLamp::kRadius;
    lamp_sphere_->analytic = make_sphere(SphereLamp::kRadius, -SphereLamp::kRadius,
                                         SphereLamp::kRadius, 2 * std::numbers::pi);
  }
  PlacedShape placed;
  placed.shape = &*lamp_sphere_;
  placed.loc = loc;
  placed.placement.origin = lamp.center;
  placed.placement.scale = 1;
  placed.material = materials_.compile(kNone);
  placed.radiance = lamp.radiance;
  light_samples_ += lamp.samples;
  placed_.push_back(std::move(placed));
}

const ShapePlacer::ShapeInfo& ShapePlacer::info(uint32_t index) {
  ShapeInfo& info = shapes_[index];
  if (info.read) return info;
  info.read = true;
  const ShapeEntry& entry = description_.shapes[index];
  info.shape = compile_shape(entry, description_, diagnostics_);
  if (!info.shape) return info;
  ++shapes_read_;
  if (entry.area_light < area_lights_.size()) make_light(entry, info);
  return info;
}

/// What the shape emits; it stays black if it is no light.
void ShapePlacer::make_light(const ShapeEntry& entry, ShapeInfo& info) {
  const CompiledShape& shape = *info.shape;
  auto& known = area_lights_[entry.area_light];
  emission_.set_shape(entry.to_world);
  if (!known)
    known = std::make_optional(compile_area_light(description_.area_lights[entry.area_light],
                                                  description_, emission_, diagnostics_));
  const std::optional<AreaLight> light = *known;
  // On the next shape it is another light.
  if (emission_.saw_shape()) known.reset();
  if (!light) return;
  if (shape.kind == CompiledShape::Kind::kPlane) {
    diagnostics_.warning(entry.plugin.loc,
                         "an infinite plane cannot be a light: it does not shine");
    return;
  }
  const auto own = make_placement(entry.to_world, entry.plugin.loc, "the light", diagnostics_);
  if (!own) return;
  const double area = shape.light_area ? *shape.light_area : mesh_area(shape.mesh, *own);
  if (!(area > 0)) {
    diagnostics_.warning(entry.plugin.loc, "the area light has no area: it does not shine");
    return;
  }
  const glm::dvec3 radiance = area_light_radiance(*light, area, diagnostics_);
  if (!std::isfinite(float(radiance.x)) || !std::isfinite(float(radiance.y)) ||
      !std::isfinite(float(radiance.z))) {
    diagnostics_.error(light->loc,
                       "the area light's radiance is too large for a number: it does "
                       "not shine");
    return;
  }
  light_samples_ += light->samples;
  info.radiance = radiance;
  info.look = light->look;
  if (info.look.distribution != kNone && shape.kind != CompiledShape::Kind::kMesh) {
    diagnostics_.warning(entry.plugin.loc,
                         fmt::format("a light of shape \"{}\" cannot shine by \"mapname\" or "
                                     "\"iesname\": it shines evenly (Lambertian)",
                                     entry.plugin.type));
    info.look.distribution = kNone;
  }
}

}  // namespace yat
