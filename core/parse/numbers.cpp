#include "core/parse/numbers.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace pbrt {
namespace {

constexpr bool isSpace(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}
constexpr bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// Where a conversion ended: at a space or the end if the number is good.
struct Converted {
  const char* next;
  const char* problem = nullptr;
};

// from_chars knows no plus, but infinities and NaNs, which are no numbers of a scene.
const char* numberBegin(const char* p, const char* end) {
  if (p != end && *p == '+') {
    ++p;
    return p != end && (isDigit(*p) || *p == '.') ? p : nullptr;
  }
  const char* first = p + (p != end && *p == '-');
  return first != end && (isDigit(*first) || *first == '.') ? p : nullptr;
}

template <class T>
Converted convert(const char* p, const char* end, T& value) {
  p = numberBegin(p, end);
  if (!p) return {nullptr, "is not a number"};
  const auto [next, error] = fast_float::from_chars(p, end, value);
  if (error == std::errc::invalid_argument || (next != end && !isSpace(*next)))
    return {nullptr, "is not a number"};
  if (std::isinf(value))
    return {nullptr, std::is_same_v<T, float> ? "is out of range of a float" : "is out of range"};
  return {next};
}

Converted convert(const char* p, const char* end, int& value) {
  const char* begin = numberBegin(p, end);
  if (!begin) return {nullptr, "is not a number"};
  const auto [next, error] = std::from_chars(begin, end, value);
  if (error == std::errc() && (next == end || isSpace(*next))) return {next};
  // Written with a point or an exponent; double holds every int exactly.
  double real = 0;
  const Converted converted = convert(p, end, real);
  if (converted.problem) return converted;
  if (real != std::floor(real)) return {nullptr, "is not an integer"};
  if (std::abs(real) > 0x7fffffff && real != -0x1p31)
    return {nullptr, "is out of range of an integer"};
  value = static_cast<int>(real);
  return converted;
}

// How many numbers there are if all of the text is like its beginning, and an eighth more: a vector
// that grows copies everything, while memory that is never touched costs nothing.
std::size_t estimate(std::string_view text) {
  constexpr std::size_t kSample = 4096;
  const std::string_view sample = text.substr(0, kSample);
  std::size_t count = 1;
  for (std::size_t i = 1; i < sample.size(); ++i)
    count += isSpace(sample[i - 1]) && !isSpace(sample[i]);
  return text.size() <= kSample ? count : count * text.size() / kSample * 9 / 8;
}

[[noreturn]] void fail(const Location& where, const char* p, const char* end, const char* problem) {
  constexpr std::ptrdiff_t kLongest = 40;
  const char* last = std::find_if(p, end, isSpace);
  const Location number{where.source, static_cast<std::size_t>(p - where.source->text.data()),
                        static_cast<std::size_t>(last - p)};
  const bool cut = last - p > kLongest;
  const std::string_view shown(p, cut ? kLongest : last - p);
  throw Error(number, fmt::format("{}{} {}", shown, cut ? "..." : "", problem));
}

}  // namespace

template <class T>
void readNumbers(const Location& where, std::vector<T>& numbers) {
  const char* p = where.source->text.data() + where.begin;
  const char* const end = p + where.length;
  if (numbers.empty()) numbers.reserve(estimate({p, where.length}));
  while (true) {
    while (p != end && isSpace(*p)) ++p;
    if (p == end) return;
    T value{};
    const Converted converted = convert(p, end, value);
    if (converted.problem) fail(where, p, end, converted.problem);
    numbers.push_back(value);
    p = converted.next;
  }
}

template void readNumbers(const Location&, std::vector<float>&);
template void readNumbers(const Location&, std::vector<double>&);
template void readNumbers(const Location&, std::vector<int>&);

}  // namespace pbrt
