#pragma once
// The command line and what was read from it.

#include <string>
#include <vector>

#include "app/arguments.h"
#include "app/diff.h"
#include "app/yart_options.h"

namespace yat {

enum class Command { kRender, kInfo, kDiff, kConverge, kYart, kHelp };

struct CommandLine {
  Command command = Command::kHelp;
  Arguments arguments;
  YartArguments yart;
  DiffArguments diff;
  std::vector<std::string> converge;  ///< words for parse_converge_arguments()
  std::string text;                   ///< kHelp: what --help or --version prints
};

/// Reads the command line. Throws UsageError with a message that names the option; for YART's
/// command line see parse_yart_command_line().
CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace yat
