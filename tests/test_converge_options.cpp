// The command line of yat converge.

#include <gtest/gtest.h>

#include "app/converge_options.h"
#include "app/option_words.h"
#include "app/options.h"
#include "converge/ladder.h"
#include "run_program.h"

namespace yat {
namespace {

std::string usage_error(const std::vector<std::string>& words) {
  try {
    parse_converge_arguments(words);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ConvergeOptions, DefaultsAreOneVariantAndAMadeReference) {
  const ConvergeArguments a = parse_converge_arguments({"s.lxs", "-o", "out"});
  EXPECT_EQ(a.scene, "s.lxs");
  EXPECT_EQ(a.folder, "out");
  ASSERT_EQ(a.variants.size(), 1u);
  EXPECT_EQ(a.variants[0].name, "default");
  EXPECT_EQ(a.runs, 16u);
  EXPECT_EQ(a.ladder, (std::vector<uint32_t>{1, 4, 16, 64, 256}));
  EXPECT_TRUE(a.reference.empty());
  EXPECT_EQ(a.shared.arguments.sampler, SamplerKind::kSobol);
  EXPECT_FALSE(a.variants[0].arguments.sampler);
}

TEST(ConvergeOptions, VariantsLieOverWhatHoldsForAll) {
  const ConvergeArguments a = parse_converge_arguments(
      {"--threads=2", "s.lxs", "-o", "out", "--sampler", "cmj", "--resolution", "64x48",
       "--variant", "plain:", "--variant", "deep: --max-depth 3 --sampler independent", "--variant",
       "--light-choice power", "--ladder", "16,4", "--runs", "3", "-q"});
  ASSERT_EQ(a.variants.size(), 3u);
  EXPECT_EQ(a.variants[0].name, "plain");
  EXPECT_EQ(a.variants[0].options, "--resolution 64x48 --sampler cmj --threads 2");
  EXPECT_EQ(a.variants[1].name, "deep");
  EXPECT_EQ(a.variants[1].arguments.sampler, SamplerKind::kIndependent);
  EXPECT_EQ(a.variants[1].arguments.max_depth, 3u);
  EXPECT_EQ(a.variants[1].arguments.width, 64u);
  EXPECT_EQ(a.variants[2].name, "--light-choice power");
  EXPECT_EQ(a.variants[2].arguments.light_choice, LightChoosing::kPower);
  EXPECT_EQ(a.ladder, (std::vector<uint32_t>{4, 16}));
  EXPECT_EQ(a.runs, 3u);
  EXPECT_EQ(a.verbosity, Verbosity::kQuiet);
  // Sampler and depth are the plan's: one compiled scene. How lights are chosen is the scene's.
  EXPECT_EQ(a.variants[0].scene_key, a.variants[1].scene_key);
  EXPECT_EQ(a.variants[0].scene_key, a.shared.scene_key);
  EXPECT_NE(a.variants[0].scene_key, a.variants[2].scene_key);
}

// Light samples alone have to find what is else left to chance: even skies.
TEST(ConvergeOptions, WaysToFindLightHaveScenesOfTheirOwn) {
  const ConvergeArguments a = parse_converge_arguments(
      {"s.lxs", "-o", "out", "--variant", "both:", "--variant", "lights: --light-sampling lights"});
  EXPECT_NE(a.variants[0].scene_key, a.variants[1].scene_key);
}

TEST(ConvergeOptions, RoulettesAreThePlans) {
  const ConvergeArguments a = parse_converge_arguments(
      {"s.lxs", "-o", "out", "--variant", "off: --roulette off --shadow-roulette off", "--variant",
       "faint: --shadow-roulette .3"});
  EXPECT_EQ(a.variants[0].arguments.shadow_roulette, kNoShadowRoulette);
  EXPECT_EQ(a.variants[1].arguments.shadow_roulette, .3);
  EXPECT_EQ(a.variants[0].scene_key, a.variants[1].scene_key);
}

// A target decides about samples: one point instead of a ladder, and nothing for the reference.
TEST(ConvergeOptions, VariantsMayHaveANoiseTarget) {
  const ConvergeArguments a =
      parse_converge_arguments({"s.lxs", "-o", "out", "--ladder", "4,16", "--variant",
                                "plain:", "--variant", "target: --noise-target .01 --adaptive on"});
  EXPECT_FALSE(a.variants[0].to_noise());
  EXPECT_EQ(a.variants[0].ladder, (std::vector<uint32_t>{4, 16}));
  EXPECT_TRUE(a.variants[1].to_noise());
  EXPECT_EQ(a.variants[1].ladder, (std::vector<uint32_t>{kTargetRung}));
  EXPECT_EQ(a.variants[1].arguments.adaptive, Adaptive::kOn);
  EXPECT_EQ(a.variants[0].scene_key, a.variants[1].scene_key);

  const ConvergeArguments all =
      parse_converge_arguments({"s.lxs", "-o", "out", "--noise-target", ".1", "--variant",
                                "off:", "--variant", "on: --adaptive on"});
  EXPECT_TRUE(all.variants[0].to_noise());
  EXPECT_TRUE(all.variants[1].to_noise());
  EXPECT_FALSE(all.shared.to_noise());
  EXPECT_EQ(all.shared.scene_key, all.variants[0].scene_key);
}

TEST(ConvergeOptions, MistakesAreNamed) {
  EXPECT_EQ(usage_error({"s.lxs"}), "yat converge: add -o FOLDER, where the report goes");
  EXPECT_NE(usage_error({"-o", "f"}).find("which scene?"), std::string::npos);
  EXPECT_NE(usage_error({"s.lxs", "t.lxs", "-o", "f"}).find("\"t.lxs\" is one word too many"),
            std::string::npos);
  EXPECT_EQ(usage_error({"s.lxs", "-o"}), "-o: add FOLDER");
  EXPECT_EQ(usage_error({"s.lxs", "-o", "f", "--runs", "0"}),
            "--runs 0: 0 is not within 1 to 4096");
  EXPECT_EQ(usage_error({"s.lxs", "-o", "f", "--ladder", "1,4,4"}),
            "--ladder 1,4,4: a number is there twice; give each once");
  EXPECT_EQ(usage_error({"s.lxs", "-o", "f", "--ladder", "1", "--spp-max", "4"}),
            "--ladder and --spp-max exclude each other");
  EXPECT_EQ(usage_error({"s.lxs", "-o", "f", "--reference", "r.exr", "--make-reference"}),
            "--reference and --make-reference exclude each other");
  EXPECT_EQ(usage_error({"s.lxs", "-o", "f", "--runs", "2", "--runs", "3"}), "--runs: given twice");
  EXPECT_NE(
      usage_error({"s.lxs", "-o", "f", "--samplr", "cmj"}).find("did you mean \"--sampler\"?"),
      std::string::npos);
  // What is sampled and written is the command's own business.
  EXPECT_TRUE(
      usage_error({"s.lxs", "-o", "f", "--spp", "4"}).starts_with("--spp: not with yat converge"));
  EXPECT_TRUE(usage_error({"s.lxs", "-o", "f", "--variant", "a: --time 1"})
                  .starts_with("--variant \"a\": --time: not with yat converge"));
  EXPECT_NE(usage_error({"s.lxs", "-o", "f", "--variant", "a: --adaptive on"})
                .find("--adaptive says how --noise-target takes samples"),
            std::string::npos);
  EXPECT_EQ(usage_error({"s.lxs", "-o", "f", "--variant", "a: --runs 3"}),
            "--variant \"a\": --runs is not for one variant: give it outside");
  EXPECT_NE(usage_error({"s.lxs", "-o", "f", "--variant", "a: --sampler sobl"})
                .find("--variant \"a\": --sampler sobl: unknown (did you mean \"sobol\"?)"),
            std::string::npos);
  EXPECT_NE(usage_error({"s.lxs", "-o", "f", "--variant", "a: cmj"}).find("belongs to no option"),
            std::string::npos);
  EXPECT_NE(usage_error({"s.lxs", "-o", "f", "--variant", ": --sampler cmj"}).find("NAME: OPTIONS"),
            std::string::npos);
  EXPECT_NE(usage_error({"s.lxs", "-o", "f", "--variant", "cmj"}).find("write it as"),
            std::string::npos);
  EXPECT_NE(usage_error({"s.lxs", "-o", "f", "--variant", "a:", "--variant", "a: --sampler cmj"})
                .find("two are called"),
            std::string::npos);
}

TEST(ConvergeOptions, WordsAreSplitAsAShellDoes) {
  EXPECT_EQ(shell_words("  --a 1\t\"two words\"x --b=\"c d\" "),
            (std::vector<std::string>{"--a", "1", "two wordsx", "--b=c d"}));
  EXPECT_TRUE(shell_words("").empty());
}

TEST(ConvergeOptions, HelpAndDocumentsListEveryOption) {
  const char* const words[] = {"yat", "converge", "--help"};
  const CommandLine line = parse_command_line(3, words);
  EXPECT_EQ(line.command, Command::kHelp);
  for (const OptionText& option : converge_option_texts())
    EXPECT_NE(line.text.find(option.text), std::string::npos) << option.flags;
  EXPECT_NE(read_whole(YAT_SOURCE_DIR "/docs/command-line.md")
                .find(option_table(converge_option_texts())),
            std::string::npos)
      << "docs/command-line.md must hold this table:\n"
      << option_table(converge_option_texts());
}

}  // namespace
}  // namespace yat
