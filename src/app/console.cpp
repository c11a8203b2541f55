#include "app/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace yat {

namespace {
// Back to the first column and erase to the end of the line.
constexpr std::string_view kEraseLine = "\r\x1b[K";
}  // namespace

Console::Console() : terminal_(isatty(STDERR_FILENO) == 1) {}

Console::~Console() {
  status({});
}

uint32_t Console::columns() const {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

void Console::write(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void Console::line(std::string_view text) {
  const std::lock_guard lock(mutex_);
  std::string out;
  if (!status_.empty()) out += kEraseLine;
  out += text;
  out += '\n';
  out += status_;
  write(out);
}

void Console::status(std::string_view text) {
  const std::lock_guard lock(mutex_);
  if (text.empty() && status_.empty()) return;
  status_ = text;
  write(std::string(kEraseLine) + status_);
}

}  // namespace yat
