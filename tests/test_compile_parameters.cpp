// Typed access to parameters: conversions, counts, unused names, with exact messages.

#include "scene/parameters.h"
#include "scene_builder.h"

namespace yat {
namespace {

class ParametersTest : public SceneTest {
 protected:
  Parameters& read(std::vector<Parameter> list) {
    plugin_ = plugin("thing", std::move(list));
    return parameters_.emplace(plugin_, "thing \"thing\"", diagnostics);
  }
  Plugin plugin_;
  std::optional<Parameters> parameters_;
};

TEST_F(ParametersTest, ReadsWhatIsDeclared) {
  Parameters& p = read({number("f", 2.5f), integers("i", {7}), text("s", "word"),
                        text("b", "true", ParameterType::kBool), color("c", .1f, .2f, .3f)});
  EXPECT_EQ(p.number("f", 0), 2.5f);
  EXPECT_EQ(p.integer("i", 0), 7);
  EXPECT_EQ(p.text("s", ""), "word");
  EXPECT_TRUE(p.flag("b", false));
  EXPECT_EQ(p.triple("c", ParameterType::kColor, {}),
            glm::dvec3(double(.1f), double(.2f), double(.3f)));
  EXPECT_EQ(p.number("absent", 4), 4.f);
  p.report_unused();
  EXPECT_SILENT();
}

TEST_F(ParametersTest, ConvertsWhereObvious) {
  Parameters& p = read({integers("f", {3}), number("i", 2.75f), number("grey", .5f),
                        numbers(ParameterType::kPoint, "c", {1, 2, 3}), text("b", "false")});
  EXPECT_EQ(p.number("f", 0), 3.f);
  EXPECT_EQ(p.integer("i", 0), 2);
  EXPECT_EQ(p.triple("grey", ParameterType::kColor, {}), glm::dvec3(.5));
  EXPECT_EQ(p.triple("c", ParameterType::kColor, {}), glm::dvec3(1, 2, 3));
  EXPECT_FALSE(p.flag("b", true));
  EXPECT_SAID(
      "scene.lxs:11:2: warning: parameter \"integer f\" of thing \"thing\" should be "
      "\"float f\": the number is used");
  EXPECT_SAID(
      "scene.lxs:12:2: warning: parameter \"float i\" of thing \"thing\" should be "
      "\"integer i\": the number is used without its fraction");
  EXPECT_SAID(
      "scene.lxs:13:2: warning: parameter \"float grey\" of thing \"thing\" should be "
      "\"color grey\": the number is used as a grey");
  EXPECT_SAID(
      "scene.lxs:14:2: warning: parameter \"point c\" of thing \"thing\" should be "
      "\"color c\": the numbers are used");
  EXPECT_SAID(
      "scene.lxs:15:2: warning: parameter \"string b\" of thing \"thing\" should be "
      "\"bool b\": the value is used");
}

TEST_F(ParametersTest, LeavesTheRestAlone) {
  Parameters& p = read({text("f", "3"), number("nan", NAN), color("i", 1, 1, 1)});
  EXPECT_EQ(p.number("f", 9), 9.f);
  EXPECT_EQ(p.integer("nan", 9), 9);
  EXPECT_EQ(p.integer("i", 9), 9);
  EXPECT_SAID(
      "scene.lxs:11:2: warning: parameter \"string f\" of thing \"thing\" should be "
      "\"float f\": the default is used");
}

TEST_F(ParametersTest, ScalarWithSeveralNumbersTakesTheDefault) {
  Parameters& p = read({numbers(ParameterType::kFloat, "fov", {45, 46})});
  EXPECT_EQ(p.number("fov", 90), 90.f);
  EXPECT_SAID(
      "scene.lxs:11:2: warning: parameter \"float fov\" of thing \"thing\" has 2 values "
      "where one is wanted: the default is used");
  Parameters& q = read({numbers(ParameterType::kColor, "Kd", {1, 1, 1, 0, 0, 0})});
  EXPECT_EQ(q.triple("Kd", ParameterType::kColor, glm::dvec3(.9)), glm::dvec3(.9));
  EXPECT_SAID(
      "scene.lxs:11:2: warning: parameter \"color Kd\" of thing \"thing\" has 6 values "
      "where 3 are wanted: the default is used");
}

TEST_F(ParametersTest, UnusedIsSaidOnceWithASuggestion) {
  for (int i = 0; i < 3; ++i) {
    Parameters& p = read({color("kd", 1, 1, 1), number("zzzzzzzz", 1)});
    p.triple("Kd", ParameterType::kColor, {});
    p.report_unused();
  }
  EXPECT_EQ(
      all_said(),
      "scene.lxs:11:2: warning: parameter \"color kd\" of thing \"thing\" is not used (did "
      "you mean \"Kd\"?)\n"
      "scene.lxs:12:2: warning: parameter \"float zzzzzzzz\" of thing \"thing\" is not used\n");
}

TEST_F(ParametersTest, TheLastOneCounts) {
  EXPECT_EQ(read({number("f", 1), number("f", 2)}).number("f", 0), 2.f);
}

}  // namespace
}  // namespace yat
