#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace yat {

namespace {
std::string_view word(Severity severity) {
  switch (severity) {
    case Severity::kNote:
      return "note";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      return "error";
  }
  return "error";
}
}  // namespace

Diagnostics::Diagnostics(Sink sink) : sink_(std::move(sink)) {}
Diagnostics::~Diagnostics() = default;

uint32_t Diagnostics::add_file(std::string name) {
  files_.push_back(std::move(name));
  return uint32_t(files_.size() - 1);
}

std::string_view Diagnostics::file_name(uint32_t file) const {
  return file < files_.size() ? std::string_view(files_[file]) : std::string_view();
}

std::string Diagnostics::format(Severity severity, SourceLoc loc, std::string_view message) const {
  if (loc.file == SourceLoc::kNoFile) return fmt::format("{}: {}", word(severity), message);
  if (loc.line == 0) return fmt::format("{}: {}: {}", file_name(loc.file), word(severity), message);
  return fmt::format("{}:{}:{}: {}: {}", file_name(loc.file), loc.line, loc.column, word(severity),
                     message);
}

void Diagnostics::say(Severity severity, SourceLoc loc, std::string_view message,
                      std::string_view key) {
  if (severity == Severity::kError) ++errors_;
  if (severity == Severity::kWarning) ++warnings_;
  std::string id = fmt::format("{}{}", int(severity), key.empty() ? message : key);
  auto [at, is_new] = said_.try_emplace(std::move(id), Repeat{severity, std::string(message), 0});
  if (!is_new) {
    ++at->second.more;
    return;
  }
  sink_(severity, format(severity, loc, message));
}

void Diagnostics::note(SourceLoc loc, std::string_view message, std::string_view key) {
  say(Severity::kNote, loc, message, key);
}
void Diagnostics::warning(SourceLoc loc, std::string_view message, std::string_view key) {
  say(Severity::kWarning, loc, message, key);
}
void Diagnostics::error(SourceLoc loc, std::string_view message, std::string_view key) {
  say(Severity::kError, loc, message, key);
}

void Diagnostics::fail(SourceLoc loc, std::string_view message) const {
  throw Error(format(Severity::kError, loc, message));
}

void Diagnostics::flush_repeats() {
  // In a fixed order, so that two runs say the same.
  std::vector<const Repeat*> repeats;
  for (const auto& [id, repeat] : said_)
    if (repeat.more) repeats.push_back(&repeat);
  std::sort(repeats.begin(), repeats.end(),
            [](const Repeat* a, const Repeat* b) { return a->message < b->message; });
  for (const Repeat* repeat : repeats)
    sink_(repeat->severity, fmt::format("{}: {} ({} more like this)", word(repeat->severity),
                                        repeat->message, repeat->more));
  said_.clear();
}

std::string_view nearest_name(std::string_view name,
                              const std::vector<std::string_view>& candidates) {
  // Costs in halves: a change of case 1, anything else 2.
  const auto distance = [](std::string_view a, std::string_view b) {
    std::vector<int> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = int(2 * j);
    for (size_t i = 1; i <= a.size(); ++i) {
      int diagonal = row[0];
      row[0] = int(2 * i);
      for (size_t j = 1; j <= b.size(); ++j) {
        const auto x = static_cast<unsigned char>(a[i - 1]),
                   y = static_cast<unsigned char>(b[j - 1]);
        const int change = x == y ? 0 : std::tolower(x) == std::tolower(y) ? 1 : 2;
        const int best = std::min({diagonal + change, row[j] + 2, row[j - 1] + 2});
        diagonal = row[j];
        row[j] = best;
      }
    }
    return row[b.size()];
  };
  std::string_view best;
  // A third of the letters may differ; a name of other letters is a guess, not a suggestion.
  int best_distance = int(std::max<size_t>(2, name.size() / 3 * 2)) + 1;
  for (std::string_view candidate : candidates) {
    const int d = distance(name, candidate);
    if (d < best_distance) {
      best_distance = d;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates) {
  const std::string_view near = nearest_name(name, candidates);
  return near.empty() ? std::string() : fmt::format(" (did you mean \"{}\"?)", near);
}

}  // namespace yat
