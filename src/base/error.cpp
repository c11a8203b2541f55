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

std::string Diagnostics::place(SourceLoc loc) const {
  return fmt::format("{}:{}:{}", file_name(loc.file), loc.line, loc.column);
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

std::string quote(std::string_view text) {
  constexpr size_t kLongest = 200;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongest)) {
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (c == '\r')
      out += "\\r";
    else if (static_cast<unsigned char>(c) < 32 || c == 127)
      out += fmt::format("\\{:03}", int(static_cast<unsigned char>(c)));
    else
      out += c;
  }
  if (text.size() > kLongest) out += "...";
  return out + "\"";
}

bool same_but_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

std::string_view nearest_name(std::string_view name,
                              const std::vector<std::string_view>& candidates) {
  constexpr size_t kLongest = 64;
  if (name.size() > kLongest) return {};
  // Costs in halves: a change of case 1, anything else 2, two letters exchanged as well (the edit
  // distance of Damerau 1964 in its optimal string alignment form).
  const auto distance = [](std::string_view a, std::string_view b) {
    const size_t width = b.size() + 1;
    std::vector<int> table((a.size() + 1) * width);
    const auto at = [&](size_t i, size_t j) -> int& { return table[i * width + j]; };
    for (size_t i = 0; i <= a.size(); ++i) at(i, 0) = int(2 * i);
    for (size_t j = 0; j <= b.size(); ++j) at(0, j) = int(2 * j);
    for (size_t i = 1; i <= a.size(); ++i) {
      for (size_t j = 1; j <= b.size(); ++j) {
        const auto x = static_cast<unsigned char>(a[i - 1]),
                   y = static_cast<unsigned char>(b[j - 1]);
        const int change = x == y ? 0 : std::tolower(x) == std::tolower(y) ? 1 : 2;
        int best = std::min({at(i - 1, j - 1) + change, at(i - 1, j) + 2, at(i, j - 1) + 2});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          best = std::min(best, at(i - 2, j - 2) + 2);
        at(i, j) = best;
      }
    }
    return at(a.size(), b.size());
  };
  std::string_view best;
  // A third of the letters may differ; a name of other letters is a guess, not a suggestion.
  int best_distance = int(std::max<size_t>(2, name.size() / 3 * 2)) + 1;
  for (std::string_view candidate : candidates) {
    if (candidate.size() > kLongest) continue;
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
  return near.empty() ? std::string() : fmt::format(" (did you mean {}?)", quote(near));
}

}  // namespace yat
