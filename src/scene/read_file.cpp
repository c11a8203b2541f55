#include "scene/read_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace yat {

std::string FileText::read(const std::string& path) {
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  // "e": not inherited by programs that the process may start.
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rbe"));
  if (!file) return std::strerror(errno);
  struct stat info{};
  if (fstat(fileno(file.get()), &info) != 0) return std::strerror(errno);
  if (S_ISDIR(info.st_mode)) return "is a directory";
  // A device has no end.
  if (!S_ISREG(info.st_mode) && !S_ISFIFO(info.st_mode)) return "is not a file";

  // One byte more than the size that the system states, so that the end is seen without growing.
  size_t room = S_ISREG(info.st_mode) ? size_t(info.st_size) + 1 : size_t(1) << 16;
  data_ = std::make_unique_for_overwrite<char[]>(room);
  size_ = 0;
  for (;;) {
    size_ += std::fread(data_.get() + size_, 1, room - size_, file.get());
    if (std::ferror(file.get())) return std::strerror(errno);
    if (size_ < room) return {};
    auto larger = std::make_unique_for_overwrite<char[]>(room * 2);
    std::copy_n(data_.get(), size_, larger.get());
    data_ = std::move(larger);
    room *= 2;
  }
}

}  // namespace yat
