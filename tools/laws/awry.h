#pragma once
// A place for what should move with its space.

#include "core/base/transform.h"

namespace pbrt::laws {

// Rigid, about an axis that no default direction is likely to have: one that lies along it would
// not show that it does not turn.
inline Transform awry() {
  return Transform::translate({0.7, -1.1, 0.4}) * Transform::rotate(70, {5, -3, 2});
}

}  // namespace pbrt::laws
