#pragma once
// The command line of `yat converge`: its own options, and those of `yat render` for all variants
// or for one.

#include <span>
#include <string>
#include <vector>

#include "app/arguments.h"
#include "app/option_texts.h"

namespace yat {

/// One way to render the scene.
struct ConvergeVariant {
  std::string name;
  std::string options;    ///< all that hold for it, in one order
  std::string scene_key;  ///< variants with the same key render the same compiled scene
  Arguments arguments;
  /// Numbers of samples per pixel, ascending; with a noise target, which decides them itself,
  /// kTargetRung alone.
  std::vector<uint32_t> ladder;
  bool to_noise() const { return arguments.noise_target.has_value(); }
};

struct ConvergeArguments {
  std::string scene, folder;
  std::vector<ConvergeVariant> variants;  ///< at least one
  ConvergeVariant shared;                 ///< what holds for all; makes the reference
  std::string reference;                  ///< a picture; empty: one is made
  uint32_t runs = 16;
  std::vector<uint32_t> ladder;  ///< ascending; of variants without a noise target
  double time_per_run = 0;       ///< [s]; 0: no limit
  uint32_t seed = 0;
  bool restart = false;
  ProgressKind progress = ProgressKind::kAuto;
  Verbosity verbosity = Verbosity::kNormal;
};

std::span<const OptionText> converge_option_texts();
std::string converge_help();

/// words: those after `yat converge`. Throws UsageError.
ConvergeArguments parse_converge_arguments(const std::vector<std::string>& words);

}  // namespace yat
