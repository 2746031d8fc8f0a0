#include "core/base/words.h"

#include <fast_float/fast_float.h>

#include <cmath>

namespace pbrt {

std::vector<Location> wordsOf(const Source& source) {
  constexpr std::string_view kSpace = " \t\r\n\v\f";
  const std::string& text = source.text;
  std::vector<Location> words;
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while ((at = text.find_first_not_of(kSpace, at)) != text.npos) {
    if (text[at] == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    const std::size_t end =
        std::min(text.find_first_of(std::string(kSpace) + '#', at), text.size());
    words.push_back({&source, at, end - at});
    at = end;
  }
  return words;
}

std::optional<double> numberOf(const Location& word) {
  const char* begin = word.source->text.data() + word.begin;
  const char* end = begin + word.length;
  double value = 0;
  const auto [next, error] = fast_float::from_chars(begin, end, value);
  if (error != std::errc() || next != end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace pbrt
