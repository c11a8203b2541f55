#pragma once
// Ctrl-C and SIGTERM while rendering: the first asks the render to stop, the second ends the
// program.

#include <atomic>

namespace yat {

/// Handles SIGINT and SIGTERM while it lives; one at a time. The first signal sets stop(); a second
/// one ends the program at once with exit code 130.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether a signal came.
  bool interrupted() const;
  /// The flag to hand to the renderer; also set by whoever wants to stop for another reason.
  std::atomic<bool>& stop();
};

}  // namespace yat
