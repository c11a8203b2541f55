#include "base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
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

/// Where the bytes go.
struct Target {
  std::string file;      ///< behind symbolic links
  bool special = false;  ///< a device, pipe or socket: not ours to replace
};

Target target_of(const std::string& path) {
  struct stat status{};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
    if (!S_ISREG(status.st_mode)) return {path, true};
  }
  std::error_code error;
  // A link to what is not there yet counts as well.
  fs::path file(path);
  constexpr int kMostLinks = 40;
  for (int i = 0; fs::is_symlink(fs::symlink_status(file, error)); ++i) {
    if (i == kMostLinks) fail(path, ELOOP);
    const fs::path to = fs::read_symlink(file, error);
    if (error) fail(path, error.value());
    file = to.is_absolute() ? to : file.parent_path() / to;
  }
  const fs::path folder = file.parent_path();
  if (!folder.empty()) {
    fs::create_directories(folder, error);
    if (error) fail(path, error.value());
  }
  return {file.string(), false};
}

/// Beside its name, so that the rename stays on one file system. The process id keeps two programs
/// that write the same name apart.
std::string beside(const std::string& file) {
  return fmt::format("{}.{}.part", file, getpid());
}

/// 0, or the error.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes.remove_prefix(size_t(written));
  }
  return 0;
}

}  // namespace

void require_writable(const std::string& path) {
  const Target target = target_of(path);
  if (target.special) {
    if (access(target.file.c_str(), W_OK) != 0) fail(path, errno);
    return;
  }
  // Asking for permissions says yes on file systems that then refuse.
  const std::string part = beside(target.file);
  const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail(path, errno);
  close(file);
  unlink(part.c_str());
}

void write_whole_file(const std::string& path, std::string_view bytes) {
  const Target target = target_of(path);
  const std::string part = target.special ? target.file : beside(target.file);
  const int flags =
      target.special ? O_WRONLY | O_CLOEXEC : O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;
  const int file = open(part.c_str(), flags, 0666);
  if (file < 0) fail(path, errno);
  int error = write_all(file, bytes);
  // Some file systems say only here that they are full.
  if (close(file) != 0 && !error) error = errno;
  if (!target.special) {
    if (!error && std::rename(part.c_str(), target.file.c_str()) != 0) error = errno;
    if (error) unlink(part.c_str());
  }
  if (error) fail(path, error);
}

}  // namespace yat
