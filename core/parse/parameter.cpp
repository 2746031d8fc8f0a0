#include "core/parse/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parse/numbers.h"

namespace pbrt {
namespace {

struct TypeRule {
  std::string_view name;
  ParamType type;
  std::size_t count = 1;  // numbers for each value
};

constexpr std::array kTypes{
    TypeRule{"bool", ParamType::boolean},        TypeRule{"integer", ParamType::integer},
    TypeRule{"float", ParamType::number},        TypeRule{"point2", ParamType::point2, 2},
    TypeRule{"vector2", ParamType::vector2, 2},  TypeRule{"point", ParamType::point3, 3},
    TypeRule{"point3", ParamType::point3, 3},    TypeRule{"vector", ParamType::vector3, 3},
    TypeRule{"vector3", ParamType::vector3, 3},  TypeRule{"normal", ParamType::normal, 3},
    TypeRule{"normal3", ParamType::normal, 3},   TypeRule{"color", ParamType::rgb, 3},
    TypeRule{"rgb", ParamType::rgb, 3},          TypeRule{"xyz", ParamType::xyz, 3},
    TypeRule{"blackbody", ParamType::blackbody}, TypeRule{"spectrum", ParamType::spectrum, 2},
    TypeRule{"string", ParamType::string},       TypeRule{"texture", ParamType::texture}};

constexpr Wanted kDeclaration{"the type and the name of a parameter, as in \"float fov\""};

const TypeRule& findType(const Location& where) {
  const std::string_view name = textAt(where);
  const auto* found = std::ranges::find(kTypes, name, &TypeRule::name);
  if (found != kTypes.end()) return *found;
  std::vector<std::string> names;
  for (const TypeRule& rule : kTypes) names.emplace_back(rule.name);
  throw Error(where, "unknown parameter type" + didYouMean(name, names));
}

bool isString(const Location& item) {
  return textAt(item).starts_with('"');
}
bool isNumber(const Location& item) {
  const char c = textAt(item)[0];
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

[[noreturn]] void fail(const Location& where, const Wanted& wanted) {
  throw Error(where, fmt::format("expected {}{}", wanted.what, wanted.of));
}

// The words of a declaration: "float radius", with any white space.
struct Declaration {
  std::array<Location, 2> words;
  std::size_t count = 0;
};

Declaration wordsOf(const Location& quoted) {
  constexpr std::string_view kSpace = " \t\v\f";
  const std::string_view text = textAt(quoted).substr(0, quoted.length - 1);
  Declaration found;
  for (std::size_t at = 1; (at = text.find_first_not_of(kSpace, at)) != text.npos; ++found.count) {
    if (found.count == found.words.size()) fail(quoted, kDeclaration);
    const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    found.words[found.count] = {quoted.source, quoted.begin + at, end - at};
    at = end;
  }
  return found;
}

// The items of a value that may not be numbers. An empty list is both.
std::span<const Location> itemsOf(const Value& value, const Wanted& wanted) {
  if (value.numbersOnly &&
      textAt(value.where).find_first_not_of("[] \t\r\n\v\f") != std::string::npos)
    fail(value.where, wanted);
  return value.items;
}

std::vector<std::string> stringsOf(const Value& value, const Wanted& wanted) {
  std::vector<std::string> strings;
  for (const Location& item : itemsOf(value, wanted)) {
    if (!isString(item)) fail(item, wanted);
    strings.push_back(unquote(item));
  }
  return strings;
}

std::vector<int> booleansOf(const Value& value) {
  constexpr Wanted kWanted{"\"true\" or \"false\", as the type is bool"};
  std::vector<int> booleans;
  for (const Location& item : itemsOf(value, kWanted)) {
    const std::string_view text = textAt(item);
    const bool isTrue = text == "true" || text == "\"true\"";
    if (!isTrue && text != "false" && text != "\"false\"") fail(item, kWanted);
    booleans.push_back(isTrue ? 1 : 0);
  }
  return booleans;
}

void checkCount(const TypeRule& rule, const Value& value, std::size_t count) {
  if (rule.type == ParamType::blackbody && count != 1 && count % 2 != 0)
    throw Error(value.where, fmt::format("blackbody takes a temperature, or pairs of a temperature "
                                         "and a scale, not {} numbers",
                                         count));
  if (count % rule.count == 0) return;
  throw Error(value.where,
              fmt::format("{} takes {} numbers for each value, in brackets; here {} {}", rule.name,
                          rule.count, count == 1 ? "is" : "are", count));
}

}  // namespace

std::string_view textAt(const Location& where) {
  return std::string_view(where.source->text).substr(where.begin, where.length);
}

std::string unquote(const Location& quoted) {
  constexpr std::string_view kEscapes = "\"\\'ntrbf";
  constexpr std::string_view kMeant = "\"\\'\n\t\r\b\f";
  const std::string_view text = textAt(quoted).substr(1, quoted.length - 2);
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      out += text[i];
      continue;
    }
    const std::size_t which = kEscapes.find(text[++i]);
    if (which == kEscapes.npos)
      throw Error({quoted.source, quoted.begin + i, 2},
                  "unknown escape; a backslash itself is written \\\\");
    out += kMeant[which];
  }
  return out;
}

