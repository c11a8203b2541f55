#pragma once
// A whole file in memory, read once.

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace yat {

class FileText {
 public:
  std::string_view view() const { return {data_.get(), size_}; }

  /// Reads all of `path` (a pipe too: until its end). Returns the empty string, or why it cannot be
  /// read ("No such file or directory", "is a directory").
  std::string read(const std::string& path);

 private:
  std::unique_ptr<char[]> data_;
  size_t size_ = 0;
};

}  // namespace yat
