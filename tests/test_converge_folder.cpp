// The folder of an experiment: what is found again, and what is refused.

#include "converge/folder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "run_program.h"

namespace yat {
namespace {

namespace fs = std::filesystem;

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::path(YAT_TEST_OUTPUT_DIR) / "converge" /
            testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(path_);
  }
  static RunRecord record(const std::string& variant, uint32_t spp, uint32_t run) {
    RunRecord r;
    r.variant = variant;
    r.spp = spp;
    r.run = run;
    r.seed = 17 * run;
    r.samples_per_pixel = spp;
    r.seconds = .25;
    r.cpu_seconds = .5;
    r.error.mse = 1. / 3;
    r.error.rel_mse = .1;
    r.error.outliers = 3;
    if (run == 0) r.hdr_flip = .125;
    r.details = R"({"scene":"a.lxs","time":{"first_pixel":0.5},"memory":{"scene":7}})";
    return r;
  }
  fs::path path_;
  nlohmann::ordered_json header_ = {{"scene_hash", "12"}, {"seed", 0}};
};

TEST_F(Folder, RunsAreFoundAgain) {
  {
    ConvergeFolder folder(path_, header_, false);
    EXPECT_TRUE(folder.runs().empty());
    folder.add(record("a \"quoted\", name", 4, 0));
    folder.add(record("b", 4, 0));
    folder.add(record("b", 4, 1));
    EXPECT_THROW(folder.add(record("b", 4, 1)), std::logic_error);
  }
  ConvergeFolder folder(path_, header_, false);
  ASSERT_EQ(folder.runs().size(), 3u);
  const RunRecord* const found = folder.find("b", 4, 1);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->seed, 17u);
  EXPECT_DOUBLE_EQ(found->error.mse, 1. / 3);
  EXPECT_EQ(found->error.outliers, 3u);
  EXPECT_FALSE(found->hdr_flip);
  EXPECT_EQ(folder.find("b", 4, 0)->hdr_flip, .125);
  EXPECT_FALSE(folder.find("b", 16, 1));
  // Reading and writing again changes nothing.
  const std::string before = read_whole(path_ / "runs.jsonl");
  ConvergeFolder again(path_, header_, false);
  EXPECT_EQ(read_whole(path_ / "runs.jsonl"), before);
  const std::string csv = read_whole(path_ / "runs.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_NE(csv.find("\"a \"\"quoted\"\", name\",4,0,0,0.250000,0.500000,0.333333333,"),
            std::string::npos)
      << csv;
}

TEST_F(Folder, ALineThatWasCutShortIsDropped) {
  {
    ConvergeFolder folder(path_, header_, false);
    folder.add(record("a", 1, 0));
    folder.add(record("a", 1, 1));
  }
  const std::string text = read_whole(path_ / "runs.jsonl");
  write_whole(path_ / "runs.jsonl", text.substr(0, text.size() - 20));
  ConvergeFolder folder(path_, header_, false);
  EXPECT_EQ(folder.runs().size(), 1u);
  folder.add(record("a", 1, 1));
}

TEST_F(Folder, AnotherExperimentIsRefusedOrThrownAway) {
  {
    ConvergeFolder folder(path_, header_, false);
    folder.add(record("a", 1, 0));
    PixelMoments moments(2, 2);
    moments.add({2, 2, std::vector<float>(12, 1.f), true});
    folder.keep("variant-1", moments);
  }
  nlohmann::ordered_json other = header_;
  other["scene_hash"] = "34";
  try {
    ConvergeFolder folder(path_, other, false);
    FAIL() << "runs of two scenes in one folder";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("scene_hash (was \"12\", is \"34\")"), std::string::npos) << text;
    EXPECT_NE(text.find("--restart"), std::string::npos) << text;
    EXPECT_EQ(text.find("seed"), std::string::npos) << text;
  }
  {
    ConvergeFolder same(path_, header_, false);
    EXPECT_EQ(same.runs().size(), 1u);
    EXPECT_EQ(same.moments("variant-1", 2, 2).count(), 1u);
    EXPECT_EQ(same.moments("variant-2", 2, 2).count(), 0u);
  }
  ConvergeFolder fresh(path_, other, true);
  EXPECT_TRUE(fresh.runs().empty());
  EXPECT_EQ(fresh.moments("variant-1", 2, 2).count(), 0u);
}

}  // namespace
}  // namespace yat
