#include "scanner.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <charconv>
#include <cstring>

namespace pbrt::files {
namespace {

template <class T>
const char* convertAny(const char* p, const char* end, T& value) {
  if (end - p > 1 && p[0] == '+' && p[1] != '-') ++p;
  const auto [next, error] = fast_float::from_chars(p, end, value);
  return error == std::errc::invalid_argument ? nullptr : next;
}

}  // namespace

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return lower;
}

const char* convert(const char* p, const char* end, double& value) {
  return convertAny(p, end, value);
}
const char* convert(const char* p, const char* end, float& value) {
  return convertAny(p, end, value);
}

bool Scanner::atEnd() {
  while (p_ != end_ && isSpace(*p_)) ++p_;
  return p_ == end_;
}

std::string_view Scanner::word() {
  if (atEnd()) fail({p_, p_}, "the file ends here, too early");
  const char* begin = p_;
  while (p_ != end_ && !isSpace(*p_)) ++p_;
  return {begin, p_};
}

double Scanner::number() {
  if (atEnd()) word();
  double value = 0;
  const char* next = convert(p_, end_, value);
  if (!next || (next != end_ && !isSpace(*next))) {
    const std::string_view wrong = word();
    fail(wrong, fmt::format("\"{}\" is not a number", wrong.substr(0, 40)));
  }
  p_ = next;
  return value;
}

std::size_t Scanner::count() {
  const std::string_view text = word();
  std::size_t value = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || next != text.data() + text.size())
    fail(text, fmt::format("\"{}\" is not a count", text.substr(0, 40)));
  return value;
}

std::string_view Scanner::line() {
  const char* begin = p_;
  const auto* newline = static_cast<const char*>(std::memchr(p_, '\n', left()));
  p_ = newline ? newline + 1 : end_;
  const char* last = newline ? newline : end_;
  while (last != begin && (last[-1] == ' ' || last[-1] == '\r')) --last;
  return {begin, last};
}

bool Scanner::atLineEnd() {
  while (p_ != end_ && isBlank(*p_)) ++p_;
  return p_ == end_ || *p_ == '\n';
}

void Scanner::endLine() {
  if (!atLineEnd()) fail(word(), "this line should have ended before");
  if (p_ != end_) ++p_;
}

}  // namespace pbrt::files
