#include "scene/directives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "scene/transforms.h"

namespace yat {

namespace {

/// But for the rounding of products.
bool nearly_equal(const Matrix& a, const Matrix& b) {
  double largest = 0, difference = 0;
  for (int i = 0; i < 16; ++i) {
    const double x = a[i / 4][i % 4], y = b[i / 4][i % 4];
    largest = std::max({largest, std::abs(x), std::abs(y)});
    difference = std::max(difference, std::abs(x - y));
  }
  return difference <= 1e-12 * largest;
}

}  // namespace

void SceneBuilder::hint(SourceLoc loc, std::string_view sort, std::string message) {
  if (hinted_.emplace(loc.file, sort).second)
    description_.dialect_hints.push_back({loc, std::move(message)});
}

/// What only YART has, though it is read here by both rules.
void SceneBuilder::hint_at_types(const Statement& s, std::string_view type) {
  if (by_yart()) return;
  const bool film = s.directive == "Film";
  bool found = (s.directive == "Shape" && (type == "plane" || type == "box")) ||
               (s.directive == "Camera" && type == "fisheye");
  for (const Parameter& p : s.parameters)
    if (film && p.name == "tonemapkernel" && !p.strings.empty() && p.strings[0] == "outofgamut") {
      found = true;
      type = p.strings[0];
    }
  if (found)
    hint(s.loc, "type",
         fmt::format("{} {} is YART's: if the scene was made for it, read it by its rules "
                     "(--compat yart)",
                     film ? std::string_view("tonemapkernel") : s.directive, quote(type)));
}

void SceneBuilder::run(const Directive& directive, Statement& statement) {
  if (directive.where == Directive::Where::kOptions && in_world_) {
    diagnostics_.error(statement.loc,
                       fmt::format("{} is ignored in the world, put it before WorldBegin at {}",
                                   directive.name, diagnostics_.place(world_loc_)));
    return;
  }
  if (directive.where == Directive::Where::kWorld && !in_world_) {
    diagnostics_.error(statement.loc, fmt::format("{} is ignored before WorldBegin, put it behind",
                                                  directive.name));
    return;
  }
  (this->*directive.run)(statement);
}

// Transforms

void SceneBuilder::apply(const Statement& statement, const Matrix& matrix, Apply how) {
  // Of a moving transform only the first keyframe is used.
  if (in_motion_ && keyframes_++ > 0) return;
  Matrix result = how == Apply::kReplace ? matrix : state_.ctm * matrix;
  if (how == Apply::kRelative) {
    const Matrix other = matrix * state_.ctm;
    if (by_yart())
      result = other;
    else if (in_world_ && !nearly_equal(result, other))
      hint(statement.loc, "order",
           "relative transforms are stacked here, and the last one acts first, as in "
           "LuxRender: YART applied them in the opposite order (--compat yart)");
  }
  if (!is_finite(result)) {
    diagnostics_.error(
        statement.loc,
        fmt::format("{} makes numbers too large for the transform, ignored", statement.directive));
    return;
  }
  state_.ctm = result;
}

Matrix SceneBuilder::checked_columns(const Statement& statement) {
  Matrix m = from_columns(std::span<const double, 16>(statement.numbers.data(), 16));
  const double w = m[3][3];
  const bool affine = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && w != 0;
  if (affine && w == 1) return m;
  if (affine) {
    diagnostics_.warning(statement.loc,
                         fmt::format("the last number of {} is {} instead of 1, all are divided by "
                                     "it",
                                     statement.directive, w));
    m /= w;
  } else {
    diagnostics_.warning(statement.loc,
                         fmt::format("{} is a projection, its numbers 4, 8, 12 and 16 are taken as "
                                     "0 0 0 1",
                                     statement.directive));
  }
  m[0][3] = m[1][3] = m[2][3] = 0;
  m[3][3] = 1;
  return m;
}

void SceneBuilder::identity(Statement& s) {
  apply(s, Matrix(1.0), Apply::kReplace);
}

void SceneBuilder::translate(Statement& s) {
  apply(s, translation(s.numbers[0], s.numbers[1], s.numbers[2]), Apply::kRelative);
}

void SceneBuilder::scale(Statement& s) {
  apply(s, scaling(s.numbers[0], s.numbers[1], s.numbers[2]), Apply::kRelative);
}

void SceneBuilder::rotate(Statement& s) {
  const auto turn = by_yart() ? yart_rotation : rotation;
  const auto matrix = turn(s.numbers[0], s.numbers[1], s.numbers[2], s.numbers[3]);
  if (!matrix) {
    diagnostics_.warning(
        s.loc, by_yart() ? "Rotate about an axis whose components are all below 1, which YART cuts "
                           "to 0 0 0, ignored"
                         : "Rotate about an axis 0 0 0, ignored, give the axis a direction");
    return;
  }
  apply(s, *matrix, Apply::kRelative);
}

void SceneBuilder::look_at(Statement& s) {
  const LookAtResult result = yat::look_at(std::span<const double, 9>(s.numbers.data(), 9));
  if (!result.trouble.empty())
    diagnostics_.warning(s.loc, fmt::format("LookAt: {}", result.trouble));
  if (by_yart())
    look_at_ = result.world_to_camera;  // the camera's alone, and all that it knows
  else
    apply(s, result.world_to_camera);
}

void SceneBuilder::transform(Statement& s) {
  apply(s, checked_columns(s), Apply::kReplace);
}
void SceneBuilder::concat_transform(Statement& s) {
  apply(s, checked_columns(s));
}

void SceneBuilder::coordinate_system(Statement& s) {
  state_.coordinate_systems.insert_or_assign(s.strings[0], state_.ctm);
}

void SceneBuilder::coord_sys_transform(Statement& s) {
  const auto found = state_.coordinate_systems.find(s.strings[0]);
  if (found != state_.coordinate_systems.end()) {
    apply(s, found->second, Apply::kReplace);
    return;
  }
  std::vector<std::string_view> names;
  for (const auto& [name, matrix] : state_.coordinate_systems)
    if (names.size() < 100) names.push_back(name);
  diagnostics_.warning(s.loc, fmt::format("no coordinate system {}{}, CoordSysTransform ignored",
                                          quote(s.strings[0]), did_you_mean(s.strings[0], names)));
}

void SceneBuilder::transform_begin(Statement& s) {
  state_.begin_block(BlockKind::kTransform, s.loc);
}
void SceneBuilder::transform_end(Statement& s) {
  state_.end_block(BlockKind::kTransform, s.loc);
}

void SceneBuilder::motion_begin(Statement& s) {
  if (in_motion_) {
    diagnostics_.warning(s.loc, fmt::format("MotionBegin inside the one at {}, ignored",
                                            diagnostics_.place(motion_loc_)));
    return;
  }
  diagnostics_.warning(s.loc, "motion is not supported, the transform at the first time is used",
                       "motion is not supported");
  in_motion_ = true;
  motion_loc_ = s.loc;
  keyframes_ = 0;
}

void SceneBuilder::motion_end(Statement& s) {
  if (!in_motion_) diagnostics_.warning(s.loc, "MotionEnd without MotionBegin, ignored, remove it");
  in_motion_ = false;
}

// Options and the frame of the scene

void SceneBuilder::nothing(Statement&) {}

Plugin SceneBuilder::plugin(Statement& s, std::string type) {
  return {std::move(type), s.loc, std::move(s.parameters), by_yart()};
}

void SceneBuilder::option(Statement& s) {
  using Slot = std::optional<Plugin> Description::*;
  static constexpr std::array<std::pair<std::string_view, Slot>, 8> kSlots = {{
      {"Accelerator", &Description::accelerator},
      {"Camera", &Description::camera},
      {"Film", &Description::film},
      {"PixelFilter", &Description::filter},
      {"Renderer", &Description::renderer},
      {"Sampler", &Description::sampler},
      {"SurfaceIntegrator", &Description::integrator},
      {"VolumeIntegrator", &Description::volume_integrator},
  }};
  for (const auto& [name, slot] : kSlots) {
    if (name != s.directive) continue;
    std::optional<Plugin>& plug = description_.*slot;
    if (plug)
      diagnostics_.warning(s.loc, fmt::format("a second {}, the one at {} is forgotten, remove one",
                                              name, diagnostics_.place(plug->loc)));
    resolve_textures(s.parameters, TextureKind::kColor);
    hint_at_types(s, s.strings[0]);
    plug = plugin(s, std::move(s.strings[0]));
  }
}

void SceneBuilder::camera(Statement& s) {
  option(s);
  description_.world_to_camera = by_yart() ? look_at_ : state_.ctm;
  const Matrix camera_to_world = glm::inverse(description_.world_to_camera);
  if (is_finite(camera_to_world))
    state_.coordinate_systems.insert_or_assign("camera", camera_to_world);
}

void SceneBuilder::world_begin(Statement& s) {
  if (in_world_) {
    diagnostics_.error(s.loc, fmt::format("a second WorldBegin, ignored, the world began at {}",
                                          diagnostics_.place(world_loc_)));
    return;
  }
  in_world_ = true;
  world_loc_ = s.loc;
  state_.ctm = Matrix(1.0);
}

void SceneBuilder::world_end(Statement& s) {
  if (!in_world_) {
    diagnostics_.error(s.loc, "WorldEnd before WorldBegin, ignored");
    return;
  }
  state_.check_all_closed(s.loc);
  if (in_motion_)
    diagnostics_.warning(s.loc,
                         fmt::format("MotionBegin at {} is still open when the world ends, add "
                                     "MotionEnd",
                                     diagnostics_.place(motion_loc_)));
  ended_ = true;
}

void SceneBuilder::attribute_begin(Statement& s) {
  state_.begin_block(BlockKind::kAttribute, s.loc);
}
void SceneBuilder::attribute_end(Statement& s) {
  state_.end_block(BlockKind::kAttribute, s.loc);
}
void SceneBuilder::reverse_orientation(Statement&) {
  state_.reverse_orientation = !state_.reverse_orientation;
}

}  // namespace yat
