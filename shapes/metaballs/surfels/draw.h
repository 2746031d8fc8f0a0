#pragma once
// Draws discs: what each of many rays sees of them.

#include <vector>

#include "core/base/ray.h"
#include "shapes/metaballs/surfels/simulation.h"

namespace pbrt::surfels {

// The rays of a few neighbouring pixels, w wide and h high, row by row; any camera's. Good for as
// many frames as they stay.
class Beam;

// What a ray sees of the discs: the blend of those that are about as near as the nearest.
struct Fragment {
  float t = kInfinity;       // along the ray, in its own parameter; infinite: no disc is met
  Normal3 n{};               // unit, outward
  std::uint32_t surfel = 0;  // the one that counts most
};

// The discs of a frame, made ready to be drawn. Const and thread-safe after construction.
class Discs {
 public:
  // `origin`: where the rays' space has its origin; places are in floats from there.
  Discs(std::span<const Surfel> surfels, const DPoint3& origin);

  // What each ray of the beam sees, between its tMin and tMax. Discs that are seen from behind are
  // not there. out: one for each ray.
  void draw(const Beam& beam, std::span<Fragment> out) const;
};

}  // namespace pbrt::surfels
