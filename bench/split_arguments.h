#pragma once
// A command line for two readers.

#include <string_view>
#include <vector>

namespace yat::bench {

/// The words of a command line, the program's name first in both: --benchmark_... options are those
/// of Google Benchmark, all others the program's own.
struct SplitArguments {
  std::vector<char*> library;
  std::vector<const char*> own;

  SplitArguments(int argc, char** argv) : library{argv[0]}, own{argv[0]} {
    for (int i = 1; i < argc; ++i)
      if (std::string_view(argv[i]).starts_with("--benchmark_"))
        library.push_back(argv[i]);
      else
        own.push_back(argv[i]);
  }
};

}  // namespace yat::bench
