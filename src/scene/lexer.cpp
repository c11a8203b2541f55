#include "scene/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "scene/numbers.h"

namespace yat {
namespace {

constexpr size_t kMaxDepth = 32;           // as LuxRender
constexpr uint64_t kMaxIncludes = 100000;  // files that include each other twice must end

enum CharClass : uint8_t {
  kIllegal,
  kSpace,
  kNewLine,
  kComment,
  kQuote,
  kBracket,
  kLetter,   // letters and _
  kNumeral,  // digits + - .
};

constexpr std::array<CharClass, 256> kClasses = [] {
  std::array<CharClass, 256> table{};
  for (int c = 'a'; c <= 'z'; ++c) table[size_t(c)] = table[size_t(c - 'a' + 'A')] = kLetter;
  for (int c = '0'; c <= '9'; ++c) table[size_t(c)] = kNumeral;
  table['_'] = kLetter;
  table['+'] = table['-'] = table['.'] = kNumeral;
  table[' '] = table['\t'] = table['\f'] = table['\v'] = kSpace;
  table['\n'] = table['\r'] = kNewLine;
  table['#'] = kComment;
  table['"'] = kQuote;
  table['['] = table[']'] = kBracket;
  return table;
}();

CharClass class_of(char c) {
  return kClasses[static_cast<unsigned char>(c)];
}

/// What a number or word runs into: `1x`, `1.2.3` and `0x10` are one bad number each.
bool continues_token(char c) {
  return class_of(c) >= kLetter;
}

uint64_t fnv1a(uint64_t hash, std::string_view text) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::string describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::kEnd:
      return "the end of the file";
    case TokenKind::kWord:
      return fmt::format("the word {}", token.text.substr(0, 80));
    case TokenKind::kString:
      return fmt::format("the string {}", quote(token.text));
    case TokenKind::kNumber:
      return fmt::format("the number {}", token.text.substr(0, 80));
    case TokenKind::kOpen:
      return "[";
    case TokenKind::kClose:
      return "]";
  }
  return {};
}

Lexer::Lexer(Diagnostics& diagnostics, std::string directory, bool may_include)
    : diagnostics_(diagnostics), directory_(std::move(directory)), may_include_(may_include) {}

void Lexer::open_text(std::string_view text, const std::string& name) {
  auto source = std::make_unique<Source>();
  source->path = name;
  push(std::move(source), text);
}

void Lexer::open_main(const std::string& path) {
  auto source = std::make_unique<Source>();
  source->path = path;
  if (const std::string reason = source->text.read(path); !reason.empty())
    throw Error(fmt::format("{}: error: cannot be read: {}", path, reason));
  std::error_code ignored;
  source->canonical = std::filesystem::canonical(path, ignored).string();
  const std::string_view text = source->text.view();
  push(std::move(source), text);
}

void Lexer::push(std::unique_ptr<Source> source, std::string_view text) {
  hash_ = fnv1a(hash_, text);
  const auto [number, is_new] = file_numbers_.try_emplace(source->path, 0);
  if (is_new) number->second = diagnostics_.add_file(source->path);
  source->file = number->second;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  source->at = source->line_start = text.data();
  source->end = text.data() + text.size();
  sources_.push_back(std::move(source));
}

SourceLoc Lexer::place(const Source& source, const char* at) const {
  return {source.file, source.line, uint32_t(at - source.line_start) + 1};
}

void Lexer::new_line(Source& source) {
  if (*source.at == '\r' && source.at + 1 != source.end && source.at[1] == '\n') ++source.at;
  source.line_start = ++source.at;
  ++source.line;
}

void Lexer::skip_illegal(Source& source) {
  if (!source.warned) {
    source.warned = true;
    const auto byte = static_cast<unsigned char>(*source.at);
    const std::string shown = byte > 32 && byte < 127 ? fmt::format("'{}'", *source.at)
                                                      : fmt::format("with code {}", byte);
    diagnostics_.warning(place(source, source.at),
                         fmt::format("character {} has no meaning here, skipped like any further "
                                     "ones in this file",
                                     shown),
                         fmt::format("illegal character in {}", source.path));
  }
  ++source.at;
}

void Lexer::skip_space(Source& source) {
  while (source.at != source.end) {
    switch (class_of(*source.at)) {
      case kSpace:
        ++source.at;
        break;
      case kNewLine:
        new_line(source);
        break;
      case kComment:
        while (source.at != source.end && class_of(*source.at) != kNewLine) ++source.at;
        break;
      case kIllegal:
        skip_illegal(source);
        break;
      default:
        return;
    }
  }
}

Token Lexer::next() {
  for (;;) {
    Source& source = *sources_.back();
    skip_space(source);
    if (source.at == source.end && sources_.size() > 1) {
      sources_.pop_back();
      continue;
    }
    Token token = lex(source);
    if (token.kind != TokenKind::kWord || token.text != "Include") return token;
    skip_space(source);
    const Token name = lex(source);
    if (name.kind != TokenKind::kString)
      diagnostics_.fail(
          name.loc, fmt::format("Include needs a file name in quotes, found {}", describe(name)));
    include(name);
  }
}

Token Lexer::lex(Source& source) {
  Token token;
  token.loc = place(source, source.at);
  if (source.at == source.end) return token;
  const char* begin = source.at;
  switch (class_of(*begin)) {
    case kQuote:
      return lex_string(source);
    case kBracket:
      token.kind = *source.at++ == '[' ? TokenKind::kOpen : TokenKind::kClose;
      return token;
    case kLetter:
      token.kind = TokenKind::kWord;
      while (source.at != source.end && (class_of(*source.at) == kLetter || is_digit(*source.at)))
        ++source.at;
      break;
    default:
      token.kind = TokenKind::kNumber;
      while (source.at != source.end && continues_token(*source.at)) ++source.at;
      break;
  }
  token.text = {begin, size_t(source.at - begin)};
  return token;
}

