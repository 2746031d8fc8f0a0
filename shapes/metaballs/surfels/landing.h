#pragma once
// Brings points onto the surface.

#include "shapes/metaballs/surfels/moving_field.h"

namespace pbrt::surfels {

// As near to zero as f is brought: what the field is asked to be right to (see MovingField::at).
inline constexpr double kOnSurface = 1e-4;

// A point on its way to the surface, and what is known where it gets there.
struct Landing {
  DPoint3 p{};
  DVec3 flow{}, gradient{};
  double value = 0;
  bool there = false;  // |f| <= kOnSurface, the gradient is not zero, all is finite
};

// Each point moves by a bounded number of steps of at most half the field's grain. Those that do
// not get to the surface are left not `there`. Thread-safe, does not allocate.
void land(const MovingField& field, std::span<Landing> points);

}  // namespace pbrt::surfels
