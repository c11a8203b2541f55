#pragma once
// Which kernel tables this build has, which run here, and which one is in use.

#include <span>
#include <string>
#include <string_view>

#include "kernels/table.h"

namespace yat {

/// An instruction set this build was made for.
struct IsaEntry {
  const char* name;
  bool here;  ///< this CPU (and its operating system) can run it
  const KernelTable* (*table)();
};

/// All of them, lowest first.
std::span<const IsaEntry> built_isas();

/// The table to use: `wanted` if not empty, else the environment variable YAT_ISA, else the best
/// that runs here. Throws Error when a named one is unknown or does not run here, naming those that
/// do.
const KernelTable& select_kernels(std::string_view wanted = {});

}  // namespace yat
