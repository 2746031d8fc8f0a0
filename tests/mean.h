#pragma once
// Estimates with their variance, for tests.

#include "tools/laws/mean.h"

namespace pbrt::test {

using laws::Mean;

}  // namespace pbrt::test
