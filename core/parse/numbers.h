#pragma once
// Text to numbers, the hot part of reading a large scene.

#include <vector>

#include "core/base/error.h"

namespace pbrt {

// Appends the numbers in a place of the text, which holds them and white space alone. T is float,
// double or int; integers may be written as 2.0 or 2e3. What is too small for T is zero. Throws
// Error at the number that is none, is not an integer, or is out of range.
template <class T>
void readNumbers(const Location& where, std::vector<T>& numbers);

}  // namespace pbrt
