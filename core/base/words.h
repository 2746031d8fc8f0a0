#pragma once
// Files of numbers, with comments from # to the end of the line.

#include <optional>
#include <vector>

#include "core/base/error.h"

namespace pbrt {

// The words of a text outside of comments. They point into the source.
std::vector<Location> wordsOf(const Source& source);

// Empty if the word is not a finite number.
std::optional<double> numberOf(const Location& word);

}  // namespace pbrt
