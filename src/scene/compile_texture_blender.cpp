// blender_* (lxs 8.5), with gradient noise in the place of Blender's own.

#include <fmt/format.h>

#include <algorithm>

#include "kernels/textures/arithmetic.h"
#include "kernels/textures/blender.h"
#include "scene/compile_textures.h"

namespace yat {

namespace {

/// The place of a word in a list; the first, with a warning, if it is not there.
uint32_t read_choice(TextureContext& c, std::string_view parameter,
                     std::initializer_list<std::string_view> words) {
  const std::string given = c.p.text(parameter, *words.begin());
  const auto* found = std::find(words.begin(), words.end(), given);
  if (found != words.end()) return uint32_t(found - words.begin());
  c.diagnostics().warning(
      c.p.loc(parameter),
      fmt::format("{}: unknown {} \"{}\"{}: \"{}\" is used", c.what(), parameter, given,
                  did_you_mean(given, {words.begin(), words.end()}), *words.begin()));
  return 0;
}

struct BlenderSetup {
  uint32_t form, variant;
  BlenderParameters<Value> parameters;
};

BlenderSetup read_common(TextureContext& c, uint32_t form) {
  BlenderSetup s{form, form, {}};
  BlenderParameters<Value>& p = s.parameters;
  p.size = c.p.number("noisesize", .25f);
  if (!(p.size > 0)) {
    c.diagnostics().warning(
        c.p.loc("noisesize"),
        fmt::format("{}: \"noisesize\" is {}, but must be above 0: 0.25 is used", c.what(),
                    p.size));
    p.size = .25f;
  }
  p.depth = float(std::clamp(c.p.integer("noisedepth", 2), 0, 24));
  p.turbulence = c.p.number("turbulence", 5);
  p.bright = c.p.number("bright", 1);
  p.contrast = c.p.number("contrast", 1);
  if (read_choice(c, "noisetype", {"soft_noise", "hard_noise"}) == 1) s.variant |= kBlenderHard;
  s.variant |= read_choice(c, "noisebasis2", {"sin", "saw", "tri"}) << 13;
  return s;
}

void warn_of_noise(TextureContext& c) {
  const std::string basis = c.p.text("noisebasis", "blender_original");
  c.diagnostics().warning(
      c.loc(),
      fmt::format("{}: \"{}\" is made of Perlin's noise instead of \"{}\": it looks alike, "
                  "but is not the same",
                  c.what(), c.entry.plugin.type, basis));
}

/// From tex1 to tex2 by what the setup makes.
TextureValue finish(TextureContext& c, const BlenderSetup& s) {
  const TextureGraph::Input mapping = map_3d(c);
  const TextureValue a = c.input("tex1", 0), b = c.input("tex2", 1);
  const uint32_t way =
      c.graph().add<BlenderParameters>(StepKind::kBlender, s.variant, s.parameters, {mapping}, 1);
  const TextureGraph::Input x = c.textures.node(a), y = c.textures.node(b);
  constexpr uint32_t kMix = 3;
  TextureValue value;
  value.colour = c.colour();
  value.constant = .5 * (a.constant + b.constant);
  value.least = std::min(a.least, b.least);
  value.most = std::max(a.most, b.most);
  value.node = c.graph().add<ArithmeticParameters>(
      StepKind::kArithmetic, kMix, {0.f}, {x, y, {way, 0}},
      std::max(c.graph()[x.node].outputs, c.graph()[y.node].outputs));
  return value;
}

TextureValue clouds(TextureContext& c) {
  const BlenderSetup s = read_common(c, 0);
  c.p.accept({"type"});
  warn_of_noise(c);
  return finish(c, s);
}

TextureValue wood(TextureContext& c) {
  BlenderSetup s = read_common(c, 1);
  const uint32_t type = read_choice(c, "type", {"bands", "rings", "bandnoise", "ringnoise"});
  s.variant |= type << 8;
  if (type >= 2) warn_of_noise(c);
  c.p.accept({"noisebasis"});
  return finish(c, s);
}

TextureValue marble(TextureContext& c) {
  BlenderSetup s = read_common(c, 2);
  s.variant |= read_choice(c, "type", {"soft", "sharp", "sharper"}) << 8;
  warn_of_noise(c);
  return finish(c, s);
}

TextureValue blend(TextureContext& c) {
  BlenderSetup s = read_common(c, 3);
  s.variant |= read_choice(c, "type", {"lin", "quad", "ease", "diag", "sphere", "halo", "radial"})
               << 8;
  if (c.p.flag("flipxy", false)) s.variant |= kBlenderFlip;
  return finish(c, s);
}

TextureValue stucci(TextureContext& c) {
  BlenderSetup s = read_common(c, 4);
  s.variant |= read_choice(c, "type", {"plastic", "wall_in", "wall_out"}) << 8;
  warn_of_noise(c);
  return finish(c, s);
}

/// Kinds without a kernel of their own: clouds of the same size.
TextureValue as_clouds(TextureContext& c) {
  const BlenderSetup s = read_common(c, 0);
  c.p.accept({"type", "noisebasis", "h", "lacu", "octs", "gain", "offset", "outscale", "distmetric",
              "minkovsky_exp", "coltype", "w1", "w2", "w3", "w4", "distamount"});
  c.diagnostics().warning(c.loc(),
                          fmt::format("{}: \"{}\" is not yet supported: clouds of Perlin's "
                                      "noise are used",
                                      c.what(), c.entry.plugin.type));
  return finish(c, s);
}

constexpr TextureClass kClasses[] = {
    {"blender_clouds", &clouds},      {"blender_wood", &wood},
    {"blender_marble", &marble},      {"blender_blend", &blend},
    {"blender_stucci", &stucci},      {"blender_magic", &as_clouds},
    {"blender_musgrave", &as_clouds}, {"blender_voronoi", &as_clouds},
    {"blender_noise", &as_clouds},    {"blender_distortednoise", &as_clouds},
};

}  // namespace

std::span<const TextureClass> blender_textures() {
  return kClasses;
}

}  // namespace yat
