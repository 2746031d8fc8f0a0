/* The grammar of a scene file: it knows the shape of each statement, not its meaning. */

%require "3.8"
%language "c++"
%define api.namespace {pbrt}
%define api.parser.class {SceneParser}
%define api.location.type {pbrt::Location}
%define api.value.type variant
%define api.value.automove
%define api.token.constructor
%define parse.error custom
%define parse.lac full
%locations

%param {Scanner& scanner}
%parse-param {const DirectiveSink& sink}
%parse-param {const IncludeHandler& include}

%code requires {
#include "core/parse/directive.h"
#include "core/parse/parameter.h"

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

SceneParser::symbol_type yylex(Scanner& scanner) { return scanner.next(); }

Directive named(DirectiveKind kind, const Location& where, std::vector<Location> names,
                ParamList params = {}) {
  Directive directive{kind, where};
  for (const Location& name : names) directive.words.push_back(unquote(name));
  directive.wordsWhere = std::move(names);
  directive.params = std::move(params);
  return directive;
}

Directive numeric(DirectiveKind kind, const Location& where, const Value& value) {
  const auto& [keyword, arguments, count] = syntax(kind);
  const std::string wanted = fmt::format("{} numbers after {}", count, keyword);
  const std::vector<double> numbers = numbersOf<double>(value, wanted);
  if (numbers.size() != count)
    throw Error(where, fmt::format("expected {}, not {}", wanted, numbers.size()));
  Directive directive{kind, where};
  std::ranges::copy(numbers, directive.numbers.begin());
  return directive;
}

Directive activeTransform(DirectiveKind kind, const Location& where, const Location& time) {
  const std::vector<std::string> times{"StartTime", "EndTime", "All"};
  Directive directive{kind, where, {std::string(textAt(time))}, {time}};
  if (std::ranges::find(times, directive.words[0]) == times.end())
    throw Error(time, "expected StartTime, EndTime or All after ActiveTransform" +
                          didYouMean(directive.words[0], times));
  return directive;
}

Directive option(DirectiveKind kind, const Location& where, const Location& declaration,
                 const Value& value) {
  Directive directive{kind, where};
  directive.params.push_back(makeOption(declaration, value));
  return directive;
}

std::string didYouMeanBool(const Location& word) {
  return didYouMean(textAt(word), std::vector<std::string>{"true", "false"});
}

}  // namespace
}  // namespace pbrt
}

%token END 0
%token <DirectiveKind> PLAIN NAMED MEDIA PLUGIN TEXTURE NUMERIC TIME OPTION
%token INCLUDE STRING NUMBER BOOL WORD OPEN CLOSE
%token LIST  /* numbers in brackets */

%nterm <ParamList> parameters
%nterm <Value> value numbers
%nterm <std::vector<Location>> items bare

%%

scene: %empty | scene statement;

statement:
    PLAIN                                     { sink(Directive{$1, @1}); }
  | NAMED STRING                              { sink(named($1, @1, {@2})); }
  | MEDIA STRING                              { sink(named($1, @1, {@2})); }
  | MEDIA STRING STRING                       { sink(named($1, @1, {@2, @3})); }
  | PLUGIN STRING parameters                  { sink(named($1, @1, {@2}, $3)); }
  | TEXTURE STRING STRING STRING parameters   { sink(named($1, @1, {@2, @3, @4}, $5)); }
  | NUMERIC numbers                           { sink(numeric($1, @1, $2)); }
  | TIME WORD                                 { sink(activeTransform($1, @1, @2)); }
  | OPTION STRING value                       { sink(option($1, @1, @2, $3)); }
  | INCLUDE STRING                            { include(@2); }
  ;

parameters:
    %empty                   {}
  | parameters STRING value  { $$ = $1; $$.push_back(makeParam(@2, $3)); }
  ;

value:
    LIST              { $$ = Value{@$, true, {}}; }
  | OPEN CLOSE        { $$ = Value{@$, false, {}}; }
  | OPEN items CLOSE  { $$ = Value{@$, false, $2}; }
  | item              { $$ = Value{@$, false, {@1}}; }
  ;

numbers:
    LIST              { $$ = Value{@$, true, {}}; }
  | OPEN CLOSE        { $$ = Value{@$, false, {}}; }
  | OPEN items CLOSE  { $$ = Value{@$, false, $2}; }
  | bare              { $$ = Value{@$, false, $1}; }
  ;

items:
    item        { $$ = {@1}; }
  | items item  { $$ = $1; $$.push_back(@2); }
  ;

item: NUMBER | STRING | BOOL;

bare:
    NUMBER       { $$ = {@1}; }
  | bare NUMBER  { $$ = $1; $$.push_back(@2); }
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
  const Location& statement = nextStatement && !isEnd ? scanner.keywordBefore : scanner.keyword;
  const std::string_view keyword = textAt(statement);
  if (expects(symbol_kind::S_OPEN))
    throw missing(statement, fmt::format("numbers after {}", keyword));
  if (expects(symbol_kind::S_WORD))
    throw missing(statement, "StartTime, EndTime or All after ActiveTransform");
  if (keyword == "Texture")
    throw missing(statement, "three quoted names after Texture: name, type and class");
  if (keyword == "Option")
    throw missing(statement, "a parameter after Option, as in \"integer seed\" 1");
  throw missing(statement, fmt::format("a quoted name after {}", keyword));
}

void SceneParser::error(const Location& where, const std::string& message) {
  throw Error(where, message);
}

}  // namespace pbrt
