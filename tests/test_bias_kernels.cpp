// No bias: instruction sets against the oracle in double precision, special kernels against general
// ones. (xsimd has no scalar architecture; the oracle is plain scalar code apart from the kernels.)

#include "bias_proof.h"
#include "bias_scenes.h"
#include "instance_scenes.h"
#include "per_isa.h"
#include "wavefront/reference.h"

namespace yat {
namespace {

Side side_of(uint32_t depth, uint32_t samples = 16) {
  Side side;
  side.options.max_depth = depth;
  side.samples = samples;
  return side;
}

// ---- Instruction sets --------------------------------------------------------------------------

/// Paths of the same random numbers: only those differ whose roundings part them. What all have in
/// common by single precision, up to 1e-4, is not looked for.
void prove_instruction_sets(const std::string& text, uint32_t depth) {
  constexpr uint32_t kOracleRuns = 16;
  const Side side = side_of(depth, 2);
  Runs oracle{32, 32, {}};
  for (const IsaEntry* isa : isas_here()) {
    const KernelTable& kernels = *isa->table();
    Diagnostics diagnostics([](Severity, std::string_view) {});
    const Scene scene = compile_description(parse_scene(text, "test.lxs", ".", diagnostics),
                                            kernels, diagnostics, oracle.width, oracle.height);
    if (oracle.pictures.empty())
      for (uint32_t r = 0; r < kOracleRuns; ++r) {
        const Plan plan = plan_of(scene, kernels, side, proof_seed(0) + r);
        std::vector<float> picture;
        for (uint32_t y = 0; y < oracle.height; ++y)
          for (uint32_t x = 0; x < oracle.width; ++x) {
            glm::dvec3 sum(0.0);
            for (uint32_t s = 0; s < side.samples; ++s)
              sum += reference_sample(scene, plan, x, y, s) / double(side.samples);
            for (int c = 0; c < 3; ++c) picture.push_back(float(sum[c]));
          }
        oracle.pictures.push_back(std::move(picture));
      }
    expect_same_pairs(isa->name, render_runs(scene, kernels, side, 0, kOracleRuns), oracle, 1e-4);
  }
}

TEST(BiasOfInstructionSets, Box) {
  prove_instruction_sets(box_text(), 5);
}
TEST(BiasOfInstructionSets, Plates) {
  prove_instruction_sets(plates_text(), 3);
}
TEST(BiasOfInstructionSets, Open) {
  prove_instruction_sets(open_text(), 4);
}
TEST(BiasOfInstructionSets, Lamps) {
  prove_instruction_sets(lamps_room_text(other_lights_text()), 4);
}
TEST(BiasOfInstructionSets, Screens) {
  prove_instruction_sets(screens_text(), 4);
}
TEST(BiasOfInstructionSets, Veils) {
  prove_instruction_sets(veils_text(), 5);
}

// ---- Special and general kernels ---------------------------------------------------------------

std::vector<float> picture_of(const Scene& scene, const KernelTable& kernels, const Side& side) {
  return render_film(scene, plan_of(scene, kernels, side, proof_seed(0)), 0, side.samples)
      .resolve();
}

const std::pair<const char*, std::string (*)()> kScenes[] = {
    {"box", &box_text},
    {"plates", &plates_text},
    {"open", &open_text},
    {"lamps", [] { return lamps_room_text(other_lights_text()); }},
    {"veils", &veils_text}};

// Camera rays as beams, and as the streams that all other rays are: the same bits.
TEST(BiasOfKernels, BeamsAndStreams) {
  KernelTable general = select_kernels();
  general.intersect_tiles = general.intersect_closest;
  for (const auto& [name, text] : kScenes) {
    const Scene scene = compile_text(text(), select_kernels());
    EXPECT_EQ(picture_of(scene, select_kernels(), side_of(5)),
              picture_of(scene, general, side_of(5)))
        << name;
  }
}

// Kernels for lights of one kind, for the first kinds, for all kinds.
TEST(BiasOfKernels, LightsOfOneKindAndOfAll) {
  const KernelTable& kernels = select_kernels();
  for (const auto& [name, text] : {kScenes[0], kScenes[1]}) {
    const Scene scene = compile_text(text(), kernels);
    EXPECT_LT(make_plan(scene, kernels, {}).light_groups[0].kernel, kPlainLights) << name;
    const std::vector<float> special = picture_of(scene, kernels, side_of(5));
    for (const uint32_t general : {kPlainLights, kAnyLights}) {
      Side side = side_of(5);
      side.change = [general](Plan& plan) { plan.light_groups[0].kernel = general; };
      expect_same_paths(name, picture_of(scene, kernels, side), special, .999);
    }
  }
}

// Any-hit kernels that take each triangle for an occluder, and that ask.
TEST(BiasOfKernels, MaskedAndPlainShadows) {
  const KernelTable& kernels = select_kernels();
  for (const auto& [name, text] : {kScenes[0], kScenes[2]}) {
    const Scene scene = compile_text(text(), kernels);
    ASSERT_FALSE(make_plan(scene, kernels, {}).shadow_mask) << name;
    Side side = side_of(5);
    side.change = [](Plan& plan) { plan.shadow_mask = true; };
    EXPECT_EQ(picture_of(scene, kernels, side), picture_of(scene, kernels, side_of(5))) << name;
  }
}

// The tree for many analytic shapes, and each tried with every ray.
TEST(BiasOfKernels, ShapesByTreeAndOneByOne) {
  const KernelTable& kernels = select_kernels();
  std::string text = view_text("0 -2.6 .3", "0 0 -.1", 50, kProofSide, kProofSide) +
                     matte_text(".6 .6 .6") +
                     quad_text("-2 -2 -1", "2 -2 -1", "2 2 -1", "-2 2 -1") +
                     square_lamp_text("6 5 4", ".6", "1.4");
  for (int i = 0; i < 24; ++i)
    text += sphere_text(std::to_string(.4 * (i % 6) - 1) + " " + std::to_string(.4 * (i / 6) - .6) +
                            " " + std::to_string(.3 * (i % 5) - .8),
                        .2);
  text +=
      "Translate 0 .3 .5\nRotate 70 1 0 0\nShape \"torus\" \"float majorradius\" [.5] \"float "
      "minorradius\" [.15]\n";
  const Scene scene = compile_text(text + "WorldEnd\n", kernels);
  ASSERT_TRUE(make_plan(scene, kernels, {}).shape_tree);
  Side side = side_of(5);
  side.change = [](Plan& plan) {
    plan.shape_tree = false;
    plan.spheres = true;
    plan.shapes[uint32_t(ShapeKind::kTorus)] = true;
  };
  expect_same_paths("shapes", picture_of(scene, kernels, side),
                    picture_of(scene, kernels, side_of(5)), .999);
}

// The best tree over triangles and a strict kd-tree.
TEST(BiasOfKernels, TreesOfBothSorts) {
  const KernelTable& kernels = select_kernels();
  for (const auto& [name, text] : kScenes) {
    Diagnostics diagnostics([](Severity, std::string_view) {});
    const Description description = parse_scene(text(), "test.lxs", ".", diagnostics);
    CompileOptions options;
    options.block_width = kernels.lanes;
    ThreadPool pool(1);
    const Scene best = compile_scene(description, options, pool, diagnostics);
    options.tree = TreeChoice::kKd;
    const Scene strict = compile_scene(description, options, pool, diagnostics);
    expect_same_paths(name, picture_of(strict, kernels, side_of(5)),
                      picture_of(best, kernels, side_of(5)), .999);
  }
}

// What textures make, where it is what constants say: one colour all over an image is not folded.
TEST(BiasOfKernels, TexturedAndPlainMaterials) {
  const KernelTable& kernels = select_kernels();
  const std::string grey = write_ppm("bias_grey.ppm", 4, 4, std::vector<uint8_t>(3 * 16, 102));
  const auto text = [&](bool textured) {
    const std::string kd = textured ? "\"texture Kd\" [\"grey\"]" : "\"color Kd\" [.4 .4 .4]";
    const std::string ks = textured ? "\"texture Ks\" [\"grey\"]" : "\"color Ks\" [.4 .4 .4]";
    const std::string quad =
        "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [-2 -2 -1 2 -2 -1 2 2 -1 "
        "-2 2 "
        "-1] \"float uv\" [0 0 1 0 1 1 0 1]\n";
    return view_text("0 -2.6 .3", "0 0 -.1", 50, kProofSide, kProofSide) +
           "Texture \"grey\" \"color\" \"imagemap\" \"string filename\" [\"" + grey +
           "\"] \"float gamma\" [1]\nMaterial \"matte\" " + kd + "\n" + quad +
           "Material \"matte\" \"float sigma\" [30] " + kd + "\n" + sphere_text("-.6 .1 -.6", .4) +
           "Material \"glossy\" \"float uroughness\" [.2] \"float vroughness\" [.2] " + kd + " " +
           ks + "\n" + sphere_text(".5 .1 -.6", .4) + square_lamp_text("6 5 4", ".6", "1.2") +
           "WorldEnd\n";
  };
  const Scene plain = compile_text(text(false), kernels), made = compile_text(text(true), kernels);
  EXPECT_TRUE(plain.programs.empty());
  EXPECT_GE(made.programs.size(), 3u);
  expect_same_paths("textured", picture_of(made, kernels, side_of(5)),
                    picture_of(plain, kernels, side_of(5)), .995);
}

// A mixture of a material with itself, which is split and put together again.
TEST(BiasOfKernels, SplitAndWholeMaterials) {
  const KernelTable& kernels = select_kernels();
  const auto text = [](bool split) {
    return view_text("0 -.95 0", "0 0 -.1", 80, kProofSide, kProofSide) +
           "MakeNamedMaterial \"grey\" \"string type\" [\"matte\"] \"color Kd\" [.7 .6 .5]\n"
           "MakeNamedMaterial \"mixed\" \"string type\" [\"mix\"] \"string namedmaterial1\" "
           "[\"grey\"] \"string namedmaterial2\" [\"grey\"] \"float amount\" [.3]\nNamedMaterial "
           "\"" +
           (split ? "mixed" : "grey") + "\"\n" + room_text(1) +
           square_lamp_text("3 2.5 2", ".75", ".99") + "WorldEnd\n";
  };
  const Scene whole = compile_text(text(false), kernels), split = compile_text(text(true), kernels);
  EXPECT_GT(make_plan(split, kernels, {}).split_levels, 0u);
  expect_same_paths("split", picture_of(split, kernels, side_of(5)),
                    picture_of(whole, kernels, side_of(5)), .999);
}

// Objects stored once, and copied. Lights have another order then, and other random numbers. The
// balls are flat: vertex normals of stored objects are interpolated in the object, so under maps
// that stretch, those of copies differ by intention.
TEST(BiasOfKernels, SharedAndCopiedObjects) {
  const KernelTable& kernels = select_kernels();
  const std::string ball = "ObjectBegin \"ball\"\n" + matte_text(".7 .4 .3") + "Scale .3 .3 .3\n" +
                           ball_text(8, 12, .1, false) + "ObjectEnd\n";
  std::string crowd = view_text("0 -2.6 .3", "0 0 -.2", 50, kProofSide, kProofSide) + ball +
                      matte_text(".6 .6 .6") +
                      quad_text("-2 -2 -1", "2 -2 -1", "2 2 -1", "-2 2 -1") +
                      square_lamp_text("6 5 4", ".6", "1.2");
  uint32_t place = 0;
  for (const NamedMap& map : kMaps) {
    crowd += instance_text("ball",
                           std::to_string(.8 * (place % 3) - .8) + " " +
                               std::to_string(.7 * (place / 3) - .7) + " -.5",
                           map.text);
    ++place;
  }
  crowd += "WorldEnd\n";
  const std::string texts[] = {crowd, veils_text()};
  for (const std::string& text : texts) {
    const Scene shared = compile_instances(text, kernels, InstanceMode::kShare);
    const Scene copies = compile_instances(text, kernels, InstanceMode::kCopy);
    EXPECT_FALSE(shared.instances.empty());
    EXPECT_TRUE(copies.instances.empty());
    expect_same(&text == texts ? "crowd" : "veils", render_runs(shared, kernels, side_of(5), 0),
                render_runs(copies, kernels, side_of(5), 1));
  }
}

}  // namespace
}  // namespace yat
