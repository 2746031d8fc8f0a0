#pragma once
// Names of files that are numbered, such as "frames/####.exr".

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pbrt {

// How many runs of # there are: each stands for the number.
std::size_t numberRuns(std::string_view pattern);

// The name with this number, of as many digits as a run is long, or more if it needs them: "a##b"
// with 7 is "a07b". Without a # it is the pattern itself.
std::string numbered(std::string_view pattern, int number);

// The number, 0 or above, with which a pattern of one run gives this name. Empty: with none.
std::optional<int> numberIn(std::string_view pattern, std::string_view name);

}  // namespace pbrt
