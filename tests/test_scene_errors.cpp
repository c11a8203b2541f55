// Bad input, and the exact text that is said of it: one line, with a place and a way out.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene_text.h"

namespace yat {
namespace {

struct Case {
  std::string text;
  std::vector<std::string> said;
  bool ended;  ///< by an error: no description
};

// clang-format off
const std::vector<Case>& cases() {
  static const std::vector<Case> table = {
      {R"()",
       {R"(t.lxs:1:1: error: the file has no WorldBegin, so it holds no scene)"},
       true},
      {R"(WorldBegin
)",
       {R"(t.lxs:2:1: error: WorldEnd is missing, the scene may be cut off, add it at the end)"},
       true},
      {R"(Shape "x"
)",
       {R"(t.lxs:1:1: error: Shape is ignored before WorldBegin, put it behind)",
        R"(t.lxs:2:1: error: the file has no WorldBegin, so it holds no scene)"},
       true},
      {R"(Identity 5
)",
       {R"(t.lxs:1:10: error: expected a directive, found the number 5, remove it or write the directive it belongs to before it)"},
       true},
      {R"("stray"
)",
       {R"(t.lxs:1:1: error: expected a directive, found the string "stray", remove it or write the directive it belongs to before it)"},
       true},
      {R"([1]
)",
       {R"(t.lxs:1:1: error: expected a directive, found [, remove it or write the directive it belongs to before it)"},
       true},
      {R"(attributebegin
)",
       {R"(t.lxs:1:1: error: unknown directive attributebegin (did you mean "AttributeBegin"?))"},
       true},
      {R"(Shpe "x"
)",
       {R"(t.lxs:1:1: error: unknown directive Shpe (did you mean "Shape"?))"},
       true},
      {R"(Frobnicate
)",
       {R"(t.lxs:1:1: error: unknown directive Frobnicate, remove it or correct its spelling)"},
       true},
      {R"(Include "x.lxs"
)",
       {R"(t.lxs:1:9: error: Include cannot be used here, the scene must be in one text)"},
       true},
      {R"(Include 5
)",
       {R"(t.lxs:1:9: error: Include needs a file name in quotes, found the number 5)"},
       true},
      {R"(WorldBegin
Shape "mesh
WorldEnd
)",
       {R"~(t.lxs:2:7: error: the string that starts here has no end on its line, add the closing ")~"},
       true},
      {R"(WorldBegin
Shape "me
sh"
WorldEnd
)",
       {R"~(t.lxs:2:7: error: the string that starts here has no end on its line, add the closing ")~"},
       true},
      {R"(WorldBegin
Shape 5
WorldEnd
)",
       {R"(t.lxs:2:7: error: Shape needs a string in quotes, found the number 5, write Shape "type" parameters)"},
       true},
      {R"(WorldBegin
Shape mesh
WorldEnd
)",
       {R"(t.lxs:2:7: error: Shape needs a string in quotes, found the word mesh, write Shape "type" parameters)"},
       true},
      {R"(Translate 1 2
WorldBegin WorldEnd)",
       {R"(t.lxs:2:1: error: Translate needs a number, found the word WorldBegin, write Translate x y z)"},
       true},
      {R"(Translate [1 2 3]
)",
       {R"(t.lxs:1:11: error: Translate needs a number, found [, write Translate x y z)"},
       true},
      {R"(Transform 1 2
)",
       {R"(t.lxs:1:11: error: Transform needs [, found the number 1, write Transform [16 numbers])"},
       true},
      {R"(Transform [1 2 3]
)",
       {R"(t.lxs:1:11: error: Transform needs 16 numbers, found 3, write Transform [16 numbers])"},
       true},
      {R"(Transform ["a"]
)",
       {R"(t.lxs:1:12: error: Transform needs numbers and ], found the string "a", write Transform [16 numbers])"},
       true},
      {R"(LookAt 0 0 0 0 0 1 0 0
Camera "perspective"
)",
       {R"(t.lxs:2:1: error: LookAt needs a number, found the word Camera, write LookAt eye_x eye_y eye_z look_x look_y look_z up_x up_y up_z)"},
       true},
      {R"(WorldBegin
Shape "s", "float a" [1, 2];
WorldEnd
)",
       {R"(t.lxs:2:10: warning: character ',' has no meaning here, skipped like any further ones in this file)"},
       false},
      {R"(WorldBegin
Shape "s" "float a" [1 // 2]
WorldEnd
)",
       {R"(t.lxs:2:24: warning: character '/' has no meaning here, skipped like any further ones in this file)"},
       false},
      {R"(WorldBegin
Shape "s" "float radius" [0x10]
WorldEnd
)",
       {R"(t.lxs:2:27: error: 0x10 is not a number, write digits with an optional point and exponent)"},
       true},
      {R"(WorldBegin
Shape "s" "float radius" [1e400]
WorldEnd
)",
       {R"(t.lxs:2:27: error: the number 1e400 is too large for a 32-bit float, write a smaller one)"},
       true},
      {R"(WorldBegin
Shape "s" "float radius" [1e39]
WorldEnd
)",
       {R"(t.lxs:2:27: error: the number 1e39 is too large for a 32-bit float, write a smaller one)"},
       true},
      {R"(WorldBegin
Translate 1e400 0 0
WorldEnd
)",
       {R"(t.lxs:2:11: error: the number 1e400 is too large for a 64-bit float, write a smaller one)"},
       true},
      {R"(WorldBegin
Shape "s" "float radius" [nan]
WorldEnd
)",
       {R"(t.lxs:2:27: error: parameter "float radius" holds nan, write a finite number)"},
       true},
      {R"(WorldBegin
Shape "s" "float radius" [-inf]
WorldEnd
)",
       {R"(t.lxs:2:27: error: -inf is not a number, write digits with an optional point and exponent)"},
       true},
      {R"(WorldBegin
Shape "s" "float radius" [1.2.3]
WorldEnd
)",
       {R"(t.lxs:2:27: error: 1.2.3 is not a number, write digits with an optional point and exponent)"},
       true},
      {R"(WorldBegin
Shape "s" "float radius" nan
WorldEnd
)",
       {R"(t.lxs:2:26: error: parameter "float radius" has no value, found the word nan in its place, write "float radius" [value])"},
       true},
      {R"(WorldBegin
Shape "s" "float radius" [1e]
WorldEnd
)",
       {R"(t.lxs:2:27: error: 1e is not a number, write digits with an optional point and exponent)"},
       true},
      {R"(WorldBegin
Shape "s" "integer n" [2147483648]
WorldEnd
)",
       {R"(t.lxs:2:24: error: the number 2147483648 is too large for a 32-bit integer, write a smaller one)"},
       true},
      {R"(WorldBegin
Shape "s" "integer n" [1.5]
WorldEnd
)",
       {R"(t.lxs:2:24: warning: 1.5 is not an integer, taken as 1)"},
       false},
      {R"(WorldBegin
Shape "s" "integer n" [99999999999999999999]
WorldEnd
)",
       {R"(t.lxs:2:24: error: the number 99999999999999999999 is too large for a 32-bit integer, write a smaller one)"},
       true},
      {R"(WorldBegin
Shape "s" "integer n" [1e10]
WorldEnd
)",
       {R"(t.lxs:2:24: error: the number 1e10 is too large for a 32-bit integer, write a smaller one)"},
       true},
      {R"(WorldBegin
Shape "s" "bool smooth" "true"
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "bool smooth" has no brackets, LuxRender would ignore it, write "bool smooth" ["true"])"},
       false},
      {R"(WorldBegin
Shape "s" "bool smooth" ["yes"]
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "bool smooth" is "yes", taken as false, write "true" or "false")"},
       false},
      {R"(WorldBegin
Shape "s" "bool smooth" [1]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "bool smooth" needs "true" or "false", not numbers, skipped)"},
       false},
      {R"(WorldBegin
Shape "s" "bool smooth" [true]
WorldEnd
)",
       {R"(t.lxs:2:26: error: parameter "bool smooth" holds true without quotes, write ["true"])"},
       true},
      {R"(WorldBegin
Shape "s" "float a" [1 "x"]
WorldEnd
)",
       {R"(t.lxs:2:24: error: parameter "float a" mixes numbers and strings, found the string "x", use one kind)"},
       true},
      {R"(WorldBegin
Shape "s" "string a" ["x" 1]
WorldEnd
)",
       {R"(t.lxs:2:27: error: parameter "string a" mixes numbers and strings, found the number 1, use one kind)"},
       true},
      {R"(WorldBegin
Shape "s" "float a" []
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "float a" has an empty value, taken as not given)"},
       false},
      {R"(WorldBegin
Shape "s" "float a" ["x"]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "float a" needs numbers, not strings, skipped)"},
       false},
      {R"(WorldBegin
Shape "s" "string a" [1]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "string a" needs strings, not numbers, skipped)"},
       false},
      {R"(WorldBegin
Shape "s" "texture a" ["x" "y"]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "texture a" needs the name of one texture, skipped)"},
       false},
      {R"(WorldBegin
Shape "s" "texture a" [1]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "texture a" needs the name of one texture, skipped)"},
       false},
      {R"(WorldBegin
Shape "s" "point P" [1 2 3 4]
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "point P" has 4 numbers, which is no multiple of 3, the last 1 left out)"},
       false},
      {R"(WorldBegin
Shape "s" "point P" [1 2]
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "point P" has 2 numbers, which is no multiple of 3, skipped)"},
       false},
      {R"(WorldBegin
Shape "s" "float a" [1] "float a" [2]
WorldEnd
)",
       {R"(t.lxs:2:25: warning: parameter "float a" is given twice, this one counts and the one at t.lxs:2:11 does not, remove one)"},
       false},
      {R"(WorldBegin
Shape "s" "spectrum Kd" [1 2 3]
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "spectrum Kd" read as "color Kd", write that)"},
       false},
      {R"(WorldBegin
Shape "s" "rgb Kd" [1 2]
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "rgb Kd" has 2 numbers, which is no multiple of 3, skipped)"},
       false},
      {R"(WorldBegin
Shape "s" "blackbody L" [6500]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "blackbody L" has an unknown type, skipped, types are integer, float, bool, point, vector, normal, color, string and texture)"},
       false},
      {R"(WorldBegin
Shape "s" "flaot a" [1]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "flaot a" has an unknown type (did you mean "float"?), skipped, types are integer, float, bool, point, vector, normal, color, string and texture)"},
       false},
      {R"(WorldBegin
Shape "s" "a" [1]
WorldEnd
)",
       {R"(t.lxs:2:11: error: parameter "a" has no type or no name, skipped, write "type name" as in "float fov")"},
       false},
      {R"(WorldBegin
Shape "s" "floats a" [1]
WorldEnd
)",
       {R"(t.lxs:2:11: warning: type of "floats a" taken as float, write that)"},
       false},
      {R"(WorldBegin
Shape "s" "float a"
WorldEnd
)",
       {R"(t.lxs:3:1: error: parameter "float a" has no value, found the word WorldEnd in its place, write "float a" [value])"},
       true},
      {R"(WorldBegin
Shape "s" "float a" "float b" [1]
WorldEnd
)",
       {R"(t.lxs:2:21: error: parameter "float a" has no value, found the string "float b" in its place, write "float a" [value])"},
       true},
      {R"(WorldBegin
Shape "s" "float a" [1
Shape "t"
WorldEnd
)",
       {R"(t.lxs:3:1: error: the array of "float a" opened at t.lxs:2:21 is not closed, found the word Shape, add ])"},
       true},
      {R"(WorldBegin
Shape "s" "float a" [1 [2]]
WorldEnd
)",
       {R"(t.lxs:2:24: error: the array of "float a" opened at t.lxs:2:21 is not closed, found [, add ])"},
       true},
      {R"(WorldBegin
Shape "s" "color Kd" "t"
WorldEnd
)",
       {R"(t.lxs:2:11: warning: parameter "color Kd" names a texture, write "texture Kd")",
        R"(t.lxs:2:11: error: no texture "t", "Kd" keeps its default)"},
       false},
      {R"(WorldBegin
AttributeEnd
WorldEnd
)",
       {R"(t.lxs:2:1: warning: AttributeEnd without AttributeBegin, ignored, remove it)"},
       false},
      {R"(WorldBegin
TransformEnd
WorldEnd
)",
       {R"(t.lxs:2:1: warning: TransformEnd without TransformBegin, ignored, remove it)"},
       false},
      {R"(WorldBegin
ObjectEnd
WorldEnd
)",
       {R"(t.lxs:2:1: warning: ObjectEnd without ObjectBegin, ignored, remove it)"},
       false},
      {R"(WorldBegin
AttributeBegin
WorldEnd
)",
       {R"(t.lxs:3:1: warning: AttributeBegin at t.lxs:2:1 is still open when the world ends, add AttributeEnd)"},
       false},
      {R"(WorldBegin
AttributeBegin
TransformBegin
AttributeEnd
WorldEnd
)",
       {R"(t.lxs:4:1: warning: AttributeEnd ends the block begun at t.lxs:2:1, but TransformBegin at t.lxs:3:1 is still open, ended with it, add TransformEnd)"},
       false},
      {R"(WorldBegin
TransformBegin
AttributeBegin
TransformEnd
WorldEnd
)",
       {R"(t.lxs:4:1: warning: TransformEnd ends the block begun at t.lxs:2:1, but AttributeBegin at t.lxs:3:1 is still open, ended with it, add AttributeEnd)"},
       false},
      {R"(WorldBegin
ObjectBegin "a"
AttributeEnd
ObjectEnd
WorldEnd
)",
       {R"(t.lxs:3:1: warning: AttributeEnd without AttributeBegin, ignored, remove it)"},
       false},
      {R"(WorldBegin
Film "fleximage"
WorldEnd
)",
       {R"(t.lxs:2:1: error: Film is ignored in the world, put it before WorldBegin at t.lxs:1:1)"},
       false},
      {R"(AttributeBegin
WorldBegin
WorldEnd
)",
       {R"(t.lxs:1:1: error: AttributeBegin is ignored before WorldBegin, put it behind)"},
       false},
      {R"(WorldEnd
WorldBegin
WorldEnd
)",
       {R"(t.lxs:1:1: error: WorldEnd before WorldBegin, ignored)"},
       false},
      {R"(WorldBegin
WorldBegin
WorldEnd
)",
       {R"(t.lxs:2:1: error: a second WorldBegin, ignored, the world began at t.lxs:1:1)"},
       false},
      {R"(Film "a"
Film "b"
WorldBegin
WorldEnd
)",
       {R"(t.lxs:2:1: warning: a second Film, the one at t.lxs:1:1 is forgotten, remove one)"},
       false},
      {R"(WorldBegin
NamedMaterial "x"
WorldEnd
)",
       {R"(t.lxs:2:1: error: no material "x", the current one stays)"},
       false},
      {R"(WorldBegin
MakeNamedMaterial "Wall" "string type" ["matte"]
NamedMaterial "wall"
WorldEnd
)",
       {R"(t.lxs:3:1: error: no material "wall" (did you mean "Wall"?), the current one stays)"},
       false},
      {R"(WorldBegin
AttributeBegin
MakeNamedMaterial "a" "string type" ["matte"]
AttributeEnd
NamedMaterial "a"
WorldEnd
)",
       {R"(t.lxs:5:1: error: no material "a", it was defined at t.lxs:3:1 in a block that has ended, define it outside, the current one stays)"},
       false},
      {R"(WorldBegin
MakeNamedMaterial "a"
WorldEnd
)",
       {R"(t.lxs:2:1: warning: material "a" has no "string type", taken as matte)"},
       false},
      {R"(WorldBegin
MakeNamedMaterial "a" "string type" ["matte"]
MakeNamedMaterial "a" "string type" ["glass"]
WorldEnd
)",
       {R"(t.lxs:3:1: warning: material "a" is defined again, the one at t.lxs:2:1 stays with what used it before)"},
       false},
      {R"(WorldBegin
Material "matte" "texture Kd" ["brik"]
WorldEnd
)",
       {R"(t.lxs:2:18: error: no texture "brik", "Kd" keeps its default)"},
       false},
      {R"(WorldBegin
Texture "brick" "color" "imagemap"
Material "matte" "texture Kd" ["brik"]
WorldEnd
)",
       {R"(t.lxs:3:18: error: no texture "brik" (did you mean "brick"?), "Kd" keeps its default)"},
       false},
      {R"(WorldBegin
AttributeBegin
Texture "b" "color" "imagemap"
AttributeEnd
Material "matte" "texture Kd" ["b"]
WorldEnd
)",
       {R"(t.lxs:5:18: error: no texture "b", it was defined at t.lxs:3:1 in a block that has ended, define it outside, "Kd" keeps its default)"},
       false},
      {R"(WorldBegin
Texture "b" "colour" "imagemap"
WorldEnd
)",
       {R"(t.lxs:2:1: error: texture "b": unknown kind "colour" (did you mean "color"?), skipped, kinds are float, color and fresnel)"},
       false},
      {R"(WorldBegin
Texture "b" "spectrum" "imagemap"
WorldEnd
)",
       {R"(t.lxs:2:1: warning: texture "b": kind "spectrum" is old, write "color")"},
       false},
      {R"(WorldBegin
Texture "b" "color" "x"
Texture "b" "color" "y"
WorldEnd
)",
       {R"(t.lxs:3:1: warning: color texture "b" is defined again, the one at t.lxs:2:1 stays with what used it before)"},
       false},
      {R"(WorldBegin
ObjectInstance "o"
WorldEnd
)",
       {R"(t.lxs:2:1: error: no object "o", nothing is placed)"},
       false},
      {R"(WorldBegin
ObjectBegin "obj"
ObjectEnd
ObjectInstance "Obj"
WorldEnd
)",
       {R"(t.lxs:4:1: error: no object "Obj" (did you mean "obj"?), nothing is placed)"},
       false},
      {R"(WorldBegin
ObjectBegin "o"
ObjectInstance "o"
ObjectEnd
WorldEnd
)",
       {R"(t.lxs:3:1: error: ObjectInstance inside object "o" is ignored, end the object before)"},
       false},
      {R"(WorldBegin
ObjectBegin "a"
ObjectBegin "b"
ObjectEnd
ObjectEnd
WorldEnd
)",
       {R"(t.lxs:3:1: error: object "b" begins inside object "a", its shapes go to the outer one, end that before)"},
       false},
      {R"(WorldBegin
ObjectBegin "a"
ObjectEnd
ObjectBegin "a"
ObjectEnd
WorldEnd
)",
       {R"(t.lxs:4:1: warning: object "a" is defined again, the one at t.lxs:2:1 stays with its instances so far)"},
       false},
      {R"(WorldBegin
CoordSysTransform "c"
WorldEnd
)",
       {R"(t.lxs:2:1: warning: no coordinate system "c", CoordSysTransform ignored)"},
       false},
      {R"(WorldBegin
CoordinateSystem "lamp"
CoordSysTransform "Lamp"
WorldEnd
)",
       {R"(t.lxs:3:1: warning: no coordinate system "Lamp" (did you mean "lamp"?), CoordSysTransform ignored)"},
       false},
      {R"(WorldBegin
Interior "v"
WorldEnd
)",
       {R"(t.lxs:2:1: error: no volume "v", Interior is ignored)"},
       false},
      {R"(WorldBegin
MakeNamedVolume "v" "clear"
MakeNamedVolume "v" "clear"
WorldEnd
)",
       {R"(t.lxs:3:1: warning: volume "v" is defined again, the one at t.lxs:2:1 stays with what used it before)"},
       false},
      {R"(WorldBegin
Volume "homogeneous"
WorldEnd
)",
       {R"(t.lxs:2:1: warning: Volume "homogeneous" is not supported, ignored, use MakeNamedVolume with Interior)"},
       false},
      {R"(WorldBegin
PortalShape "mesh"
WorldEnd
)",
       {R"(t.lxs:2:1: warning: PortalShape only helps LuxRender to sample, it is ignored)"},
       false},
      {R"(WorldBegin
MotionBegin [0 1]
Translate 1 0 0
Translate 2 0 0
MotionEnd
WorldEnd
)",
       {R"(t.lxs:2:1: warning: motion is not supported, the transform at the first time is used)"},
       false},
      {R"(WorldBegin
MotionEnd
WorldEnd
)",
       {R"(t.lxs:2:1: warning: MotionEnd without MotionBegin, ignored, remove it)"},
       false},
      {R"(WorldBegin
MotionBegin [0]
WorldEnd
)",
       {R"(t.lxs:2:1: warning: motion is not supported, the transform at the first time is used)",
        R"(t.lxs:3:1: warning: MotionBegin at t.lxs:2:1 is still open when the world ends, add MotionEnd)"},
       false},
      {R"(WorldBegin
MotionBegin [0]
MotionBegin [0]
MotionEnd
WorldEnd
)",
       {R"(t.lxs:2:1: warning: motion is not supported, the transform at the first time is used)",
        R"(t.lxs:3:1: warning: MotionBegin inside the one at t.lxs:2:1, ignored)"},
       false},
      {R"(LookAt 0 0 0 0 0 0 0 0 1
WorldBegin
WorldEnd
)",
       {R"(t.lxs:1:1: warning: LookAt: the eye and the point looked at are the same, looking along +z)"},
       false},
      {R"(LookAt 0 0 0 0 0 1 0 0 1
WorldBegin
WorldEnd
)",
       {R"(t.lxs:1:1: warning: LookAt: up is parallel to the viewing direction, another up is used)"},
       false},
      {R"(LookAt 0 0 0 0 0 1 0 0 0
WorldBegin
WorldEnd
)",
       {R"(t.lxs:1:1: warning: LookAt: up has no direction, another up is used)"},
       false},
      {R"(WorldBegin
Rotate 90 0 0 0
WorldEnd
)",
       {R"(t.lxs:2:1: warning: Rotate about an axis 0 0 0, ignored, give the axis a direction)"},
       false},
      {R"(WorldBegin
Scale 1e300 1 1
Scale 1e300 1 1
WorldEnd
)",
       {R"(t.lxs:3:1: error: Scale makes numbers too large for the transform, ignored)"},
       false},
      {R"(WorldBegin
Transform [2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 2]
WorldEnd
)",
       {R"(t.lxs:2:1: warning: the last number of Transform is 2 instead of 1, all are divided by it)"},
       false},
      {R"(WorldBegin
Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]
WorldEnd
)",
       {R"(t.lxs:2:1: warning: Transform is a projection, its numbers 4, 8, 12 and 16 are taken as 0 0 0 1)"},
       false},
      {R"(WorldBegin
WorldEnd
Shape "x"
)",
       {R"(t.lxs:2:1: warning: what follows WorldEnd is ignored)"},
       false},
      {R"(WorldBegin
Shape "s" "string filename" ["C:\trees\new.png"]
WorldEnd
)",
       {R"(t.lxs:2:30: warning: the backslashes in "C:\trees\new.png" are taken as folder separators, write / instead)"},
       false},
      {R"(WorldBegin
Shape "s" "float \nx
WorldEnd
)",
       {R"~(t.lxs:2:11: error: the string that starts here has no end on its line, add the closing ")~"},
       true},
  };
  return table;
}
// clang-format on

