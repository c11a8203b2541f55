#pragma once
// The one writer to stderr: whole lines, and one status line below them that redraws itself.

#include <mutex>
#include <string>
#include <string_view>

namespace yat {

class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool is_terminal() const { return terminal_; }
  /// Columns of the terminal, 80 where unknown.
  uint32_t columns() const;
  /// Writes a line above the status line. Flushed.
  void line(std::string_view text);
  /// Replaces the status line; empty takes it away. Flushed.
  void status(std::string_view text);

 private:
  void write(std::string_view text);
  std::mutex mutex_;
  std::string status_;
  bool terminal_;
};

}  // namespace yat
