// checkerboard, bilerp, uv, uvmask, dots, brick, harlequin, vertex colours (lxs 8.4).

#include <fmt/format.h>

#include <algorithm>

#include "kernels/textures/bands.h"
#include "kernels/textures/bilerp.h"
#include "kernels/textures/brick.h"
#include "kernels/textures/checkerboard.h"
#include "kernels/textures/dots.h"
#include "kernels/textures/harlequin.h"
#include "kernels/textures/uv_colour.h"
#include "kernels/textures/uv_mask.h"
#include "scene/compile_textures.h"

namespace yat {

namespace {

uint32_t most_outputs(const TextureGraph& graph,
                      std::initializer_list<TextureGraph::Input> inputs) {
  uint32_t most = 1;
  for (const TextureGraph::Input& in : inputs) most = std::max(most, graph[in.node].outputs);
  return most;
}

/// What is one of several textures, or between them; about in the middle.
TextureValue one_of(const TextureContext& c, std::initializer_list<TextureValue> values) {
  TextureValue out;
  out.colour = c.colour();
  out.least = 1e300;
  out.most = -1e300;
  for (const TextureValue& v : values) {
    out.constant += v.constant / double(values.size());
    out.least = std::min(out.least, v.least);
    out.most = std::max(out.most, v.most);
  }
  return out;
}

/// A node that picks between two inputs of the texture's kind by a mapping.
template <template <template <class> class> class Record>
TextureValue choice(TextureContext& c, StepKind kind, uint32_t form,
                    const TextureGraph::Input& mapping, const TextureValue& a,
                    const TextureValue& b) {
  if (!a.varies() && !b.varies() && a.constant == b.constant) return a;
  TextureValue value = one_of(c, {a, b});
  const TextureGraph::Input x = c.textures.node(a), y = c.textures.node(b);
  value.node = c.graph().add<Record>(kind, form, Record<Value>{0u}, {mapping, x, y},
                                     most_outputs(c.graph(), {x, y}));
  return value;
}

TextureValue checkerboard(TextureContext& c) {
  const int dimension = c.p.integer("dimension", 2);
  c.p.accept({"aamode"});
  if (dimension != 2 && dimension != 3)
    c.diagnostics().error(
        c.p.loc("dimension"),
        fmt::format("{}: \"dimension\" is {}, but can be 2 or 3: 2 is used", c.what(), dimension));
  const bool solid = dimension == 3;
  const TextureGraph::Input mapping = solid ? map_3d(c) : map_2d(c, false);
  return choice<CheckerboardParameters>(c, StepKind::kCheckerboard, solid, mapping,
                                        c.input("tex1", 1), c.input("tex2", 0));
}

TextureValue bilerp(TextureContext& c) {
  const TextureGraph::Input mapping = map_2d(c, false);
  const TextureValue v00 = c.input("v00", 0), v01 = c.input("v01", 1), v10 = c.input("v10", 0),
                     v11 = c.input("v11", 1);
  TextureValue value = one_of(c, {v00, v01, v10, v11});
  if (value.least == value.most) return v00;
  const TextureGraph::Input a = c.textures.node(v00), b = c.textures.node(v01),
                            d = c.textures.node(v10), e = c.textures.node(v11);
  value.node = c.graph().add<BilerpParameters>(StepKind::kBilerp, 0, {0u}, {mapping, a, b, d, e},
                                               most_outputs(c.graph(), {a, b, d, e}));
  return value;
}

/// A node that makes linear Rec.709 in 0..most, as bands.
TextureValue colour_node(TextureContext& c, uint32_t node, const glm::dvec3& mean, double most) {
  TextureValue value;
  value.colour = true;
  value.constant = mean;
  value.least = 0;
  value.most = most;
  value.node = c.graph().add<BandsParameters>(StepKind::kBands, 0, {1.f}, {{node, 0}}, 3);
  return value;
}

/// Textures that are colours whatever kind they are declared to be: the luminance of it in a float.
TextureValue uv(TextureContext& c) {
  const TextureGraph::Input mapping = map_2d(c, false);
  return colour_node(c,
                     c.graph().add<UvColourParameters>(StepKind::kUvColour, 0, {0u}, {mapping}, 3),
                     {.5, .5, 0}, 1);
}

TextureValue harlequin(TextureContext& c) {
  c.diagnostics().note(c.loc(),
                       c.what() +
                           ": colours of a \"harlequin\" are other than LuxRender's, which "
                           "change with every run");
  return colour_node(c, c.graph().add<HarlequinParameters>(StepKind::kHarlequin, 0, {0u}, {}, 3),
                     glm::dvec3(.5), 1);
}

TextureValue uvmask(TextureContext& c) {
  const TextureGraph::Input mapping = map_2d(c, false);
  return choice<UvMaskParameters>(c, StepKind::kUvMask, 0, mapping, c.input("innertex", 1),
                                  c.input("outertex", 0));
}

TextureValue dots(TextureContext& c) {
  const TextureGraph::Input mapping = map_2d(c, false);
  return choice<DotsParameters>(c, StepKind::kDots, 0, mapping, c.input("inside", 1),
                                c.input("outside", 0));
}

/// A number that must be above 0.
float positive(TextureContext& c, std::string_view name, float fallback) {
  const float value = c.p.number(name, fallback);
  if (value > 0) return value;
  c.diagnostics().warning(c.p.loc(name),
                          fmt::format("{}: \"{}\" is {}, but must be above 0: {} is used", c.what(),
                                      name, value, fallback));
  return fallback;
}

TextureValue brick(TextureContext& c) {
  BrickParameters<Value> p{};
  p.width = positive(c, "brickwidth", .3f);
  p.height = positive(c, "brickheight", .1f);
  p.depth = positive(c, "brickdepth", .15f);
  p.mortar = c.p.number("mortarsize", .01f);
  p.run = c.p.number("brickrun", .75f);
  c.p.accept({"brickbevel"});
  const std::string bond = c.p.text("brickbond", "running");
  if (bond == "stacked") {
    p.run = 0;
  } else {
    p.offset_y = -.5f;
    if (bond != "running")
      c.diagnostics().warning(
          c.p.loc("brickbond"),
          fmt::format("{}: bond \"{}\" is laid as \"running\"", c.what(), bond));
  }
  const TextureGraph::Input mapping = map_3d(c);
  const TextureValue bricks = c.input("bricktex", 1), mortar = c.input("mortartex", .2),
                     modulation = c.input("brickmodtex", 1);
  if (modulation.varies())
    c.diagnostics().warning(c.p.loc("brickmodtex"),
                            c.what() +
                                ": \"brickmodtex\" varies within bricks, not from brick to "
                                "brick");
  TextureValue value = one_of(c, {bricks, mortar});
  value.least = std::min({mortar.least, bricks.least * modulation.least,
                          bricks.least * modulation.most, bricks.most * modulation.least});
  value.most =
      std::max({mortar.most, bricks.most * modulation.most, bricks.least * modulation.least});
  const TextureGraph::Input a = c.textures.node(bricks), b = c.textures.node(mortar),
                            m = c.textures.node(modulation);
  value.node = c.graph().add<BrickParameters>(StepKind::kBrick, 0, p, {mapping, a, b, m},
                                              most_outputs(c.graph(), {a, b, m}));
  return value;
}

/// Meshes are read without their vertices' colours.
TextureValue vertex_colour(TextureContext& c) {
  c.p.accept({"channel"});
  c.diagnostics().warning(c.loc(), c.what() + ": colours of vertices are not read: white is used");
  return c.colour() ? TextureValue::of_colour(glm::dvec3(1.)) : TextureValue::number(1);
}

constexpr TextureClass kClasses[] = {
    {"checkerboard", &checkerboard},
    {"bilerp", &bilerp},
    {"uv", &uv},
    {"uvmask", &uvmask},
    {"dots", &dots},
    {"brick", &brick},
    {"harlequin", &harlequin},
    {"hitpointcolor", &vertex_colour},
    {"hitpointgrey", &vertex_colour},
    {"hitpointalpha", &vertex_colour},
};

}  // namespace

std::span<const TextureClass> pattern_textures() {
  return kClasses;
}

}  // namespace yat
