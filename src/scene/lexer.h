#pragma once
// Scene text -> tokens with places, across included files.
//
// One pass over a buffer read once; a token is a view into it (a string with escapes: into a
// scratch string). Include is carried out here, as in LuxRender: it may stand between any two
// tokens.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/error.h"
#include "scene/read_file.h"

namespace yat {

enum class TokenKind { kEnd, kWord, kString, kNumber, kOpen, kClose };

/// Valid until the next call of Lexer::next().
struct Token {
  TokenKind kind = TokenKind::kEnd;
  SourceLoc loc;
  std::string_view text;  ///< word, number as written; string without quotes, escapes resolved
  std::string_view raw;   ///< string: as written between the quotes
};

/// "the word Shape", "the string \"a\"", "the end of the file": for messages.
std::string describe(const Token& token);

class Lexer {
 public:
  /// `directory`: where includes are looked up (then in the including file's folder).
  Lexer(Diagnostics& diagnostics, std::string directory, bool may_include);

  /// Starts with this text, which must outlive the lexer.
  void open_text(std::string_view text, const std::string& name);
  /// Starts with this file. Throws Error.
  void open_main(const std::string& path);

  /// The next token; kEnd at the end of the main file, again and again. Throws Error on an
  /// unterminated string and on an Include that cannot be carried out.
  Token next();

  /// Reads numbers into `out` while there are well-formed ones that T can hold; anything else is
  /// left for next(). The way through large arrays.
  template <class T>
  void read_numbers(std::vector<T>& out);

  /// Is there nothing left but white space and comments? (Carries out no Include.)
  bool at_end();

  uint64_t hash() const { return hash_; }  ///< FNV-1a 64 of all text opened so far

 private:
  struct Source {
    FileText text;
    std::string path;       ///< as shown
    std::string canonical;  ///< to find recursion; empty for text from memory
    uint32_t file = 0;
    const char* at = nullptr;
    const char* end = nullptr;
    const char* line_start = nullptr;
    uint32_t line = 1;
    bool warned = false;  ///< of an illegal character
  };

  void push(std::unique_ptr<Source> source, std::string_view text);
  void include(const Token& name);
  SourceLoc place(const Source& source, const char* at) const;
  void new_line(Source& source);
  void skip_space(Source& source);
  void skip_illegal(Source& source);
  Token lex(Source& source);
  Token lex_string(Source& source);

  Diagnostics& diagnostics_;
  std::string directory_;
  bool may_include_;
  std::vector<std::unique_ptr<Source>> sources_;  ///< innermost last; never empty once opened
  std::unordered_map<std::string, uint32_t> file_numbers_;
  std::string scratch_;  ///< the last string that had escapes
  uint64_t hash_ = 14695981039346656037ull;
  uint64_t opened_ = 0;
};

}  // namespace yat
