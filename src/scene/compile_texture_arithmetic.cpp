// constant, scale, add, subtract, mix, multimix, band (lxs 8.4).

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "kernels/textures/arithmetic.h"
#include "kernels/textures/ramp.h"
#include "scene/compile_textures.h"

namespace yat {

namespace {

enum Operation : uint32_t { kScale, kAdd, kSubtract, kMix, kWeighted };

/// The range of a product of two ranges.
void set_product_range(const TextureValue& a, const TextureValue& b, TextureValue& out) {
  const std::array<double, 4> ends = {a.least * b.least, a.least * b.most, a.most * b.least,
                                      a.most * b.most};
  out.least = *std::min_element(ends.begin(), ends.end());
  out.most = *std::max_element(ends.begin(), ends.end());
}

/// How many channels the result of these has.
uint32_t channels(const TextureGraph& graph, std::initializer_list<TextureGraph::Input> inputs) {
  uint32_t most = 1;
  for (const TextureGraph::Input& in : inputs) most = std::max(most, graph[in.node].outputs);
  return most;
}

TextureValue add_node(TextureContext& c, Operation operation, const TextureValue& a,
                      const TextureValue& b, TextureValue result, float weight = 0) {
  const TextureGraph::Input x = c.textures.node(a), y = c.textures.node(b);
  result.colour = a.colour;
  result.node = c.graph().add<ArithmeticParameters>(StepKind::kArithmetic, operation, {weight},
                                                    {x, y}, channels(c.graph(), {x, y}));
  return result;
}

TextureValue folded(const TextureContext& c, const glm::dvec3& value) {
  return c.colour() ? TextureValue::of_colour(value) : TextureValue::number(value.x);
}

TextureValue scale(TextureContext& c, const TextureValue& a, const TextureValue& b) {
  const glm::dvec3 product = a.constant * b.constant;
  if (!a.varies() && !b.varies()) return folded(c, product);
  TextureValue result;
  result.constant = product;
  set_product_range(a, b, result);
  return add_node(c, kScale, a, b, result);
}

TextureValue sum(TextureContext& c, const TextureValue& a, double weight, const TextureValue& b) {
  const glm::dvec3 total = a.constant + weight * b.constant;
  if (!a.varies() && !b.varies()) return folded(c, total);
  TextureValue result;
  result.constant = total;
  result.least = a.least + std::min(weight * b.least, weight * b.most);
  result.most = a.most + std::max(weight * b.least, weight * b.most);
  const Operation operation = weight == 1 ? kAdd : weight == -1 ? kSubtract : kWeighted;
  return add_node(c, operation, a, b, result, float(weight));
}

TextureValue mix(TextureContext& c, const TextureValue& a, const TextureValue& b,
                 const TextureValue& amount) {
  const double t = amount.constant.x;
  const glm::dvec3 between = (1 - t) * a.constant + t * b.constant;
  if (!a.varies() && !b.varies() && !amount.varies()) return folded(c, between);
  TextureValue result;
  result.colour = a.colour;
  result.constant = between;
  result.least = std::min(a.least, b.least);
  result.most = std::max(a.most, b.most);
  if (amount.least < 0 || amount.most > 1) {
    const double reach =
        (result.most - result.least) * std::max({0., -amount.least, amount.most - 1});
    result.least -= reach;
    result.most += reach;
  }
  const TextureGraph::Input x = c.textures.node(a), y = c.textures.node(b),
                            w = c.textures.node(amount);
  result.node = c.graph().add<ArithmeticParameters>(StepKind::kArithmetic, kMix, {0.f}, {x, y, w},
                                                    channels(c.graph(), {x, y}));
  return result;
}

TextureValue constant_texture(TextureContext& c) {
  // A float texture may hold a color and the reverse: the conversion rules of Parameters apply.
  if (c.colour())
    return TextureValue::of_colour(c.p.triple("value", ParameterType::kColor, glm::dvec3(1.)));
  return TextureValue::number(double(c.p.number("value", 1)));
}

TextureValue scale_texture(TextureContext& c) {
  return scale(c, c.input("tex1", 1), c.input("tex2", 1));
}
TextureValue add_texture(TextureContext& c) {
  return sum(c, c.input("tex1", 1), 1, c.input("tex2", 1));
}
TextureValue subtract_texture(TextureContext& c) {
  return sum(c, c.input("tex1", 1), -1, c.input("tex2", 1));
}
TextureValue mix_texture(TextureContext& c) {
  return mix(c, c.input("tex1", 0), c.input("tex2", 1), c.number("amount", .5));
}

TextureValue multimix_texture(TextureContext& c) {
  std::vector<float> storage;
  const auto weights = c.p.floats("weights", ParameterType::kFloat, storage);
  if (weights.empty())
    c.diagnostics().warning(c.loc(), c.what() + ": \"weights\" is missing: the texture is 0");
  TextureValue total = folded(c, glm::dvec3(0.));
  for (size_t i = 0; i < weights.size(); ++i)
    total = sum(c, total, double(weights[i]), c.input(c.keep(fmt::format("tex{}", i + 1)), 1));
  return total;
}

/// Linear between the textures at their offsets, constant outside: a chain of mixtures, of which
/// all but one have an amount of 0 or 1.
TextureValue band_texture(TextureContext& c) {
  std::vector<float> storage;
  const auto offsets = c.p.floats("offsets", ParameterType::kFloat, storage);
  const TextureValue amount = c.number("amount", 0);
  if (offsets.empty()) {
    c.diagnostics().warning(c.loc(), c.what() + ": \"offsets\" is missing: the texture is 0");
    return folded(c, glm::dvec3(0.));
  }
  if (!std::is_sorted(offsets.begin(), offsets.end()))
    c.diagnostics().warning(c.p.loc("offsets"), c.what() + ": \"offsets\" do not ascend");
  TextureValue value = c.input("tex1", 0);
  for (size_t i = 1; i < offsets.size(); ++i) {
    const double start = double(offsets[i - 1]), end = std::max(start, double(offsets[i]));
    const double at = amount.constant.x;
    TextureValue way = TextureValue::number(at >= end     ? 1
                                            : at <= start ? 0
                                                          : (at - start) / (end - start));
    if (amount.varies()) {
      way.node = c.graph().add<RampParameters>(StepKind::kRamp, 0, {float(start), float(end)},
                                               {c.textures.node(amount)}, 1);
      way.least = 0;
      way.most = 1;
    }
    value = mix(c, value, c.input(c.keep(fmt::format("tex{}", i + 1)), 0), way);
  }
  return value;
}

constexpr TextureClass kClasses[] = {
    {"constant", &constant_texture}, {"scale", &scale_texture}, {"add", &add_texture},
    {"subtract", &subtract_texture}, {"mix", &mix_texture},     {"multimix", &multimix_texture},
    {"band", &band_texture},
};

}  // namespace

std::span<const TextureClass> arithmetic_textures() {
  return kClasses;
}

}  // namespace yat