TEST(SceneErrors, SayExactlyThis) {
  for (const Case& c : cases()) {
    const ReadResult result = read_text(c.text);
    EXPECT_EQ(result.said, c.said) << c.text;
    EXPECT_EQ(result.ended, c.ended) << c.text;
  }
}

TEST(SceneErrors, EveryMessageIsOneLineWithAPlaceAndASeverity) {
  for (const Case& c : cases())
    for (const std::string& line : read_text(c.text).said) {
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
      EXPECT_EQ(line.rfind("t.lxs:", 0), 0u) << line;
      EXPECT_TRUE(line.find(": error: ") != std::string::npos ||
                  line.find(": warning: ") != std::string::npos)
          << line;
    }
}

TEST(SceneErrors, EveryTruncationOfAScenePlacesItsError) {
  const std::string text =
      "Film \"fleximage\" \"integer xresolution\" [64]\nWorldBegin\nAttributeBegin\nRotate 90 0 0 "
      "1\nShape \"mesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"integer triindices\" [0 1 "
      "2]\nAttributeEnd\nWorldEnd";
  EXPECT_FALSE(read_text(text).ended);
  for (size_t n = 0; n < text.size(); ++n) {
    const ReadResult result = read_text(text.substr(0, n));
    ASSERT_TRUE(result.ended) << n;
    EXPECT_EQ(result.said.back().rfind("t.lxs:", 0), 0u) << result.said.back();
  }
}

TEST(SceneErrors, ManyUnknownNamesTakeLinearTime) {
  // Each of these would be compared with each of those.
  std::string text;
  for (int i = 0; i < 20000; ++i) {
    const std::string n = std::to_string(i);
    text += "MakeNamedMaterial \"m" + n + "\" \"string type\" [\"matte\"]\nNamedMaterial \"x" + n +
            "\"\n";
  }
  EXPECT_EQ(read_world(text).said.size(), 20000u);
}

TEST(SceneErrors, OfManyParametersTheRepeatedOneIsFound) {
  std::string text = "Shape \"s\"";
  for (int i = 0; i < 50000; ++i) text += " \"float p" + std::to_string(i) + "\" [1]";
  text += " \"float p49999\" [2]";
  const ReadResult result = read_world(text);
  ASSERT_EQ(result.said.size(), 1u);
  ASSERT_EQ(result.scene.shapes[0].plugin.parameters.size(), 50000u);
  EXPECT_EQ(result.scene.shapes[0].plugin.parameters.back().floats[0], 2);
}

}  // namespace
}  // namespace yat
