// Materials that are made of others: what becomes of them, and what is said.

#include "kernels/materials/all.h"
#include "scene_builder.h"

namespace yat {
namespace {

class CompileComposite : public SceneTest {
 protected:
  CompileComposite() {
    light(plugin("point", {}));
    hole = material(plugin("null", {}));
    solid = material(plugin("matte", {}));
    mirror = material(plugin("mirror", {}));
  }
  static Parameter made_of(std::string name, uint32_t row) {
    Parameter p = text(std::move(name), "name");
    p.material = row;
    return p;
  }
  uint32_t mix(uint32_t a, uint32_t b, float amount) {
    return material(plugin("mix", {made_of("namedmaterial1", a), made_of("namedmaterial2", b),
                                   number("amount", amount)}));
  }
  Scene with(uint32_t m) {
    description.shapes.clear();
    shape(square()).material = m;
    shape(square(), glm::translate(Matrix(1.), glm::dvec3(0, 0, 3)));
    return compile();
  }
  /// The bin of the shape that `with` gives the material.
  static const Bin& bin(const Scene& scene) { return scene.bins[scene.prim_bin[0]]; }
  uint32_t hole = 0, solid = 0, mirror = 0;
};

TEST_F(CompileComposite, FormsAreSharedAndKnowWhatPasses) {
  Scene scene = with(mix(solid, mirror, .25f));
  EXPECT_EQ(bin(scene).material, MaterialKind::kMix);
  EXPECT_EQ(bin(scene).passing, Passing::kSolid);
  EXPECT_TRUE(scene.all_occlude);
  EXPECT_EQ(scene.veils.view.node_count, 0u);
  const MaterialSplit split = scene.splits[bin(scene).split];
  EXPECT_EQ(split.child[0].kind, MaterialKind::kMatte);
  EXPECT_EQ(split.child[1].kind, MaterialKind::kMirror);

  scene = with(mix(mix(hole, mirror, .5f), solid, .5f));
  EXPECT_EQ(bin(scene).passing, Passing::kVeil);
  EXPECT_FALSE(scene.all_occlude);
  EXPECT_EQ(scene.veils.statistics.references, 2u);
  EXPECT_EQ(scene.prim_bin[0], scene.first_lasting_bin);

  // Two materials of one form share a bin, whatever their numbers.
  description.shapes.clear();
  shape(square()).material = mix(solid, mirror, .25f);
  shape(square()).material = mix(solid, mirror, .75f);
  scene = compile();
  EXPECT_EQ(scene.prim_bin[0], scene.prim_bin[2]);
  EXPECT_NE(scene.triangles.row(0).parameter, scene.triangles.row(2).parameter);
  // Nothing but holes is a hole.
  scene = with(mix(hole, mix(hole, hole, .5f), .5f));
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_SILENT();
}

TEST_F(CompileComposite, UnequalChildrenAreToldApart) {
  const auto matte = [&](float k) { return material(plugin("matte", {color("Kd", k, k, k)})); };
  const auto of = [&](uint32_t m) {
    const Scene scene = with(m);
    const uint32_t row = scene.triangles.row(0).parameter;
    MixParameters<Value> p{};
    const uint32_t* words =
        scene.parameters[uint32_t(MaterialKind::kMix)].data() + row * row_words<MixParameters>;
    for_each_field([&](auto index, auto& field) { std::memcpy(&field, words + index, 4); }, p);
    return std::pair(scene.splits[bin(scene).split].unequal, p.ratio);
  };
  EXPECT_EQ(of(mix(matte(.75f), matte(.75f), .5f)), std::pair(false, 1.f));
  EXPECT_FALSE(of(mix(matte(.5f), matte(.6f), .5f)).first);
  EXPECT_EQ(of(mix(matte(.25f), mirror, .5f)), std::pair(true, 4.f));
  // A hole counts half.
  EXPECT_EQ(of(mix(hole, matte(.25f), .5f)), std::pair(true, .5f));
  // Never less than an eighth.
  EXPECT_EQ(of(mix(matte(0), mirror, .5f)), std::pair(true, 8.f));
  // A mixture by its shares: (.25 + .75) / 2.
  EXPECT_EQ(of(mix(mix(matte(.25f), matte(.75f), .5f), mirror, .5f)), std::pair(true, 2.f));
  // Coats and bases together, head-on; both sides of a sheet; a texture by its mean; what a kind
  // says nothing of counts in full.
  const auto ratio_to_mirror = [&](uint32_t m) { return of(mix(m, mirror, .5f)).second; };
  EXPECT_FLOAT_EQ(ratio_to_mirror(material(plugin(
                      "glossy", {color("Kd", .2f, .2f, .2f), color("Ks", .25f, .25f, .25f)}))),
                  1 / .4f);
  EXPECT_FLOAT_EQ(
      ratio_to_mirror(material(plugin(
          "glossy_lossy", {color("Kd", 0, 0, 0), color("Ks", 1, 1, 1), number("index", 3)}))),
      4);
  EXPECT_FLOAT_EQ(
      ratio_to_mirror(material(plugin(
          "mattetranslucent", {color("Kr", .25f, .25f, .25f), color("Kt", .25f, .25f, .25f)}))),
      2);
  EXPECT_FLOAT_EQ(ratio_to_mirror(material(plugin("velvet", {color("Kd", 0, 0, 0)}))), 1);
  EXPECT_FLOAT_EQ(
      ratio_to_mirror(material(plugin(
          "glossycoating", {made_of("basematerial", matte(.2f)), color("Ks", .25f, .25f, .25f)}))),
      1 / .4f);
  // Where sides differ, the brighter one.
  const uint32_t sides = material(plugin("doubleside", {made_of("frontnamedmaterial", matte(.25f)),
                                                        made_of("backnamedmaterial", mirror)}));
  EXPECT_EQ(of(mix(sides, mirror, .5f)), std::pair(false, 1.f));
  // Materials whose children are alike do not share the others' bin.
  const uint32_t alike = mix(matte(.5f), matte(.5f), .5f), unlike = mix(matte(.125f), hole, .5f);
  description.shapes.clear();
  shape(square()).material = mix(matte(.25f), matte(.75f), .5f);
  shape(square()).material = alike;
  shape(square()).material = unlike;
  const Scene scene = compile();
  EXPECT_NE(scene.prim_bin[0], scene.prim_bin[2]);
  EXPECT_NE(scene.prim_bin[0], scene.prim_bin[4]);
  EXPECT_SILENT();
}

TEST_F(CompileComposite, VeilsOfAllShapes) {
  description.shapes.clear();
  const uint32_t veil = mix(solid, hole, .5f);
  for (const uint32_t m : {veil, solid, veil}) {
    shape(plugin("sphere", {number("radius", m == veil ? 1.f : 2.f)})).material = m;
    shape(plugin("plane", {})).material = m;
    shape(square()).material = m;
  }
  const Scene scene = compile();
  const VeilView veils = scene.view().veils;
  EXPECT_EQ(scene.veils.statistics.references, 4u);
  EXPECT_EQ(veils.spheres.count, 2u);
  EXPECT_EQ(veils.planes.count, 2u);
  EXPECT_EQ(veils.first_sphere, 7u);
  EXPECT_EQ(veils.first_plane, 10u);
  EXPECT_EQ(scene.spheres.row(0).radius, 2);
  EXPECT_EQ(scene.spheres.row(1).occludes, 0u);
  for (uint32_t prim = 0; prim < scene.prim_bin.size(); ++prim) {
    const Bin& b = scene.bins[scene.prim_bin[prim]];
    const bool is_veil = prim < 6 ? prim / 2 != 1 : prim != 6 && prim != 9;
    EXPECT_EQ(b.passing == Passing::kVeil, is_veil) << prim;
  }
}

TEST_F(CompileComposite, ObjectsWithVeilsAreCopied) {
  options.instances = InstanceMode::kShare;
  description.objects.push_back({"o", {0, 40, 1}});
  ShapeEntry& member = shape(square());
  member.object = 0;
  member.material = mix(solid, hole, .5f);
  for (int i = 0; i < 2; ++i)
    description.instances.push_back(
        {0, glm::translate(Matrix(1.), glm::dvec3(0, 0, i)), kNone, {0, 41, 1}});
  const Scene scene = compile();
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_EQ(scene.veils.statistics.references, 4u);
}

TEST_F(CompileComposite, WhatCannotBeBuilt) {
  Scene scene = with(material(plugin("mix", {made_of("namedmaterial1", solid)})));
  EXPECT_EQ(bin(scene).material, MaterialKind::kMatte);
  EXPECT_SAID(
      "scene.lxs:10:1: error: material \"mix\" has no \"namedmaterial2\": matte with Kd 0.9 is "
      "used");
  scene = with(material(plugin(
      "doubleside", {made_of("frontnamedmaterial", mirror), made_of("backnamedmaterial", kNone)})));
  EXPECT_EQ(bin(scene).material, MaterialKind::kMatte);
  EXPECT_SAID(
      "scene.lxs:12:2: error: \"backnamedmaterial\" of material \"doubleside\" names no material: "
      "matte with Kd 0.9 is used");
  // Only a description that no text can make.
  const uint32_t itself = mix(solid, uint32_t(description.materials.size()), .5f);
  scene = with(itself);
  EXPECT_SAID("scene.lxs:10:1: error: a material is made of itself");
}

TEST_F(CompileComposite, DeepNesting) {
  uint32_t m = solid;
  for (uint32_t level = 0; level < kMaxSplitDepth; ++level) m = mix(mirror, m, .5f);
  Scene scene = with(m);
  EXPECT_EQ(bin(scene).material, MaterialKind::kMix);
  EXPECT_SILENT();
  with(mix(m, mirror, .5f));
  EXPECT_SAID(
      "scene.lxs:11:2: error: materials are made of others more than 8 times over: material "
      "\"mix\" "
      "is matte with Kd 0.9");
}

TEST_F(CompileComposite, LayersShowTheMostOpaque) {
  const auto layers = [&](float first, float second) {
    return bin(with(material(plugin(
                   "layered", {made_of("namedmaterial1", solid), made_of("namedmaterial2", mirror),
                               number("opacity1", first), number("opacity2", second)}))))
        .material;
  };
  EXPECT_EQ(layers(1, 1), MaterialKind::kMatte);
  EXPECT_EQ(layers(.2f, .8f), MaterialKind::kMirror);
  EXPECT_SAID(
      "scene.lxs:10:1: warning: material \"layered\" shows one layer: \"name\", the first of the "
      "most opaque");
}

}  // namespace
}  // namespace yat
