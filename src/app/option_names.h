#pragma once
// What values of options are called on the command line.

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/arguments.h"
#include "base/error.h"

namespace yat {

inline constexpr std::array<std::pair<std::string_view, Integrator>, 2> kIntegrators = {
    {{"path", Integrator::kPath}, {"direct", Integrator::kDirect}}};
inline constexpr std::array<std::pair<std::string_view, SamplerKind>, 8> kSamplers = {
    {{"sobol", SamplerKind::kSobol},
     {"independent", SamplerKind::kIndependent},
     {"regular", SamplerKind::kRegular},
     {"jittered", SamplerKind::kJittered},
     {"nrooks", SamplerKind::kNRooks},
     {"multijittered", SamplerKind::kMultiJittered},
     {"cmj", SamplerKind::kCorrelatedMultiJittered},
     {"zsobol", SamplerKind::kZSobol}}};
inline constexpr std::array<std::pair<std::string_view, Dialect>, 2> kDialects = {
    {{"luxrender", Dialect::kLuxRender}, {"yart", Dialect::kYart}}};
inline constexpr std::array<std::pair<std::string_view, TreeChoice>, 2> kTrees = {
    {{"auto", TreeChoice::kAuto}, {"kd", TreeChoice::kKd}}};
inline constexpr std::array<std::pair<std::string_view, ColourMode>, 2> kColourModes = {
    {{"bands", ColourMode::kBands}, {"rgb", ColourMode::kRgb}}};
inline constexpr std::array<std::pair<std::string_view, InstanceMode>, 3> kInstanceModes = {
    {{"auto", InstanceMode::kAuto},
     {"copy", InstanceMode::kCopy},
     {"share", InstanceMode::kShare}}};
inline constexpr std::array<std::pair<std::string_view, Adaptive>, 3> kAdaptives = {
    {{"auto", Adaptive::kAuto}, {"on", Adaptive::kOn}, {"off", Adaptive::kOff}}};
inline constexpr std::array<std::pair<std::string_view, EnergyCompensation>, 3> kCompensations = {
    {{"auto", EnergyCompensation::kAuto},
     {"on", EnergyCompensation::kOn},
     {"off", EnergyCompensation::kOff}}};
inline constexpr std::array<std::pair<std::string_view, LightChoosing>, 5> kLightChoices = {
    {{"auto", LightChoosing::kAuto},
     {"power", LightChoosing::kPower},
     {"tree", LightChoosing::kTree},
     {"uniform", LightChoosing::kUniform},
     {"all", LightChoosing::kAll}}};
inline constexpr std::array<std::pair<std::string_view, LightSampling>, 3> kLightSamplings = {
    {{"mis", LightSampling::kBoth},
     {"lights", LightSampling::kLights},
     {"bsdf", LightSampling::kBsdf}}};
inline constexpr std::array<std::pair<std::string_view, ToneMap>, 9> kToneMaps = {
    {{"linear", ToneMap::kLinear},
     {"reinhard", ToneMap::kReinhard},
     {"autolinear", ToneMap::kAutoLinear},
     {"maxwhite", ToneMap::kMaxWhite},
     {"contrast", ToneMap::kContrast},
     {"falsecolors", ToneMap::kFalseColors},
     {"outofgamut", ToneMap::kOutOfGamut},
     {"yart-linear", ToneMap::kYartLinear},
     {"yart-reinhard", ToneMap::kYartReinhard}}};
inline constexpr std::array<std::pair<std::string_view, ProgressKind>, 5> kProgressKinds = {
    {{"auto", ProgressKind::kAuto},
     {"bar", ProgressKind::kBar},
     {"plain", ProgressKind::kPlain},
     {"json", ProgressKind::kJson},
     {"none", ProgressKind::kSilent}}};

/// The value called `name`, or a UsageError that lists the names.
template <class T, size_t N>
T by_name(std::string_view option, std::string_view name,
          const std::array<std::pair<std::string_view, T>, N>& names) {
  std::vector<std::string_view> all;
  for (const auto& [known, value] : names) {
    if (known == name) return value;
    all.push_back(known);
  }
  throw UsageError(fmt::format("{} {}: unknown{}; choose from {}", option, name,
                               did_you_mean(name, all), fmt::join(all, ", ")));
}

template <class T, size_t N>
std::string_view name_of(T wanted, const std::array<std::pair<std::string_view, T>, N>& names) {
  for (const auto& [name, value] : names)
    if (value == wanted) return name;
  return "unknown";
}

/// A value of --shadow-roulette.
inline std::string shadow_roulette_name(double share) {
  return share == kNoShadowRoulette ? "off" : fmt::format("{}", share);
}

}  // namespace yat
