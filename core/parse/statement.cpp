#include "core/parse/statement.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace pbrt {

void Statement::name(const Location& quoted) {
  directive_.words.push_back(unquote(quoted));
  directive_.wordsWhere.push_back(quoted);
}

void Statement::time(const Location& word) {
  const std::vector<std::string> times{"StartTime", "EndTime", "All"};
  directive_.words.emplace_back(textAt(word));
  directive_.wordsWhere.push_back(word);
  if (std::ranges::find(times, textAt(word)) == times.end())
    throw Error(word, "expected StartTime, EndTime or All after ActiveTransform" +
                          didYouMean(textAt(word), times));
}

void Statement::list(const Location& where) {
  value_.where = where;
  value_.numbersOnly = true;
}

void Statement::parameter(const Location& declaration) {
  if (directive_.params.size() == kMostParameters)
    throw Error(declaration,
                fmt::format("a statement takes at most {} parameters", kMostParameters));
  add(makeParam(declaration, value_));
}

void Statement::option(const Location& declaration) {
  add(makeOption(declaration, value_));
}

void Statement::add(Param param) {
  directive_.params.push_back(std::move(param));
  value_.items.clear();
  value_.numbersOnly = false;
}

void Statement::numbers(DirectiveKind kind, const Location& keyword) {
  const auto& [name, arguments, count] = syntax(kind);
  numbers_.clear();
  readNumbers(value_, {"numbers after ", name}, numbers_);
  if (numbers_.size() != count)
    throw Error(keyword,
                fmt::format("expected {} numbers after {}, not {}", count, name, numbers_.size()));
  std::ranges::copy(numbers_, directive_.numbers.begin());
  value_.items.clear();
  value_.numbersOnly = false;
}

void Statement::end(DirectiveKind kind, const Location& keyword) {
  directive_.kind = kind;
  directive_.where = keyword;
  try {
    sink_(std::move(directive_));
  } catch (const std::bad_alloc&) {
    throw Error(keyword, kNoMemory);
  }
  directive_.words.clear();
  directive_.wordsWhere.clear();
  directive_.numbers = {};
  directive_.params.clear();
}

}  // namespace pbrt
