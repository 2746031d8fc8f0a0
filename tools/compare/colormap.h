#pragma once
// Errors as colours.

#include <vector>

#include "core/base/image.h"

namespace pbrt {

// A picture of values in scanline order, width x height of them: linear R, G and B which a screen
// shows in the colours of "magma", from black (0 and below) to pale yellow (1 and above, and what
// is not a number). Throws Error, Failure::usage, if there are none, or not that many.
Image heatMap(const std::vector<float>& values, int width, int height);

}  // namespace pbrt
