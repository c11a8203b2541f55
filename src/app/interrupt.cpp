#include "app/interrupt.h"

#include <unistd.h>

#include <array>
#include <csignal>

namespace yat {

namespace {

std::atomic<bool> stop_asked{false};
std::atomic<bool> signalled{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
constexpr std::array kSignals = {SIGINT, SIGTERM};
std::array<struct sigaction, kSignals.size()> previous;

// Only what POSIX allows in a signal handler.
void on_signal(int) {
  if (signalled.exchange(true)) _exit(130);
  stop_asked.store(true);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  stop_asked = false;
  signalled = false;
  struct sigaction action{};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &previous[i]);
}

InterruptGuard::~InterruptGuard() {
  for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &previous[i], nullptr);
}

bool InterruptGuard::interrupted() const {
  return signalled;
}

std::atomic<bool>& InterruptGuard::stop() {
  return stop_asked;
}

}  // namespace yat
