// Veach's plates (scenes/veach-plates). No closed form: multiple importance sampling against the
// scalar reference, and each of its two estimators against both together.

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "accuracy/case.h"
#include "accuracy/runs.h"
#include "base/error.h"

namespace yat::accuracy {

namespace {

std::string read(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || text.str().empty()) throw Error(path + ": cannot be read");
  return text.str();
}

}  // namespace

void add_veach_cases(std::vector<Case>& cases) {
  const std::string scene = read(YAT_SOURCE_DIR "/scenes/veach-plates/veach-plates.lxs");
  // The parts of the picture that show the plates, smooth to rough, top to bottom.
  const float tops[] = {.41f, .535f, .67f, .805f}, bottoms[] = {.485f, .61f, .735f, .88f};
  const double target = 6e-4;  // so that both together stay below .1 %
  for (int plate = 0; plate < 4; ++plate) {
    Probe probe{scene, 4};
    probe.width = 128;
    probe.height = 96;
    probe.crop[0] = .25f;
    probe.crop[1] = .75f;
    probe.crop[2] = tops[plate];
    probe.crop[3] = bottoms[plate];
    const auto add = [&](const std::string& name, const char* what, const Probe& used,
                         std::function<Known(const Machine&)> expected) {
      Case c{name, what, {used}, std::move(expected), {}};
      c.effort = 2;
      cases.push_back(std::move(c));
    };
    // Scale, for the errors to plan for.
    const auto rough = [probe](const std::string& name, const Machine& machine) {
      return by_render(name, probe, 1e-2, machine).value;
    };
    const std::string mis = fmt::format("veach.mis.plate{}", plate + 1);
    add(mis, "mean radiance of a plate: MIS, against the scalar reference in double precision",
        probe, [=](const Machine& machine) {
          return by_reference(mis, probe, target * rough(mis, machine), machine);
        });
    // The other estimator is hopeless there: 0.1 % would take hours.
    Probe alone = probe;
    alone.light_sampling = plate < 2 ? LightSampling::kBsdf : LightSampling::kLights;
    const std::string other =
        fmt::format("veach.{}.plate{}", plate < 2 ? "chance" : "light_samples", plate + 1);
    add(other,
        plate < 2 ? "the same: lamps met by chance alone, against MIS"
                  : "the same: light samples alone, against MIS",
        alone, [=](const Machine& machine) {
          return by_render(other, probe, target * rough(other, machine), machine);
        });
  }
}

}  // namespace yat::accuracy
