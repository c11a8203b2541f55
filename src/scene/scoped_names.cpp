#include "scene/scoped_names.h"

#include <fmt/format.h>

namespace yat {

const ScopedNames::Entry* ScopedNames::find(std::string_view name) const {
  const auto found = names_.find(name);
  return found == names_.end() ? nullptr : &found->second;
}

const ScopedNames::Entry* ScopedNames::find_any_case(std::string_view name) const {
  if (const Entry* exact = find(name)) return exact;
  for (const auto& [known, entry] : names_)
    if (same_but_case(known, name)) return &entry;
  return nullptr;
}

void ScopedNames::define(std::string_view name, Entry entry) {
  const auto [at, is_new] = names_.try_emplace(std::string(name), entry);
  log_.push_back({at->first, is_new ? std::nullopt : std::optional<Entry>(at->second)});
  at->second = entry;
}

void ScopedNames::undo_to(size_t mark) {
  while (log_.size() > mark) {
    const Change& change = log_.back();
    const auto at = names_.find(change.name);
    if (change.before) {
      at->second = *change.before;
    } else {
      ended_[change.name] = at->second.loc;
      names_.erase(at);
    }
    log_.pop_back();
  }
}

std::string ScopedNames::hint(std::string_view name, const Diagnostics& diagnostics) const {
  const auto ended = ended_.find(name);
  if (ended != ended_.end())
    return fmt::format(", it was defined at {} in a block that has ended, define it outside",
                       diagnostics.place(ended->second));
  // A comparison with every name each time would take quadratic time in a broken scene.
  constexpr uint32_t kHints = 50, kCandidates = 2000;
  if (++hints_ > kHints) return {};
  std::vector<std::string_view> candidates;
  for (const auto& [candidate, entry] : names_) {
    if (candidates.size() == kCandidates) break;
    candidates.push_back(candidate);
  }
  return did_you_mean(name, candidates);
}

}  // namespace yat
