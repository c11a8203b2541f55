#include "app/option_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace yat {

namespace {

std::string_view long_name(const OptionText& option) {
  const size_t comma = option.flags.find(',');
  return option.flags.substr(comma == std::string_view::npos ? 0 : comma + 1);
}

const OptionText* find(std::span<const OptionText> table, std::string_view name) {
  for (const OptionText& option : table)
    if (long_name(option) == name || option.flags.substr(0, option.flags.find(',')) == name)
      return &option;
  return nullptr;
}

}  // namespace

SplitWords split_words(std::span<const std::string> words, std::span<const OptionText> table,
                       std::string_view help) {
  SplitWords split;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.size() < 2 || word[0] != '-') {
      split.others.push_back(word);
      continue;
    }
    const size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    const std::string name = word.substr(0, equals);
    const OptionText* const option = find(table, name);
    if (!option) {
      std::vector<std::string_view> names;
      for (const OptionText& known : table) names.push_back(long_name(known));
      throw UsageError(fmt::format("{}: unknown{}; {} lists what there is", name,
                                   did_you_mean(name, names), help));
    }
    GivenOption given{std::string(long_name(*option)), {}};
    if (equals != std::string::npos) {
      given.value = word.substr(equals + 1);
      if (option->value.empty()) throw UsageError(fmt::format("{}: takes no value", name));
    } else if (!option->value.empty()) {
      if (++i == words.size()) throw UsageError(fmt::format("{}: add {}", name, option->value));
      given.value = words[i];
    }
    split.options.push_back(std::move(given));
  }
  return split;
}

std::vector<std::string> shell_words(std::string_view text) {
  std::vector<std::string> words;
  bool inside = false, quoted = false;
  for (const char letter : text) {
    const bool space = letter == ' ' || letter == '\t' || letter == '\n';
    if (space && !quoted) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (letter == '"')
      quoted = !quoted;
    else
      words.back() += letter;
  }
  return words;
}

std::vector<GivenOption> laid_over(std::span<const GivenOption> over,
                                   std::span<const GivenOption> under) {
  std::vector<GivenOption> all(over.begin(), over.end());
  for (const GivenOption& option : under)
    if (std::none_of(over.begin(), over.end(),
                     [&](const GivenOption& o) { return o.name == option.name; }))
      all.push_back(option);
  std::stable_sort(all.begin(), all.end(),
                   [](const GivenOption& a, const GivenOption& b) { return a.name < b.name; });
  return all;
}

std::string options_text(std::span<const GivenOption> options) {
  std::string text;
  for (const GivenOption& option : options) {
    if (!text.empty()) text += ' ';
    text += option.name;
    if (!option.value.empty()) text += " " + option.value;
  }
  return text;
}

}  // namespace yat
