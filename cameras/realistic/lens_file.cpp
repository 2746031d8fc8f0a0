#include "cameras/realistic/lens_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/file.h"
#include "core/base/words.h"

namespace pbrt {

namespace {

constexpr std::size_t kLargest = std::size_t{1} << 20U;  // bytes
constexpr double kLongest = 1e6;                         // mm

struct Number {
  double value = 0;
  Location where;
};

std::vector<Number> numbersOf(const Source& source) {
  std::vector<Number> numbers;
  for (const Location& word : wordsOf(source)) {
    const std::optional<double> value = numberOf(word);
    if (!value || std::abs(*value) > kLongest)
      throw Error(word,
                  "expected a number of a lens: rows of radius, thickness, index and diameter");
    numbers.push_back({*value, word});
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
