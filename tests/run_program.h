#pragma once
// Runs a program as a person would and keeps what it said.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace yat {

struct ProgramResult {
  int code = -1;  ///< exit code, or 128 + signal as a shell says
  std::string out, err;
};

inline std::string read_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write_whole(const std::filesystem::path& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// An empty folder for the test that runs, beside those of the other tests of its group.
inline std::filesystem::path empty_folder(std::string_view group) {
  const std::filesystem::path folder =
      std::filesystem::path(YAT_TEST_OUTPUT_DIR) / group /
      testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// A program under way, its standard output and error going to files in `folder`, which is also its
/// current folder.
class RunningProgram {
 public:
  RunningProgram(const std::vector<std::string>& command, const std::filesystem::path& folder)
      : out_(folder / "stdout.txt"), err_(folder / "stderr.txt") {
    // Empty before the program starts: nobody reads what an earlier one said.
    write_whole(out_, {});
    write_whole(err_, {});
    std::vector<char*> arguments;
    for (const std::string& argument : command)
      arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ == 0) {
      const int out = open(out_.c_str(), O_WRONLY | O_TRUNC),
                err = open(err_.c_str(), O_WRONLY | O_TRUNC);
      if (out < 0 || err < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0 || chdir(folder.c_str()) != 0)
        _exit(126);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
  }
  ~RunningProgram() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void signal(int number) const { kill(pid_, number); }
  std::string err_so_far() const { return read_whole(err_); }
  /// Waits until standard error holds `text` or the program has ended; whether it does.
  bool wait_for(std::string_view text) {
    while (!ended()) {
      if (err_so_far().find(text) != std::string::npos) return true;
      usleep(2000);
    }
    return err_so_far().find(text) != std::string::npos;
  }
  ProgramResult wait() {
    if (pid_ > 0) {
      waitpid(pid_, &status_, 0);
      pid_ = 0;
    }
    const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    return {code, read_whole(out_), read_whole(err_)};
  }

 private:
  bool ended() {
    if (pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = 0;
    return pid_ == 0;
  }
  std::filesystem::path out_, err_;
  pid_t pid_ = 0;
  int status_ = 0;
};

inline ProgramResult run_program(const std::vector<std::string>& command,
                                 const std::filesystem::path& folder) {
  return RunningProgram(command, folder).wait();
}

}  // namespace yat
