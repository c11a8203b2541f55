// Materials that are made of other materials (lxs 7.2).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "kernels/materials/double_side.h"
#include "kernels/materials/mix.h"
#include "scene/compile_materials.h"

namespace yat {

namespace {

/// Children whose brightness differs by less are chosen by their shares alone: what the weights
/// would gain is below a hundredth.
constexpr float kAlike = 1.25f;

/// What LuxRender has for a material that cannot be built.
MaterialRef not_built(MaterialCompiler& compiler, Parameters& p) {
  p.accept_all();
  return add_matte(compiler, glm::dvec3(.9), 0);
}

}  // namespace

MaterialRef build_mix(MaterialCompiler& compiler, Parameters& p) {
  const auto first = compiler.child(p, "namedmaterial1");
  const auto second = compiler.child(p, "namedmaterial2");
  if (!first || !second) return not_built(compiler, p);
  const double amount = compiler.clamped(p, "amount", .5, 0, 1);
  const bool varies = compiler.varies("amount");
  if (!varies && amount == 0) return *first;
  if (!varies && amount == 1) return *second;
  if (first->passing == Passing::kAll && second->passing == Passing::kAll) return *first;
  const float ratio = brightness(*second) / brightness(*first);
  const bool unequal = std::max(ratio, 1 / ratio) > kAlike;
  MaterialRef made = compiler.add_split<MixParameters>(
      MaterialKind::kMix, {float(amount), ratio, first->row, second->row}, *first, *second, false,
      false, unequal);
  made.albedo = glm::mix(first->albedo, second->albedo, float(amount));
  return made;
}

MaterialRef build_doubleside(MaterialCompiler& compiler, Parameters& p) {
  const auto front = compiler.child(p, "frontnamedmaterial");
  const auto back = compiler.child(p, "backnamedmaterial");
  const bool front_for_front = p.flag("usefrontforfront", true);
  const bool front_for_back = p.flag("usefrontforback", true);
  if (!front || !back) return not_built(compiler, p);
  if (front->passing == Passing::kAll && back->passing == Passing::kAll) return *front;
  MaterialRef made =
      compiler.add_split<DoubleSideParameters>(MaterialKind::kDoubleSide, {front->row, back->row},
                                               *front, *back, !front_for_front, front_for_back);
  made.albedo = glm::max(front->albedo, back->albedo);
  return made;
}

/// The uppermost of the layers that hide most.
MaterialRef build_layered(MaterialCompiler& compiler, Parameters& p) {
  constexpr std::array<std::pair<const char*, const char*>, 4> kLayers = {
      {{"namedmaterial1", "opacity1"},
       {"namedmaterial2", "opacity2"},
       {"namedmaterial3", "opacity3"},
       {"namedmaterial4", "opacity4"}}};
  const char* chosen = nullptr;
  double most = -1;
  for (const auto& [material, opacity] : kLayers) {
    if (!p.given(material)) {
      p.accept({material, opacity});
      continue;
    }
    p.accept({material});
    const double hides = compiler.clamped(p, opacity, 1, 0, 1);
    if (!(hides > most)) continue;
    most = hides;
    chosen = material;
  }
  const auto layer = compiler.child(p, chosen ? chosen : "namedmaterial1");
  if (!layer) return not_built(compiler, p);
  p.diagnostics().warning(
      p.plugin().loc,
      fmt::format("material \"layered\" shows one layer: \"{}\", the first of the most opaque",
                  p.text(chosen, "")),
      "material \"layered\" shows one layer");
  return *layer;
}

}  // namespace yat
