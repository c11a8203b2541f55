#pragma once
// Errors and warnings with a place in a source file, and the one sink they go to.

#include <cstdint>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace yat {

/// A place in a scene file. file = kNoFile: no place (command line, whole program).
struct SourceLoc {
  static constexpr uint32_t kNoFile = 0xffffffffu;
  uint32_t file = kNoFile;  ///< index given by Diagnostics::add_file
  uint32_t line = 0;        ///< from 1
  uint32_t column = 0;      ///< from 1, in bytes
};

/// Bad scene or input; the message is complete (place included). Exit code 1.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bad command line or environment. Exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Out of memory, disk or the like. Exit code 3.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Severity { kNote, kWarning, kError };

/// Collects what is to be said of a scene. Libraries never print: messages go to the sink that the
/// program sets. The same message text of the same severity is passed on once and then counted;
/// `flush_repeats` says how many more there were.
class Diagnostics {
 public:
  using Sink = std::function<void(Severity, std::string_view line)>;

  explicit Diagnostics(Sink sink);
  ~Diagnostics();
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;

  /// Registers a file by the name to show; its index goes into SourceLoc.
  uint32_t add_file(std::string name);
  std::string_view file_name(uint32_t file) const;

  /// "scene.lxs:12:7: warning: what, and what to do". `key` groups repeats (default: the text).
  void note(SourceLoc loc, std::string_view message, std::string_view key = {});
  void warning(SourceLoc loc, std::string_view message, std::string_view key = {});
  /// An error that leaves something out but lets reading go on; counted in error_count().
  void error(SourceLoc loc, std::string_view message, std::string_view key = {});
  /// An error that ends the work: throws Error with the formatted line.
  [[noreturn]] void fail(SourceLoc loc, std::string_view message) const;

  /// "file:line:column", to name a second place in a message.
  std::string place(SourceLoc loc) const;

  /// "file:line:column: severity: message" (without a place: "severity: message").
  std::string format(Severity severity, SourceLoc loc, std::string_view message) const;

  void flush_repeats();
  uint64_t error_count() const { return errors_; }
  uint64_t warning_count() const { return warnings_; }

 private:
  void say(Severity severity, SourceLoc loc, std::string_view message, std::string_view key);

  struct Repeat {
    Severity severity;
    std::string message;
    uint64_t more = 0;
  };
  Sink sink_;
  std::vector<std::string> files_;
  std::unordered_map<std::string, Repeat> said_;
  uint64_t errors_ = 0, warnings_ = 0;
};

/// `"text"` on one line for a message: control characters as in scene strings, long text shortened.
std::string quote(std::string_view text);

/// Whether the two differ in the case of letters a-z at most.
bool same_but_case(std::string_view a, std::string_view b);

/// The candidate nearest to `name` in edit distance (case counts half), or empty when none is near
/// enough to be what was meant. Names of more than 64 bytes are not looked for: the cost is
/// quadratic.
std::string_view nearest_name(std::string_view name,
                              const std::vector<std::string_view>& candidates);

/// ` (did you mean "X"?)`, or empty.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace yat
