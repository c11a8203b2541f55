#include "app/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace yat {

namespace {
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error) {
  throw ResourceError(fmt::format("error: {}: cannot write: {}", path, std::strerror(error)));
}
}  // namespace

void require_writable(const std::string& path) {
  const fs::path target(path);
  fs::path folder = target.parent_path();
  if (folder.empty()) folder = ".";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(path, error.value());
  if (fs::is_directory(target)) fail(path, EISDIR);
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail(path, errno);
}

void write_text_file(const std::string& path, std::string_view text) {
  require_writable(path);
  // Of this process alone, so that two programs writing the same name do not mix.
  const std::string beside = fmt::format("{}.{}.tmp", path, getpid());
  std::FILE* file = std::fopen(beside.c_str(), "wb");
  if (!file) fail(path, errno);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed || std::rename(beside.c_str(), path.c_str()) != 0) {
    const int error = written ? errno : write_error;
    std::remove(beside.c_str());
    fail(path, error);
  }
}

}  // namespace yat
