#pragma once
// Pearson's chi-square test, for tests.

#include "tools/laws/chi_square.h"

namespace pbrt::test {

using laws::chiSquareDeviation;
using laws::uniformDeviation;

}  // namespace pbrt::test
