#include "cameras/realistic/lens_file.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/file.h"

namespace pbrt {

namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";
constexpr std::size_t kLargest = std::size_t{1} << 20U;  // bytes
constexpr double kLongest = 1e6;                         // mm

struct Number {
  double value = 0;
  Location where;
};

Number numberAt(const Source& source, std::size_t begin, std::size_t end) {
  Number n{0, {&source, begin, end - begin}};
  const char* last = source.text.data() + end;
  const auto [next, error] = fast_float::from_chars(source.text.data() + begin, last, n.value);
  if (error != std::errc() || next != last || !(std::abs(n.value) <= kLongest))
    throw Error(n.where,
                "expected a number of a lens: rows of radius, thickness, index and diameter");
  return n;
}

std::vector<Number> numbersOf(const Source& source) {
  const std::string& text = source.text;
  std::vector<Number> numbers;
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while ((at = text.find_first_not_of(kSpace, at)) != text.npos) {
    if (text[at] == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    const std::size_t end =
        std::min(text.find_first_of(std::string(kSpace) + '#', at), text.size());
    numbers.push_back(numberAt(source, at, end));
    at = end;
  }
  return numbers;
}

}  // namespace

std::vector<LensRow> readLensFile(const std::filesystem::path& path) {
  const Source source{path.string(), readFile(path, FileKind::regular, kLargest)};
  const std::vector<Number> numbers = numbersOf(source);
  if (numbers.empty()) throw Error(Location{&source, 0, 1}, "the file describes no lens");
  if (numbers.size() % 4 != 0)
    throw Error(numbers.back().where,
                fmt::format("a lens has rows of 4 numbers; {} are left", numbers.size() % 4));
  std::vector<LensRow> rows;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    const Number &radius = numbers[i], &thickness = numbers[i + 1], &index = numbers[i + 2],
                 &diameter = numbers[i + 3];
    if (!(thickness.value >= 0)) throw Error(thickness.where, "a thickness must not be below 0");
    if (index.value != 0 && !(index.value >= 1 && index.value <= 10))
      throw Error(index.where, "an index of refraction must be from 1 to 10, or 0 for air");
    if (!(diameter.value > 0)) throw Error(diameter.where, "a diameter must be above 0");
    rows.push_back(
        {radius.value, thickness.value, index.value == 0 ? 1 : index.value, diameter.value});
  }
  if (rows.back().index != 1)
    throw Error(numbers[numbers.size() - 2].where,
                "behind its last surface a lens must end in air, of index 1");
  return rows;
}

}  // namespace pbrt
