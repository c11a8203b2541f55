#pragma once
// Progress while rendering: a bar on a terminal, plain lines or JSON lines elsewhere.

#include <cstdint>
#include <string>

#include "app/arguments.h"
#include "app/console.h"

namespace yat {

/// How far the render is.
struct ProgressState {
  double seconds = 0;          ///< since rendering began
  uint64_t samples_done = 0;   ///< paths, over all pixels
  uint64_t samples_total = 0;  ///< 0: no limit but the time
  uint64_t rays = 0;
  double time_limit = 0;  ///< [s]; 0: none

  /// Share done in [0, 1]: by samples or by time, whichever ends first.
  double share() const;
  /// Seconds that are left at the speed so far; negative while nothing is known.
  double seconds_left() const;
};

/// "12.3 M": three digits and a thousands letter.
std::string short_number(double value);
/// "1 h 02 min", "3 min 05 s", "7.1 s".
std::string short_time(double seconds);

std::string progress_bar(const ProgressState& state, uint32_t columns);
std::string progress_line(const ProgressState& state);
/// One JSON object. `event`: "progress" or "done".
std::string progress_json(const ProgressState& state, std::string_view event);

/// Shows states at the pace that suits the kind. Calls come from one thread at a time.
class Progress {
 public:
  Progress(Console& console, ProgressKind kind);
  virtual ~Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  virtual void show(const ProgressState& state);
  /// The last state: takes the bar away, writes the last line.
  virtual void finish(const ProgressState& state);

 private:
  Console& console_;
  ProgressKind kind_;
  double next_ = 0;  ///< seconds of the state from which on to show again
};

}  // namespace yat
