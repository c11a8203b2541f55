// print_description() writes text that is read as the same description.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene_text.h"

namespace yat {
namespace {

void expect_equal(const Plugin& a, const Plugin& b) {
  EXPECT_EQ(a.type, b.type);
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  for (size_t i = 0; i < a.parameters.size(); ++i) {
    const Parameter &p = a.parameters[i], &q = b.parameters[i];
    EXPECT_EQ(p.type, q.type);
    EXPECT_EQ(p.name, q.name);
    EXPECT_EQ(p.floats, q.floats);
    EXPECT_EQ(p.integers, q.integers);
    EXPECT_EQ(p.texture, q.texture);
    EXPECT_EQ(p.material, q.material);
    if (p.type != ParameterType::kTexture && p.material == 0xffffffffu) {
      EXPECT_EQ(p.strings, q.strings);
    }
  }
}

void expect_equal(const std::optional<Plugin>& a, const std::optional<Plugin>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) expect_equal(*a, *b);
}

/// All but places, and names where `names` is false.
void expect_equal(const Description& a, const Description& b, bool names) {
  expect_equal(a.camera, b.camera);
  expect_equal(a.film, b.film);
  expect_equal(a.filter, b.filter);
  expect_equal(a.sampler, b.sampler);
  expect_equal(a.integrator, b.integrator);
  expect_equal(a.volume_integrator, b.volume_integrator);
  expect_equal(a.accelerator, b.accelerator);
  expect_equal(a.renderer, b.renderer);
  EXPECT_EQ(a.world_to_camera, b.world_to_camera);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (size_t i = 0; i < a.materials.size(); ++i) {
    if (names) {
      EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    }
    expect_equal(a.materials[i].plugin, b.materials[i].plugin);
  }
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (size_t i = 0; i < a.textures.size(); ++i) {
    if (names) {
      EXPECT_EQ(a.textures[i].name, b.textures[i].name);
    }
    EXPECT_EQ(a.textures[i].kind, b.textures[i].kind);
    EXPECT_EQ(a.textures[i].to_world, b.textures[i].to_world);
    expect_equal(a.textures[i].plugin, b.textures[i].plugin);
  }
  ASSERT_EQ(a.volumes.size(), b.volumes.size());
  for (size_t i = 0; i < a.volumes.size(); ++i) {
    if (names) {
      EXPECT_EQ(a.volumes[i].name, b.volumes[i].name);
    }
    expect_equal(a.volumes[i].plugin, b.volumes[i].plugin);
  }
  ASSERT_EQ(a.area_lights.size(), b.area_lights.size());
  for (size_t i = 0; i < a.area_lights.size(); ++i)
    expect_equal(a.area_lights[i].plugin, b.area_lights[i].plugin);
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (size_t i = 0; i < a.shapes.size(); ++i) {
    const ShapeEntry &s = a.shapes[i], &t = b.shapes[i];
    expect_equal(s.plugin, t.plugin);
    EXPECT_EQ(s.to_world, t.to_world) << i;
    EXPECT_EQ(s.reverse_orientation, t.reverse_orientation) << i;
    EXPECT_EQ(s.material, t.material) << i;
    EXPECT_EQ(s.area_light, t.area_light) << i;
    EXPECT_EQ(s.object, t.object) << i;
    EXPECT_EQ(s.interior, t.interior) << i;
    EXPECT_EQ(s.exterior, t.exterior) << i;
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (size_t i = 0; i < a.lights.size(); ++i) {
    expect_equal(a.lights[i].plugin, b.lights[i].plugin);
    EXPECT_EQ(a.lights[i].to_world, b.lights[i].to_world);
  }
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (size_t i = 0; i < a.objects.size(); ++i)
    if (names) {
      EXPECT_EQ(a.objects[i].name, b.objects[i].name);
    }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].object, b.instances[i].object);
    EXPECT_EQ(a.instances[i].material, b.instances[i].material);
    EXPECT_EQ(a.instances[i].to_world, b.instances[i].to_world);
  }
}

void round_trip(const std::string& text, bool names) {
  const ReadResult first = read_text(text);
  ASSERT_FALSE(first.ended) << first.said.back();
  const std::string printed = print_description(first.scene);
  const ReadResult second = read_text(printed);
  ASSERT_FALSE(second.ended) << second.said.back() << printed;
  SCOPED_TRACE(printed);
  expect_equal(first.scene, second.scene, names);
  EXPECT_EQ(print_description(second.scene), printed);
}

TEST(RoundTrip, MaterialsOfMaterials) {
  round_trip(R"(
WorldBegin
MakeNamedMaterial "a" "string type" ["matte"]
MakeNamedMaterial "a" "string type" ["mix"] "string namedmaterial1" ["a"] "string namedmaterial2" ["no"]
Material "layered" "string namedmaterial1" ["a"] "string namedmaterial3" ["a"]
Shape "sphere"
WorldEnd)",
             false);
}

