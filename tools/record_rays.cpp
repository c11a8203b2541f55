// record_rays scene.lxs -o scene.rays: the rays that yat traces for a scene, for bench_traversal.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <string>

#include "kernels/dispatch.h"
#include "measure.h"
#include "rays_file.h"

namespace {

using namespace yat;

/// "640x360". Throws UsageError.
void parse_resolution(const std::string& text, uint32_t& width, uint32_t& height) {
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
  if (good) {
    const auto second = std::from_chars(first.ptr + 1, end, height);
    good = second.ec == std::errc() && second.ptr == end;
  }
  if (!good || !width || !height || width > 32768 || height > 32768)
    throw UsageError("--resolution " + quote(text) + ": give it as 640x360, each side 1 to 32768");
}

int run(int argc, char** argv) {
  std::string scene, output, resolution, isa, materials = "matte";
  bench::RecordOptions options;
  CLI::App app("Records the rays that yat traces for a scene, for bench_traversal --rays.");
  app.option_defaults()->always_capture_default();
  app.add_option("scene", scene, "Scene file (.lxs)")->required();
  app.add_option("-o,--output", output, "Ray file to write")->required();
  app.add_option("--resolution", resolution, "WxH (default: as the film says)");
  app.add_option("--spp", options.samples,
                 "Samples per pixel (0: as many as make about 512 x 512 camera rays)");
  app.add_option("--vertices", options.vertices, "Vertices of a path")->check(CLI::Range(1, 64));
  app.add_option("--materials", materials,
                 "matte: every surface white and matte; scene: as the scene says")
      ->check(CLI::IsMember({"matte", "scene"}));
  app.add_option("--seed", options.seed, "Of the random numbers");
  app.add_option("--isa", isa, "Instruction set (default: YAT_ISA, else the best here)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!resolution.empty()) parse_resolution(resolution, options.width, options.height);
  if (materials == "scene") options.materials = bench::RecordMaterials::kScene;
  Diagnostics diagnostics([](Severity severity, std::string_view line) {
    if (severity != Severity::kNote) std::fprintf(stderr, "%.*s\n", int(line.size()), line.data());
  });
  const bench::Recording recording =
      bench::record_scene(scene, select_kernels(isa), options, diagnostics);
  diagnostics.flush_repeats();
  bench::write_rays(output, recording);
  fmt::print("{}: {} triangles\n", output, recording.scene.triangles());
  for (const bench::RaySet& set : recording.sets)
    fmt::print("  {:<10} {:>9} {}\n", set.name, set.rays.size(),
               set.shadow ? "any hit" : "closest");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return yat::bench::run_program("record_rays", run, argc, argv);
}
