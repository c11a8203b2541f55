#pragma once
// Renders as YART's command line asks, and says on standard output what YART said (lxs 12.8).

#include "app/console.h"
#include "app/run.h"
#include "app/yart_options.h"

namespace yat {

/// Throws as other commands do; an interrupted render is written as far as it is.
ExitCode yart_command(const YartArguments& arguments, Console& console);

}  // namespace yat
