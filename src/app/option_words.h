#pragma once
// A command line as a list of options with their values, so that one list can be laid over another.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/option_texts.h"

namespace yat {

struct GivenOption {
  std::string name;   ///< "--sampler", also where "-o" stood
  std::string value;  ///< empty for a flag
  auto operator<=>(const GivenOption&) const = default;
};

struct SplitWords {
  std::vector<GivenOption> options;
  std::vector<std::string> others;  ///< words that belong to no option
};

/// Words as a shell hands them over: "--name value", "--name=value", "-o value", flags. Throws
/// UsageError for options that are not in the table and for missing values; `help` is the command
/// that lists them.
SplitWords split_words(std::span<const std::string> words, std::span<const OptionText> table,
                       std::string_view help);

/// "a  b" as {"a", "b"}. A part in double quotes is one word.
std::vector<std::string> shell_words(std::string_view text);

/// The options of `over` and those of `under` that `over` does not name, sorted by name.
std::vector<GivenOption> laid_over(std::span<const GivenOption> over,
                                   std::span<const GivenOption> under);

/// "--a 1 --b"
std::string options_text(std::span<const GivenOption> options);

}  // namespace yat
