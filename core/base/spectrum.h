#pragma once
// Light is carried as linear RGB with Rec. 709 primaries and the D65 white point.

#include "core/base/math.h"

namespace pbrt {

using Spectrum = glm::vec3;

inline bool isBlack(const Spectrum& s) {
  return s.x == 0 && s.y == 0 && s.z == 0;
}

// Relative luminance Y (ITU-R BT.709-6, item 3.2).
inline float luminance(const Spectrum& s) {
  return 0.2126F * s.x + 0.7152F * s.y + 0.0722F * s.z;
}

}  // namespace pbrt
