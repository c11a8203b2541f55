#pragma once
// Descriptions by hand, for tests of compile_scene() that need no text.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "scene/compile.h"

namespace yat {

inline Parameter numbers(ParameterType type, std::string name, std::vector<float> values) {
  Parameter p;
  p.type = type;
  p.name = std::move(name);
  p.floats = std::move(values);
  return p;
}
inline Parameter number(std::string name, float value) {
  return numbers(ParameterType::kFloat, std::move(name), {value});
}
inline Parameter color(std::string name, float r, float g, float b) {
  return numbers(ParameterType::kColor, std::move(name), {r, g, b});
}
inline Parameter integers(std::string name, std::vector<int32_t> values) {
  Parameter p;
  p.type = ParameterType::kInteger;
  p.name = std::move(name);
  p.integers = std::move(values);
  return p;
}
inline Parameter text(std::string name, std::string value,
                      ParameterType type = ParameterType::kString) {
  Parameter p;
  p.type = type;
  p.name = std::move(name);
  p.strings = {std::move(value)};
  return p;
}
inline Parameter flag(std::string name, bool value) {
  return text(std::move(name), value ? "true" : "false", ParameterType::kBool);
}
inline Parameter texture(std::string name, uint32_t row) {
  Parameter p = text(std::move(name), "t", ParameterType::kTexture);
  p.texture = row;
  return p;
}

/// A plugin at scene.lxs:line:1, its parameters on the lines after it.
inline Plugin plugin(std::string type, std::vector<Parameter> parameters, uint32_t line = 10) {
  Plugin p;
  p.type = std::move(type);
  p.loc = {0, line, 1};
  for (Parameter& parameter : parameters) parameter.loc = {0, ++line, 2};
  p.parameters = std::move(parameters);
  return p;
}

inline Plugin mesh(std::vector<float> positions, std::vector<int32_t> indices,
                   std::vector<Parameter> more = {}) {
  std::vector<Parameter> parameters = {integers("triindices", std::move(indices)),
                                       numbers(ParameterType::kPoint, "P", std::move(positions))};
  for (Parameter& p : more) parameters.push_back(std::move(p));
  return plugin("mesh", std::move(parameters));
}
/// One triangle in z = 0; (p1-p0)x(p2-p0) points along +z.
inline Plugin triangle(std::vector<Parameter> more = {}) {
  return mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, std::move(more));
}
/// The square [-1,1]^2 in z = 0, facing +z.
inline Plugin square() {
  return mesh({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, {0, 1, 2, 0, 2, 3});
}

/// A description under construction, the diagnostics of compiling it, and the result.
class SceneTest : public testing::Test {
 protected:
  SceneTest() {
    diagnostics.add_file("scene.lxs");
    description.directory = "/nowhere";
    description.camera = plugin("perspective", {}, 2);
    description.film =
        plugin("fleximage", {integers("xresolution", {64}), integers("yresolution", {64})}, 4);
    description.filter = plugin("box", {}, 8);
  }

  uint32_t material(Plugin p) {
    description.materials.push_back({"", std::move(p)});
    return uint32_t(description.materials.size() - 1);
  }
  uint32_t area_light(std::vector<Parameter> parameters) {
    description.area_lights.push_back({plugin("area", std::move(parameters), 30)});
    return uint32_t(description.area_lights.size() - 1);
  }
  ShapeEntry& shape(Plugin p, Matrix to_world = Matrix(1.)) {
    ShapeEntry entry;
    entry.plugin = std::move(p);
    entry.to_world = to_world;
    description.shapes.push_back(std::move(entry));
    return description.shapes.back();
  }
  void light(Plugin p, Matrix to_world = Matrix(1.)) {
    description.lights.push_back({std::move(p), to_world});
  }
  Scene compile() { return compile_scene(description, options, pool, diagnostics); }
  /// The message of the Error that compiling throws.
  std::string error() {
    try {
      compile();
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  }
  bool said(const std::string& line) const {
    return std::find(messages.begin(), messages.end(), line) != messages.end();
  }
  std::string all_said() const {
    std::string all;
    for (const std::string& m : messages) all += m + "\n";
    return all;
  }

  std::vector<std::string> messages;
  Diagnostics diagnostics{[this](Severity, std::string_view line) { messages.emplace_back(line); }};
  Description description;
  CompileOptions options;
  ThreadPool pool{1};
};

#define EXPECT_SAID(line) EXPECT_TRUE(said(line)) << "said instead:\n" << all_said()
#define EXPECT_SILENT() EXPECT_EQ(all_said(), "")

}  // namespace yat