template <class T>
void readNumbers(const Value& value, const Wanted& wanted, std::vector<T>& numbers) {
  if (value.numbersOnly)
    readNumbers({value.where.source, value.where.begin + 1, value.where.length - 2}, numbers);
  for (const Location& item : value.items) {
    if (!isNumber(item)) fail(item, wanted);
    readNumbers(item, numbers);
  }
}

template void readNumbers(const Value&, const Wanted&, std::vector<double>&);

namespace {

// The parameter of this type and name.
Param typed(const TypeRule& rule, const Location& name, const Location& declaration,
            const Value& value) {
  const Wanted wanted{"numbers, as the type is ", rule.name};
  Param param{rule.type, std::string(textAt(name)), declaration, value.where, {}};
  switch (rule.type) {
    case ParamType::boolean:
      param.values = booleansOf(value);
      break;
    case ParamType::integer:
      readNumbers(value, wanted, param.values.emplace<std::vector<int>>());
      break;
    case ParamType::string:
      param.values = stringsOf(value, {"quoted strings, as the type is string"});
      break;
    case ParamType::texture: {
      auto names = stringsOf(value, {"the quoted name of a texture"});
      if (names.size() != 1) throw Error(value.where, "expected the name of one texture");
      param.values = std::move(names);
      break;
    }
    case ParamType::spectrum:
      if (!value.items.empty() && isString(value.items[0])) {
        param.values = stringsOf(value, {"quoted names, as the first value is one"});
        break;
      }
      [[fallthrough]];
    default:
      auto& numbers = param.values.emplace<std::vector<float>>();
      readNumbers(value, wanted, numbers);
      checkCount(rule, value, numbers.size());
  }
  return param;
}

// What a value is if nobody says it.
std::string_view typeOf(const Value& value) {
  const std::string_view text = textAt(value.items.empty() ? value.where : value.items[0]);
  if (text == "true" || text == "false") return "bool";
  if (text.starts_with('"')) return "string";
  std::vector<double> numbers;
  readNumbers(value, {"numbers, as the first value is one"}, numbers);
  const auto isInteger = [](double x) { return x == std::floor(x) && std::abs(x) <= 0x7fffffff; };
  return std::ranges::all_of(numbers, isInteger) ? "integer" : "float";
}

}  // namespace

Param makeParam(const Location& declaration, const Value& value) {
  const auto [words, count] = wordsOf(declaration);
  if (count != 2) fail(declaration, kDeclaration);
  return typed(findType(words[0]), words[1], declaration, value);
}

Param makeOption(const Location& declaration, const Value& value) {
  const auto [words, count] = wordsOf(declaration);
  if (count != 1) return makeParam(declaration, value);
  const auto* rule = std::ranges::find(kTypes, typeOf(value), &TypeRule::name);
  return typed(*rule, words[0], declaration, value);
}

std::string_view declaredType(const Param& param) {
  if (!param.where.source) return "";
  const auto [words, count] = wordsOf(param.where);
  return count == 2 ? textAt(words[0]) : "";
}

}  // namespace pbrt
