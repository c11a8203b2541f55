#pragma once
// `yat converge`: error against time of one or more ways to render a scene.

#include "app/console.h"
#include "app/converge_options.h"
#include "app/run.h"

namespace yat {

/// Measures what is not in the folder yet and writes the report; tables go to standard output.
/// kInterrupted if it was stopped: what is finished is kept, and reported. Throws Error and
/// ResourceError.
ExitCode converge(const ConvergeArguments& arguments, Console& console);

}  // namespace yat
