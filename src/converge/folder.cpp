#include "converge/folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "base/error.h"
#include "base/whole_file.h"

namespace yat {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  // A file name need not be UTF-8; JSON must be.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// "scene_hash (was "12", is "34"), threads (...)".
std::string differences(const Json& was, const Json& is) {
  std::vector<std::string> list;
  for (const auto& [key, value] : is.items()) {
    const std::string old = was.contains(key) ? text_of(was[key]) : "nothing";
    if (old != text_of(value))
      list.push_back(fmt::format("{} (was {}, is {})", key, old, text_of(value)));
  }
  return list.empty() ? "its form" : fmt::format("{}", fmt::join(list, ", "));
}

std::string moments_name(const std::string& name) {
  return fmt::format("moments-{}.bin", name);
}

}  // namespace

ConvergeFolder::ConvergeFolder(std::string path, const Json& header, bool restart)
    : path_(std::move(path)) {
  require_writable(file("runs.jsonl"));
  if (restart) {
    std::error_code ignored;  // What cannot be removed cannot be written either, which is told.
    for (const auto& entry : std::filesystem::directory_iterator(path_, ignored))
      if (entry.path().filename().string().starts_with("moments-"))
        std::filesystem::remove(entry.path(), ignored);
  } else {
    std::ifstream lines(file("runs.jsonl"));
    std::string line;
    if (std::getline(lines, line)) {
      const Json found = Json::parse(line, nullptr, false);
      if (text_of(found) != text_of(header))
        throw Error(fmt::format(
            "{}: error: the folder holds runs of another experiment, which differs in {}: give "
            "another -o, or --restart to throw them away",
            file("runs.jsonl"), differences(found, header)));
      while (std::getline(lines, line)) {
        const Json object = Json::parse(line, nullptr, false);
        if (object.is_discarded()) break;
        runs_.push_back(record_of(object));
      }
    }
  }
  std::string json = text_of(header) + "\n", csv = std::string(csv_header()) + "\n";
  for (const RunRecord& run : runs_) {
    json += text_of(record_json(run)) + "\n";
    csv += csv_line(run) + "\n";
  }
  write_whole_file(file("runs.jsonl"), json);
  write_whole_file(file("runs.csv"), csv);
}

const RunRecord* ConvergeFolder::find(const std::string& variant, uint32_t spp,
                                      uint32_t run) const {
  for (const RunRecord& record : runs_)
    if (record.run == run && record.spp == spp && record.variant == variant) return &record;
  return nullptr;
}

void ConvergeFolder::add(const RunRecord& record) {
  if (find(record.variant, record.spp, record.run))
    throw std::logic_error("ConvergeFolder::add: the run is there already");
  append("runs.jsonl", text_of(record_json(record)));
  append("runs.csv", csv_line(record));
  runs_.push_back(record);
}

void ConvergeFolder::append(const std::string& name, const std::string& line) const {
  std::FILE* const out = std::fopen(file(name).c_str(), "ab");
  const std::string text = line + "\n";
  bool written = out && std::fwrite(text.data(), 1, text.size(), out) == text.size();
  if (out) written = std::fclose(out) == 0 && written;
  if (!written)
    throw ResourceError(
        fmt::format("error: {}: cannot write: {}: free some space and call again; "
                    "the runs so far are kept",
                    file(name), std::strerror(errno)));
}

PixelMoments ConvergeFolder::moments(const std::string& name, uint32_t width,
                                     uint32_t height) const {
  PixelMoments moments(width, height);
  std::ifstream in(file(moments_name(name)), std::ios::binary);
  std::ostringstream bytes;
  if (in) bytes << in.rdbuf();
  moments.restore(bytes.str());
  return moments;
}

void ConvergeFolder::keep(const std::string& name, const PixelMoments& moments) const {
  write_whole_file(file(moments_name(name)), moments.bytes());
}

}  // namespace yat
