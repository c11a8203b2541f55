#pragma once
// What each directive does to the description (lxs 2.1).

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/graphics_state.h"
#include "scene/statement.h"

namespace yat {

/// Arguments of one statement, in the order in which they are written.
struct Statement {
  SourceLoc loc;  ///< of the directive
  std::string_view directive;
  std::vector<std::string> strings;
  std::vector<double> numbers;
  std::vector<Parameter> parameters;
};

class SceneBuilder;

struct Directive {
  enum class Where { kAnywhere, kOptions, kWorld };
  std::string_view name;
  Where where;
  /// s a string, n a number, m 16 numbers in brackets, a numbers in brackets, p parameters.
  std::string_view arguments;
  std::string_view usage;
  void (SceneBuilder::*run)(Statement&);
};

/// All directives but Include, sorted by name.
std::span<const Directive> directives();

class SceneBuilder {
 public:
  SceneBuilder(Description& description, Diagnostics& diagnostics)
      : description_(description),
        diagnostics_(diagnostics),
        state_(description.dialect, diagnostics) {}

  /// Carries the statement out, or reports that it stands where it must not.
  void run(const Directive& directive, Statement& statement);
  bool world_begun() const { return in_world_; }
  bool world_ended() const { return ended_; }

  // One each per directive.
  void identity(Statement&);
  void translate(Statement&);
  void scale(Statement&);
  void rotate(Statement&);
  void look_at(Statement&);
  void transform(Statement&);
  void concat_transform(Statement&);
  void coordinate_system(Statement&);
  void coord_sys_transform(Statement&);
  void transform_begin(Statement&);
  void transform_end(Statement&);
  void motion_begin(Statement&);
  void motion_end(Statement&);
  void nothing(Statement&);
  void option(Statement&);
  void camera(Statement&);
  void world_begin(Statement&);
  void world_end(Statement&);
  void attribute_begin(Statement&);
  void attribute_end(Statement&);
  void texture(Statement&);
  void material(Statement&);
  void make_named_material(Statement&);
  void named_material(Statement&);
  void make_named_volume(Statement&);
  void current_volume(Statement&);
  void old_volume(Statement&);
  void light_source(Statement&);
  void area_light_source(Statement&);
  void shape(Statement&);
  void portal(Statement&);
  void reverse_orientation(Statement&);
  void object_begin(Statement&);
  void object_end(Statement&);
  void object_instance(Statement&);
  void motion_instance(Statement&);

 private:
  /// kRelative: Translate, Rotate and Scale, which YART puts on the other side of the CTM.
  enum class Apply { kAppend, kRelative, kReplace };
  void apply(const Statement& statement, const Matrix& matrix, Apply how = Apply::kAppend);
  bool by_yart() const { return description_.dialect == Dialect::kYart; }
  /// Notes a sign that the scene was made for the other renderer: once of each `sort` and file.
  void hint(SourceLoc loc, std::string_view sort, std::string message);
  void hint_at_types(const Statement& statement, std::string_view type);
  const ScopedNames::Entry* look_up(const ScopedNames& names, std::string_view name) const;
  void use_up(const Statement& shape);
  Matrix checked_columns(const Statement& statement);
  Plugin plugin(Statement& statement, std::string type);
  void resolve_textures(std::vector<Parameter>& parameters, TextureKind otherwise);
  void resolve_materials(std::string_view type, std::vector<Parameter>& parameters);
  void resolve_texture(Parameter& parameter, TextureKind wanted);
  void place_instance(const Statement& statement, std::string_view name);

  Description& description_;
  Diagnostics& diagnostics_;
  GraphicsState state_;
  std::set<std::pair<uint32_t, std::string>> hinted_;  ///< file and sort
  Matrix look_at_{1.0};                                ///< YART: of the camera to come
  bool in_world_ = false, ended_ = false;
  SourceLoc world_loc_;
  bool in_motion_ = false;
  SourceLoc motion_loc_;
  uint32_t keyframes_ = 0;
};

}  // namespace yat