TEST(RoundTrip, AllConstructs) {
  round_trip(R"(
Renderer "sampler" Sampler "random" "integer pixelsamples" [4]
Accelerator "kdtree" SurfaceIntegrator "path" "integer maxdepth" [10]
VolumeIntegrator "multi" PixelFilter "mitchell" "float B" [.333333333333]
Film "fleximage" "integer xresolution" [640] "bool write_png" ["true"] "string filename" ["a\"b\\c"]
Scale -1 1 1 LookAt 0.1 -5 2 0 0 1 0 0 1
Camera "perspective" "float fov" [35.489342506624475] "float screenwindow" [-1 1 -.75 .75]
WorldBegin
Rotate 33 1 2 3
Texture "base" "color" "imagemap" "string filename" ["p.png"] "float gamma" [2.2]
Texture "grey" "float" "scale" "texture tex1" ["base"] "float tex2" [.1]
Identity
MakeNamedMaterial "wall" "string type" ["matte"] "texture Kd" ["base"] "float sigma" [12.5]
MakeNamedMaterial "lamp" "string type" ["null"]
LightSource "infinite" "color L" [1 2 3]
AttributeBegin
  Translate 1 2 3e-7
  NamedMaterial "wall"
  Shape "mesh" "integer triindices" [0 1 2] "point P" [0 0 0 1 0 0 0 .1 0] "normal N" [0 0 1 0 0 1 0 0 1] "vector v" [1 2 3]
  LightSource "point" "point from" [1 2 3]
  AreaLightSource "area" "texture L" ["base"] "float gain" [1e-30]
  Shape "sphere" "float radius" [16777216]
  AttributeBegin
    ReverseOrientation
    AreaLightSource "area" "float power" [100]
    Shape "disk"
  AttributeEnd
  NamedMaterial "lamp"
  Shape "sphere"
AttributeEnd
Shape "sphere"
AreaLightSource "area" "float never" [1]
AreaLightSource "area" "float outer" [2]
ObjectBegin "empty" ObjectEnd
ObjectBegin "two"
  Shape "a"
  AreaLightSource "area" "float inner" [3]
  Shape "b"
  Rotate 90 0 1 0
  NamedMaterial "wall"
  Shape "c"
ObjectEnd
Shape "d"
ObjectInstance "two"
NamedMaterial "lamp"
Translate 0 0 9
ObjectInstance "two"
ObjectInstance "empty"
WorldEnd
)",
             true);
}

TEST(RoundTrip, NamesThatStandForSeveralThings) {
  round_trip(R"(
WorldBegin
Material "matte" "texture Kd" ["t"]
Shape "before"
Texture "t" "float" "one"
Texture "t" "color" "two" "texture tex1" ["t"]
Texture "t 2" "color" "three"
Material "glass" "texture Kd" ["t"] "texture sigma" ["t"] "texture Ks" ["t 2"]
AttributeBegin
  Texture "t" "color" "four" "texture tex1" ["t"]
  Texture "gone" "color" "five"
  MakeNamedMaterial "m" "string type" ["matte"] "texture Kd" ["t"]
  NamedMaterial "m"
  MakeNamedMaterial "m" "string type" ["mirror"]
  Shape "first m"
  NamedMaterial "m"
  Shape "second m"
  ObjectBegin "o" Shape "x" ObjectEnd
  ObjectInstance "o"
  ObjectBegin "o" Shape "y" ObjectEnd
  ObjectInstance "o"
AttributeEnd
Material "matte" "texture Kd" ["gone"] "texture Ks" ["t"]
Shape "after"
WorldEnd
)",
             false);
}

TEST(RoundTrip, LampsThatShapesShareAcrossBlocks) {
  round_trip(R"(
WorldBegin
AttributeBegin
AreaLightSource "a"
AttributeBegin AreaLightSource "unused" AttributeEnd
AttributeBegin AreaLightSource "b" Shape "1" AttributeEnd
ObjectBegin "o" Shape "2" AreaLightSource "c" Shape "3" AttributeBegin AreaLightSource "d" Shape "4" AttributeEnd Shape "5" ObjectEnd
Shape "6"
AttributeEnd
Shape "7"
ObjectBegin "p" Shape "8" ObjectEnd
AreaLightSource "e" Shape "9"
AreaLightSource "f" Shape "10"
WorldEnd
)",
             true);
}

TEST(RoundTrip, EmptyScene) {
  round_trip("WorldBegin WorldEnd", true);
}

}  // namespace
}  // namespace yat
