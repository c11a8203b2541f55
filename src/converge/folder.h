#pragma once
// The folder of an experiment while it grows: what was measured is on disk as soon as it is, and is
// found again when the same experiment goes on.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "converge/pixel_moments.h"
#include "converge/record.h"

namespace yat {

/// runs.jsonl: a header line (what must be the same for runs to be compared), then a record a line;
/// runs.csv: the same as a table; moments-*.bin: pixels of runs or of the reference summed up.
class ConvergeFolder {
 public:
  /// Opens or makes the folder. `header`: an object; runs that are there are kept if theirs equals
  /// it. A last line that was cut short is dropped.
  /// restart  runs that are there are thrown away instead.
  /// Throws Error naming what differs if the folder holds an experiment with another header, and
  /// ResourceError if it cannot be written.
  ConvergeFolder(std::string path, const nlohmann::ordered_json& header, bool restart);

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

  const std::vector<RunRecord>& runs() const { return runs_; }
  const RunRecord* find(const std::string& variant, uint32_t spp, uint32_t run) const;
  /// Writes the record before it returns. A run that is there already is an std::logic_error.
  void add(const RunRecord& record);

  /// Sums of an earlier call, of this size, or none.
  PixelMoments moments(const std::string& name, uint32_t width, uint32_t height) const;
  void keep(const std::string& name, const PixelMoments& moments) const;

 private:
  void append(const std::string& name, const std::string& line) const;
  std::string path_;
  std::vector<RunRecord> runs_;
};

}  // namespace yat
