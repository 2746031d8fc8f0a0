#include "core/parse/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "core/parse/parameter.h"

namespace pbrt {
namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kDeepestIndent = 20;  // blocks; else deep nesting prints blanks alone

std::string quote(std::string_view text) {
  constexpr std::string_view kEscaped = "\"\\\n\t\r\b\f";
  constexpr std::string_view kWritten = "\"\\ntrbf";
  std::string out = "\"";
  for (const char c : text) {
    const std::size_t which = kEscaped.find(c);
    if (which != kEscaped.npos) out += '\\';
    out += which == kEscaped.npos ? c : kWritten[which];
  }
  return out + '"';
}

// The items with blanks between; `lineBreak` comes where a line of the columns is full.
template <class T>
std::string join(std::span<const T> items, const std::string& lineBreak) {
  std::string out;
  std::string item;
  const std::size_t width = kColumns - (lineBreak.size() - 1);
  std::size_t column = 0;
  for (const T& value : items) {
    item.clear();
    fmt::format_to(std::back_inserter(item), "{}", value);
    if (!out.empty()) {
      const bool full = column + 1 + item.size() > width;
      out += full ? lineBreak : " ";
      column = full ? 0 : column + 1;
    }
    out += item;
    column += item.size();
  }
  return out;
}

// A list in brackets: on the line if it fits into what is `left` of it, else on lines of its own.
template <class T>
std::string bracketed(std::span<const T> items, std::size_t left, const std::string& indent) {
  const std::string inner = '\n' + indent + "  ";
  const std::string text = join(items, inner);
  if (text.size() + 2 <= left && text.find('\n') == text.npos) return '[' + text + ']';
  return '[' + inner + text + '\n' + indent + ']';
}

template <class T>
std::string valueText(const std::vector<T>& items, std::size_t left, const std::string& indent) {
  if (items.size() == 1) return fmt::format("{}", items[0]);
  return bracketed<T>(items, left, indent);
}

// Quoted truth is v1 to v3's, bare truth v4's: it stays as it is written.
std::vector<std::string> truths(const Param& p) {
  const bool quoted = textAt(p.valueWhere).find('"') != std::string_view::npos;
  std::vector<std::string> out;
  for (const int value : std::get<std::vector<int>>(p.values)) {
    const std::string text = value ? "true" : "false";
    out.push_back(quoted ? quote(text) : text);
  }
  return out;
}

// A parameter as it would stand on a line of its own after `indent`.
std::string parameterText(DirectiveKind kind, const Param& p, const std::string& indent) {
  // The type of an option may be missing, and pbrt-v4 itself wants it to be. Other types keep their
  // spelling: "color" or "rgb" tells for which generation a scene is written.
  const std::string declaration = kind == DirectiveKind::Option
                                      ? std::string(textAt(p.where))
                                      : fmt::format("\"{} {}\"", declaredType(p), p.name);
  const std::size_t used = indent.size() + declaration.size() + 1;
  const std::size_t left = kColumns - std::min(kColumns, used);
  const auto text = [&]() -> std::string {
    if (p.type == ParamType::boolean) return valueText(truths(p), left, indent);
    if (const auto* ints = std::get_if<std::vector<int>>(&p.values))
      return valueText(*ints, left, indent);
    if (const auto* floats = std::get_if<std::vector<float>>(&p.values))
      return valueText(*floats, left, indent);
    std::vector<std::string> quoted;
    for (const std::string& s : std::get<std::vector<std::string>>(p.values))
      quoted.push_back(quote(s));
    return valueText(quoted, left, indent);
  };
  return declaration + ' ' + text();
}

// The keyword and what belongs to it besides parameters.
std::string head(const Directive& d, const std::string& indent) {
  const Syntax& s = syntax(d.kind);
  std::string out(s.keyword);
  for (const std::string& word : d.words)
    out += ' ' + (s.arguments == Arguments::time ? word : quote(word));
  const std::span<const double> numbers(d.numbers.data(), s.numbers);
  if (numbers.size() == d.numbers.size())
    out += ' ' + bracketed(numbers, kColumns - indent.size() - out.size() - 1, indent);
  else if (!numbers.empty())
    out += ' ' + join(numbers, '\n' + indent + "    ");
  return out;
}

}  // namespace

std::string Formatter::print(const Directive& d) {
  using enum DirectiveKind;
  const bool ends = d.kind == AttributeEnd || d.kind == TransformEnd || d.kind == ObjectEnd;
  if (ends && depth_ > 0) --depth_;
  const std::string indent(2 * std::min(depth_, kDeepestIndent), ' ');
  if (d.kind == AttributeBegin || d.kind == TransformBegin || d.kind == ObjectBegin) ++depth_;

  std::string out = indent + head(d, indent);
  const std::string next = indent + "    ";
  std::vector<std::string> parameters;
  std::size_t length = out.size();
  bool oneLine = true;
  for (const Param& p : d.params) {
    const std::string& text = parameters.emplace_back(parameterText(d.kind, p, next));
    length += 1 + text.size();
    oneLine = oneLine && text.find('\n') == text.npos;
  }
  const std::string between = oneLine && length <= kColumns ? " " : '\n' + next;
  for (const std::string& text : parameters) (out += between) += text;
  return out += '\n';
}

}  // namespace pbrt
