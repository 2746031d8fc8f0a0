/* The grammar of a scene file: it knows the shape of each statement, not its meaning. */

%require "3.8"
%language "c++"
%define api.namespace {pbrt}
%define api.parser.class {SceneParser}
%define api.location.type {pbrt::Location}
%define api.value.type {pbrt::DirectiveKind}
%define parse.error custom
%define parse.lac full
%locations

%param {Scanner& scanner}
%parse-param {Statement& statement}
%parse-param {const IncludeHandler& include}

%code requires {
#include "core/parse/statement.h"

namespace pbrt {
class Scanner;
// Carries out an Include or Import of the quoted name at this place.
using IncludeHandler = std::function<void(const Location& name)>;
}  // namespace pbrt
}

%code {
#include <fmt/format.h>

#include <algorithm>

#include "core/parse/scanner.h"

// From the first byte of the first part to the last byte of the last.
#define YYLLOC_DEFAULT(place, parts, count)                                             \
  do {                                                                                  \
    if (count) {                                                                        \
      place = YYRHSLOC(parts, 1);                                                       \
      place.length =                                                                    \
          YYRHSLOC(parts, count).begin + YYRHSLOC(parts, count).length - place.begin;   \
    } else {                                                                            \
      place = YYRHSLOC(parts, 0);                                                       \
      place.begin += place.length;                                                      \
      place.length = 0;                                                                 \
    }                                                                                   \
  } while (false)

namespace pbrt {
namespace {

int yylex(DirectiveKind* kind, Location* where, Scanner& scanner) {
  const int token = scanner.next();
  *kind = scanner.kind;
  *where = scanner.token;
  return token;
}

std::string didYouMeanBool(const Location& word) {
  return didYouMean(textAt(word), std::vector<std::string>{"true", "false"});
}

}  // namespace
}  // namespace pbrt
}

%token END 0
%token PLAIN NAMED MEDIA PLUGIN TEXTURE NUMERIC TIME OPTION  /* keywords, by what follows them */
%token INCLUDE STRING NUMBER BOOL WORD OPEN CLOSE
%token LIST  /* numbers in brackets */

%%

scene: %empty | scene statement;

statement:
    PLAIN                              { statement.end($1, @1); }
  | NAMED name                         { statement.end($1, @1); }
  | MEDIA name                         { statement.end($1, @1); }
  | MEDIA name name                    { statement.end($1, @1); }
  | PLUGIN name parameters             { statement.end($1, @1); }
  | TEXTURE name name name parameters  { statement.end($1, @1); }
  | NUMERIC numbers                    { statement.numbers($1, @1); statement.end($1, @1); }
  | TIME WORD                          { statement.time(@2); statement.end($1, @1); }
  | OPTION STRING value                { statement.option(@2); statement.end($1, @1); }
  | INCLUDE STRING                     { include(@2); }
  ;

name: STRING  { statement.name(@1); };

parameters: %empty | parameters STRING value  { statement.parameter(@2); };

value: bracketed | item  { statement.items(@1); };

numbers: bracketed | bare  { statement.items(@1); };

bracketed:
    LIST              { statement.list(@1); }
  | OPEN CLOSE        { statement.items(@$); }
  | OPEN items CLOSE  { statement.items(@$); }
  ;

items: item | items item;

item:
    NUMBER  { statement.item(@1); }
  | STRING  { statement.item(@1); }
  | BOOL    { statement.item(@1); }
  ;

bare:
    NUMBER       { statement.item(@1); }
  | bare NUMBER  { statement.item(@2); }
  ;

%%

namespace pbrt {

// Says in plain words what is missing or too much.
void SceneParser::report_syntax_error(const context& ctx) const {
  std::array<symbol_kind_type, YYNTOKENS> expected{};
  const int count = ctx.expected_tokens(expected.data(), YYNTOKENS);
  const auto expects = [&](symbol_kind_type kind) {
    return std::find(expected.begin(), expected.begin() + count, kind) != expected.begin() + count;
  };
  const symbol_kind_type found = ctx.token();
  const bool isItem = found == symbol_kind::S_NUMBER || found == symbol_kind::S_BOOL ||
                      found == symbol_kind::S_STRING || found == symbol_kind::S_LIST ||
                      found == symbol_kind::S_OPEN;
  const bool isName = found == symbol_kind::S_WORD;
  const bool isClose = found == symbol_kind::S_CLOSE;
  const bool isEnd = found == symbol_kind::S_YYEOF;
  const bool nextStatement = isEnd || !(isItem || isName || isClose);

  if (expects(symbol_kind::S_CLOSE)) {
    if (nextStatement) throw Error(scanner.bracket, "this [ is not closed");
    throw Error(ctx.location(), "expected numbers, quoted strings, true or false in the list" +
                                    (isName ? didYouMeanBool(ctx.location()) : ""));
  }
  if (expects(symbol_kind::S_PLAIN)) {
    if (isName)
      throw Error(ctx.location(),
                  (expects(symbol_kind::S_NUMBER) ? "expected a number or a directive"
                                                  : "unknown directive") +
                      didYouMean(textAt(ctx.location()), directiveNames()));
    if (isClose) throw Error(ctx.location(), "this ] has no [");
    if (expects(symbol_kind::S_STRING))
      throw Error(ctx.location(), "expected a parameter, as in \"float fov\" 30, or the next "
                                  "directive; several values need brackets");
    throw Error(ctx.location(), "expected a directive");
  }

  // What a statement lacks is shown where it is missed, unless something else stands there.
  const auto missing = [&](const Location& after, const std::string& what) {
    return Error(nextStatement ? after : ctx.location(), "expected " + what);
  };
  if (expects(symbol_kind::S_OPEN) && expects(symbol_kind::S_STRING))
    throw missing(scanner.string,
                  "the value of the parameter" + (isName ? didYouMeanBool(ctx.location()) : ""));
  const Location& begin = nextStatement && !isEnd ? scanner.keywordBefore : scanner.keyword;
  const std::string_view keyword = textAt(begin);
  if (expects(symbol_kind::S_OPEN))
    throw missing(begin, fmt::format("numbers after {}", keyword));
  if (expects(symbol_kind::S_WORD))
    throw missing(begin, "StartTime, EndTime or All after ActiveTransform");
  if (keyword == "Texture")
    throw missing(begin, "three quoted names after Texture: name, type and class");
  if (keyword == "Option")
    throw missing(begin, "a parameter after Option, as in \"integer seed\" 1");
  throw missing(begin, fmt::format("a quoted name after {}", keyword));
}

void SceneParser::error(const Location& where, const std::string& message) {
  throw Error(where, message);
}

}  // namespace pbrt
