#include "scene/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "scene/directives.h"
#include "scene/lexer.h"
#include "scene/statement.h"

namespace yat {
namespace {

const Directive& find_directive(const Token& token, Diagnostics& diagnostics) {
  const std::span<const Directive> all = directives();
  if (token.kind != TokenKind::kWord)
    diagnostics.fail(token.loc,
                     fmt::format("expected a directive, found {}, remove it or write the "
                                 "directive it belongs to before it",
                                 describe(token)));
  const auto found = std::lower_bound(all.begin(), all.end(), token.text,
                                      [](const Directive& d, auto name) { return d.name < name; });
  if (found != all.end() && found->name == token.text) return *found;
  std::vector<std::string_view> names = {"Include"};
  for (const Directive& directive : all) names.push_back(directive.name);
  const std::string hint = did_you_mean(token.text, names);
  diagnostics.fail(token.loc,
                   fmt::format("unknown directive {}{}", token.text.substr(0, 80),
                               hint.empty() ? ", remove it or correct its spelling" : hint));
}

Statement read_arguments(StatementReader& reader, const Directive& directive, SourceLoc loc) {
  Statement statement;
  statement.loc = loc;
  statement.directive = directive.name;
  reader.begin(directive.name, directive.usage);
  for (const char kind : directive.arguments) {
    if (kind == 's')
      statement.strings.push_back(reader.string());
    else if (kind == 'n')
      statement.numbers.push_back(reader.number());
    else if (kind == 'm')
      statement.numbers = reader.array(16);
    else if (kind == 'a')
      statement.numbers = reader.array(0);
    else
      statement.parameters = reader.parameters();
  }
  return statement;
}

void parse(Lexer& lexer, Description& description, Diagnostics& diagnostics, bool may_look) {
  StatementReader reader(lexer, diagnostics, description.directory, may_look);
  SceneBuilder builder(description, diagnostics);
  reader.next();
  while (!builder.world_ended()) {
    const Token& token = reader.token();
    if (token.kind == TokenKind::kEnd)
      diagnostics.fail(token.loc, builder.world_begun()
                                      ? "WorldEnd is missing, the scene may be cut off, add it at "
                                        "the end"
                                      : "the file has no WorldBegin, so it holds no scene");
    const Directive& directive = find_directive(token, diagnostics);
    const SourceLoc loc = token.loc;
    // Nothing is read behind the WorldEnd that counts.
    if (directive.name == "WorldEnd" && builder.world_begun()) {
      Statement statement;
      statement.loc = loc;
      builder.run(directive, statement);
      if (!lexer.at_end()) diagnostics.warning(loc, "what follows WorldEnd is ignored");
      break;
    }
    reader.next();
    Statement statement = read_arguments(reader, directive, loc);
    builder.run(directive, statement);
  }
  description.hash = lexer.hash();
}

}  // namespace

Description read_scene(const std::string& path, Diagnostics& diagnostics, Dialect dialect) {
  Description description;
  description.dialect = dialect;
  description.file = path;
  description.directory = std::filesystem::path(path).parent_path().string();
  Lexer lexer(diagnostics, description.directory, true);
  lexer.open_main(path);
  parse(lexer, description, diagnostics, true);
  return description;
}

Description parse_scene(std::string_view text, const std::string& name,
                        const std::string& directory, Diagnostics& diagnostics, bool may_include,
                        Dialect dialect) {
  Description description;
  description.dialect = dialect;
  description.file = name;
  description.directory = directory;
  Lexer lexer(diagnostics, directory, may_include);
  lexer.open_text(text, name);
  parse(lexer, description, diagnostics, may_include);
  return description;
}

}  // namespace yat
