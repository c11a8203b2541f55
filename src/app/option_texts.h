#pragma once
// One table of options per command, from which the parser, --help and the documentation's tables
// are made.

#include <span>
#include <string>
#include <string_view>

namespace yat {

/// One option as people see it.
struct OptionText {
  std::string_view flags;     ///< "-o,--output"
  std::string_view value;     ///< "FILE"; empty for a flag
  std::string_view fallback;  ///< what holds without it
  std::string_view text;      ///< what it does, one sentence
};

std::span<const OptionText> render_option_texts();
std::span<const OptionText> info_option_texts();
std::span<const OptionText> diff_option_texts();

/// What --help prints for a command.
std::string option_help(std::string_view usage, std::string_view text,
                        std::span<const OptionText> options);

/// The options as rows of a Markdown table, one line each: what docs and README must hold.
std::string option_table(std::span<const OptionText> options);

}  // namespace yat
