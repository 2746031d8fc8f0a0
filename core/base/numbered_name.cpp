#include "core/base/numbered_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace pbrt {

namespace {

// The first run of #; at the end of the pattern, and empty, if there is none.
std::string_view firstRun(std::string_view pattern) {
  const std::size_t begin = std::min(pattern.find('#'), pattern.size());
  const std::size_t end = std::min(pattern.find_first_not_of('#', begin), pattern.size());
  return pattern.substr(begin, end - begin);
}

}  // namespace

std::size_t numberRuns(std::string_view pattern) {
  std::size_t runs = 0;
  for (std::string_view run; !(run = firstRun(pattern)).empty(); ++runs)
    pattern = {run.end(), pattern.end()};
  return runs;
}

std::string numbered(std::string_view pattern, int number) {
  std::string name;
  for (std::string_view run; !(run = firstRun(pattern)).empty();) {
    name += std::string_view(pattern.begin(), run.begin());
    name += fmt::format("{:0{}}", number, run.size());
    pattern = {run.end(), pattern.end()};
  }
  return name.append(pattern);
}

std::optional<int> numberIn(std::string_view pattern, std::string_view name) {
  const std::string_view run = firstRun(pattern);
  const auto before = static_cast<std::size_t>(run.begin() - pattern.begin());
  const auto after = static_cast<std::size_t>(pattern.end() - run.end());
  if (name.size() < pattern.size()) return {};
  const char* const end = name.data() + name.size() - after;
  int number = -1;
  const auto [last, error] = std::from_chars(name.data() + before, end, number);
  const bool whole = error == std::errc() && last == end && number >= 0;
  return whole && numbered(pattern, number) == name ? std::optional(number) : std::nullopt;
}

}  // namespace pbrt