Token Lexer::lex_string(Source& source) {
  Token token;
  token.kind = TokenKind::kString;
  token.loc = place(source, source.at);
  const char* begin = ++source.at;
  const auto unterminated = [&] {
    diagnostics_.fail(token.loc,
                      "the string that starts here has no end on its line, add the "
                      "closing \"");
  };
  const char* plain = begin;  // start of what is not yet in scratch_
  bool escaped = false;
  for (;; ++source.at) {
    if (source.at == source.end) unterminated();
    const char c = *source.at;
    if (c == '"') break;
    if (class_of(c) == kNewLine) unterminated();
    if (c != '\\') continue;
    if (!escaped) scratch_.clear();
    escaped = true;
    scratch_.append(plain, source.at);
    if (++source.at == source.end) unterminated();
    switch (*source.at) {
      case 'n':
        scratch_ += '\n';
        break;
      case 't':
        scratch_ += '\t';
        break;
      case 'r':
        scratch_ += '\r';
        break;
      case 'b':
        scratch_ += '\b';
        break;
      case 'f':
        scratch_ += '\f';
        break;
      case '\n':
      case '\r':  // the string goes on in the next line
        new_line(source);
        --source.at;
        break;
      default:
        if (source.end - source.at >= 3 && is_digit(source.at[0]) && is_digit(source.at[1]) &&
            is_digit(source.at[2])) {
          const int code =
              (source.at[0] - '0') * 100 + (source.at[1] - '0') * 10 + (source.at[2] - '0');
          scratch_ += static_cast<char>(code & 255);
          source.at += 2;
        } else {
          scratch_ += *source.at;
        }
    }
    plain = source.at + 1;
  }
  token.raw = {begin, size_t(source.at - begin)};
  if (escaped) {
    scratch_.append(plain, source.at);
    token.text = scratch_;
  } else {
    token.text = token.raw;
  }
  ++source.at;
  return token;
}

bool Lexer::at_end() {
  for (;;) {
    Source& source = *sources_.back();
    skip_space(source);
    if (source.at != source.end) return false;
    if (sources_.size() == 1) return true;
    sources_.pop_back();
  }
}

template <class T>
void Lexer::read_numbers(std::vector<T>& out) {
  Source& source = *sources_.back();
  for (;;) {
    skip_space(source);
    const NumberRead<T> number = read_number<T>(source.at, source.end);
    if (number.status != NumberStatus::kOk ||
        (number.end != source.end && continues_token(*number.end)))
      return;
    out.push_back(number.value);
    source.at = number.end;
  }
}
template void Lexer::read_numbers(std::vector<float>&);
template void Lexer::read_numbers(std::vector<double>&);
template void Lexer::read_numbers(std::vector<int32_t>&);

void Lexer::include(const Token& name) {
  namespace fs = std::filesystem;
  if (!may_include_)
    diagnostics_.fail(name.loc, "Include cannot be used here, the scene must be in one text");
  const Source& from = *sources_.back();
  if (sources_.size() > kMaxDepth)
    diagnostics_.fail(name.loc, fmt::format("Include is nested more than {} deep", kMaxDepth));
  if (++opened_ > kMaxIncludes)
    diagnostics_.fail(name.loc, fmt::format("more than {} files included", kMaxIncludes));

  std::string slashed(name.raw);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const std::string from_folder = fs::path(from.path).parent_path().string();
  const auto below = [](const std::string& folder, std::string_view file) {
    return folder.empty() ? std::string(file) : (fs::path(folder) / file).string();
  };
  struct Try {
    std::string path;
    std::string remark;
  };
  std::string decoded(name.text);
  std::vector<Try> tries = {{below(directory_, decoded), {}}};
  tries.push_back({below(from_folder, decoded),
                   fmt::format("{} is not in the folder of the main file, taken from the folder of "
                               "the file that includes it",
                               quote(decoded))});
  if (name.raw != name.text || decoded.find('\\') != std::string::npos) {
    const std::string remark = fmt::format(
        "the backslashes in {} are taken as folder separators, write / instead", quote(name.raw));
    tries.push_back({below(directory_, slashed), remark});
    tries.push_back({below(from_folder, slashed), remark});
  }
  std::error_code ignored;
  const auto found = std::find_if(tries.begin(), tries.end(), [&](const Try& t) {
    return t.path.find('\0') == std::string::npos && fs::exists(t.path, ignored);
  });
  if (found == tries.end())
    diagnostics_.fail(name.loc, fmt::format("Include {}: no such file, looked for {}{}",
                                            quote(decoded), quote(tries[0].path),
                                            tries[1].path != tries[0].path
                                                ? fmt::format(" and {}", quote(tries[1].path))
                                                : std::string()));
  if (!found->remark.empty()) diagnostics_.note(name.loc, found->remark);

  auto source = std::make_unique<Source>();
  source->path = found->path;
  source->canonical = fs::canonical(found->path, ignored).string();
  for (const auto& open : sources_)
    if (!source->canonical.empty() && open->canonical == source->canonical)
      diagnostics_.fail(name.loc, fmt::format("Include {}: this file is being read already, remove "
                                              "the circle",
                                              quote(decoded)));
  if (const std::string reason = source->text.read(source->path); !reason.empty())
    diagnostics_.fail(name.loc, fmt::format("Include {}: {} cannot be read: {}", quote(decoded),
                                            source->path, reason));
  const std::string_view text = source->text.view();
  push(std::move(source), text);
}

}  // namespace yat
