#pragma once
// Names that a block may define and that are forgotten when it ends.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace yat {

class ScopedNames {
 public:
  struct Entry {
    uint32_t row;   ///< what the name stands for
    SourceLoc loc;  ///< where it was defined
  };

  /// The visible definition, or nullptr. Valid until the next change.
  const Entry* find(std::string_view name) const;
  /// The same; if there is none, the first in alphabetical order that differs in case only.
  const Entry* find_any_case(std::string_view name) const;
  /// A later definition hides an earlier one.
  void define(std::string_view name, Entry entry);

  /// A block begins: remember this; it ends: undo_to() that.
  size_t mark() const { return log_.size(); }
  void undo_to(size_t mark);

  /// Of a name that is not visible: ", it was defined at ... in a block that has ended", or a
  /// suggestion, or empty.
  std::string hint(std::string_view name, const Diagnostics& diagnostics) const;

 private:
  struct Change {
    std::string name;
    std::optional<Entry> before;
  };
  std::map<std::string, Entry, std::less<>> names_;
  std::map<std::string, SourceLoc, std::less<>> ended_;
  std::vector<Change> log_;
  mutable uint32_t hints_ = 0;
};

}  // namespace yat
