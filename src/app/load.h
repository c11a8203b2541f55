#pragma once
// From the command line to a scene that is ready to render: what every command does first.

#include <chrono>
#include <string_view>

#include "app/arguments.h"
#include "app/console.h"
#include "app/report.h"
#include "base/error.h"
#include "base/parallel.h"
#include "scene/compile.h"
#include "scene/description.h"
#include "wavefront/plan.h"

namespace yat {

class Stopwatch {
 public:
  /// Seconds since the last call, or since the beginning.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// A scene made ready to render, with what it was made from.
struct Loaded {
  Description description;
  Scene scene;
  Plan plan;
  Integrator integrator = Integrator::kPath;
  PhaseTimes time;
};

/// Reads and compiles the scene and makes the plan, with what the command line says otherwise. Says
/// by whose rules on `console`. Throws Error.
void load(const Arguments& arguments, const KernelTable& kernels, ThreadPool& pool,
          Console& console, Diagnostics& diagnostics, Loaded& loaded);

/// The plan of a scene that was compiled with these arguments, or with others that differ in
/// sampler, depth, samples and seed alone.
Plan plan_of(const Arguments& arguments, const KernelTable& kernels, const Scene& scene);

/// How colours multiply: as asked for, else as suits the dialect.
ColourMode colour_mode(const Arguments& arguments);

/// Messages go to the console as far as they are wanted.
Diagnostics::Sink sink_for(Console& console, Verbosity verbosity);

/// Writes to standard output, which may be a full disk or a pipe that nobody reads any more: throws
/// ResourceError.
void print(std::string_view text);

/// Throws ResourceError if the film, kept in so many parts, would not fit. Asks before the memory
/// is touched: a system that lends more than it has would end the program in the middle of the
/// work.
void require_film_memory(const FilmSettings& film, FeatureSet features, uint32_t parts = 1);

}  // namespace yat
