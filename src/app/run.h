#pragma once
// The program without its main(): commands and exit codes.

namespace yat {

/// What the program returns to the shell.
enum class ExitCode : int {
  kDone = 0,
  kBadScene = 1,        ///< scene or input
  kBadUsage = 2,        ///< command line or environment
  kResources = 3,       ///< memory, disk or the like
  kDiffers = 4,         ///< yat diff: beyond the thresholds for failing
  kDiffersALittle = 5,  ///< and for warning
  kInterrupted = 130
};

/// Runs the command line; prints what went wrong.
ExitCode run(int argc, const char* const* argv);

}  // namespace yat
