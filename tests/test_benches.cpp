// The benchmark programs as people run them, on their smallest cases.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "run_program.h"
#include "scene/registry.h"

namespace yat {
namespace {

using Json = nlohmann::json;

class Benches : public testing::Test {
 protected:
  void SetUp() override { folder = empty_folder("benches"); }
  ProgramResult bench(const std::string& name, std::vector<std::string> options) const {
    options.insert(options.begin(), std::string(YAT_BENCH_DIR) + "/" + name);
    return run_program(options, folder);
  }
  Json json(const std::string& name) const { return Json::parse(read_whole(folder / name)); }
  std::filesystem::path folder;
};

/// A regular tetrahedron and a file for it.
void write_tetrahedron(const std::filesystem::path& path) {
  write_whole(path,
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nelement face 4\nproperty list uchar int vertex_indices\n"
              "end_header\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n");
}

TEST_F(Benches, BuildTableHoldsWhatWasBuilt) {
  write_tetrahedron(folder / "mesh.ply");
  const ProgramResult result =
      bench("bench_build", {"--json", "build.json", "--sizes", "8000", "--scenes", "hall,sphere",
                            "--threads", "1,2", "--repetitions", "2", "mesh.ply"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json report = json("build.json");
  EXPECT_EQ(report["program"], "bench_build");
  ASSERT_EQ(report["rows"].size(), 6u);
  const size_t builders = report.contains("embree") ? 3 : 1;
  for (const Json& row : report["rows"]) {
    EXPECT_GE(row["references"], row["triangles"]);
    EXPECT_GT(row["sah_cost"], 0);
    ASSERT_EQ(row["builders"].size(), builders);
    for (const Json& builder : row["builders"]) {
      EXPECT_EQ(builder["wall"].size(), 2u);
      EXPECT_GT(builder["bytes"], 0);
    }
  }
  EXPECT_EQ(report["rows"][0]["triangles"], 16);  // A tetrahedron and its room.
  // The tree is the same for any number of threads.
  EXPECT_EQ(report["rows"][2]["sah_cost"], report["rows"][3]["sah_cost"]);
  EXPECT_NEAR(double(report["rows"][2]["triangles"]), 8000, 400);
}

TEST_F(Benches, EveryMaterialHasRows) {
  const ProgramResult result =
      bench("bench_kernels",
            {"--benchmark_filter=^(shade|split|bsdf_.*)/[a-z_]*/[a-z0-9]*(/active:100)?/m",
             "--benchmark_min_time=0.00001", "--benchmark_format=json"});
  ASSERT_EQ(result.code, 0) << result.err;
  std::map<std::string, int> rows;
  const Json report = Json::parse(result.out);
  for (const Json& row : report["benchmarks"]) {
    const std::string name = row["name"];
    EXPECT_FALSE(row.value("error_occurred", false)) << name << ": " << row;
    EXPECT_GT(row["cpu_time"], 0) << name;
    const size_t begin = name.find('/') + 1;
    ++rows[name.substr(begin, name.find('/', begin) - begin)];
  }
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind) {
    const MaterialTraits traits = material_traits(MaterialKind(kind));
    // Shade, evaluate and sample; or the way to its children.
    EXPECT_GE(rows[std::string(traits.name)], traits.splits ? 1 : 3) << traits.name;
  }
}

TEST_F(Benches, BuildAsGoogleBenchmark) {
  const ProgramResult result = bench(
      "bench_build",
      {"--benchmark_min_time=0.001", "--sizes", "5000", "--scenes", "sphere", "--threads", "1"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("build/sphere:5000/threads:1"), std::string::npos) << result.out;
}

TEST_F(Benches, BuildSaysWhatIsWrong) {
  ProgramResult result = bench("bench_build", {"--table", "--sizes", "12"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err,
            "bench_build: scene \"hall:12\": give a count of triangles from 5000 to 20000000\n");
  result = bench("bench_build", {"--table", "--sizes", "0", "none.ply"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("none.ply"), std::string::npos) << result.err;
  result = bench("bench_build", {"--tree", "oak"});
  EXPECT_EQ(result.code, 2);
}

TEST_F(Benches, Kernels) {
  const ProgramResult result =
      bench("bench_kernels", {"--benchmark_filter=draw/.*", "--benchmark_min_time=0.001"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("draw/"), std::string::npos) << result.out;
}

TEST_F(Benches, Render) {
  const ProgramResult result =
      bench("bench_render",
            {"--benchmark_filter=cornell-box/render/threads:1", "--benchmark_min_time=0.001"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("Mrays/s"), std::string::npos) << result.out;
}

TEST_F(Benches, TraversalAsGoogleBenchmark) {
  const ProgramResult result =
      bench("bench_traversal", {"--scenes", "cornell", "--resolution", "16",
                                "--benchmark_filter=camera", "--benchmark_min_time=0.001"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("cornell/camera/"), std::string::npos) << result.out;
}

TEST_F(Benches, TraversalTableComparesAnswers) {
  write_tetrahedron(folder / "mesh.ply");
  const ProgramResult result =
      bench("bench_traversal",
            {"--json", "traversal.json", "--scenes", "cornell", "--open", "mesh.ply",
             "--resolution", "40", "--tree", "auto,kd", "--streams", "0,32", "--threads", "2",
             "--repetitions", "2", "--kernels", "render,scalar", "mesh.ply"});
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  const Json report = json("traversal.json");
  EXPECT_EQ(report["program"], "bench_traversal");
  ASSERT_EQ(report["scenes"].size(), 3u);
  const bool embree = report.contains("embree");
  for (const Json& scene : report["scenes"]) {
    ASSERT_GE(scene["rows"].size(), 2u);
    EXPECT_EQ(scene["rows"][0]["set"], "camera");
    EXPECT_EQ(scene["rows"][0]["rays"], 1600);
    EXPECT_EQ(scene["path_mix"].size(), 8u);
    for (const Json& row : scene["rows"]) {
      ASSERT_EQ(row["yat"].size(), 8u);
      for (const Json& mine : row["yat"]) {
        EXPECT_EQ(mine["seconds"].size(), 2u);
        EXPECT_EQ(mine["threads"][0]["threads"], 2);
        ASSERT_EQ(mine.contains("ratio"), embree);
        if (embree) {
          EXPECT_EQ(mine["differences"]["yat_wrong"], 0);
        }
      }
    }
  }
  EXPECT_EQ(report["scenes"][1]["scene"], "mesh");
  EXPECT_EQ(report["scenes"][2]["scene"], "cornell");
  EXPECT_EQ(report["scenes"][2]["rows"].size(), 7u);  // All sets: the box is not closed in front.
}

TEST_F(Benches, RecordedRaysAreTraced) {
  const std::string scene = YAT_SOURCE_DIR "/scenes/cornell-box/cornell-box.lxs";
  ProgramResult result =
      bench("record_rays", {scene, "-o", "box.rays", "--resolution", "40x24", "--spp", "1"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("camera           960 closest"), std::string::npos) << result.out;
  result =
      bench("bench_traversal", {"--json", "t.json", "--rays", "box.rays", "--repetitions", "1"});
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  const Json report = json("t.json");
  ASSERT_EQ(report["scenes"].size(), 1u);
  EXPECT_EQ(report["scenes"][0]["scene"], "cornell-box");
  EXPECT_EQ(report["scenes"][0]["rows"].size(), 7u);
  EXPECT_EQ(report["scenes"][0]["rows"][0]["rays"], 960);
}

TEST_F(Benches, RecordRaysSaysWhatIsWrong) {
  ProgramResult result = bench("record_rays", {"no.lxs", "-o", "x.rays"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "no.lxs: error: cannot be read: No such file or directory\n");
  result = bench("record_rays", {"no.lxs", "-o", "x.rays", "--resolution", "40"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err,
            "record_rays: --resolution \"40\": give it as 640x360, each side 1 to 32768\n");
  write_whole(folder / "bad.rays", "P6\n");
  result = bench("bench_traversal", {"--table", "--rays", "bad.rays"});
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(result.err.starts_with("bad.rays: error: is not a ray file")) << result.err;
}

TEST_F(Benches, TraversalSaysWhatIsWrong) {
  EXPECT_EQ(bench("bench_traversal", {"--table", "--scenes", "nave"}).err,
            "bench_traversal: scene \"nave\": not one of cornell, sphere[:triangles], "
            "hall[:triangles]\n");
  ProgramResult result = bench("bench_traversal", {"--table", "--kernels", "best"});
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("best not in {render,stream,scalar}"), std::string::npos) << result.err;
  result = bench("bench_traversal", {"--table", "none.ply"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("none.ply"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace yat
