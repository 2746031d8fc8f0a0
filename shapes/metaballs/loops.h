#pragma once
// The inner loops: compiled for several instruction sets, of which the best that this machine has
// is chosen when the program runs. All of them give the same bits.

#include <optional>

#include "core/base/ray.h"
#include "shapes/metaballs/field.h"

namespace pbrt::metaballs {

// Code compiled for wide registers relies on their alignment, and code compiled for narrow ones,
// which makes these objects, would not see to it by itself.
inline constexpr std::size_t kLaneAlignment = sizeof(Floats);

// Eight boxes, one a lane.
struct alignas(kLaneAlignment) Eight {
  Floats centre[3], half[3];
};

// a + b.x + g |x|^2 in eight lanes, x from a box's centre.
struct alignas(kLaneAlignment) Paraboloid {
  Floats a{}, b[3] = {}, g{};
};

// Bounds of f over eight boxes: below - slack <= f <= above + slack.
struct alignas(kLaneAlignment) EightBounds {
  Paraboloid below, above;
  Floats slack{};          // of rounding
  unsigned undecided = 0;  // boxes in which f may be zero
};

// Work done: looks at the field along a piece of the ray, in float and in double.
struct Effort {
  std::uint64_t floats = 0, doubles = 0;
};

// See roots.h.
struct RayQuery {
  const ObjectRay* ray = nullptr;
  DPoint3 lo{}, hi{};     // the part of space in question
  Point3 near{};          // a point of it
  bool any = false;       // any crossing will do
  double acceptable = 0;  // how well a crossing is to be known, as a length
  Effort* effort = nullptr;
};

struct Loops {
  FieldSample (*sample)(Kernel, std::span<const Atom>, const DPoint3&, AtomList);
  // Whether all boxes are proven inside; for atoms that do not carve.
  bool (*allInside)(Kernel, std::span<const Atom>, AtomList, const Eight&);
  // masks[i], one for each atom of the list, gets the boxes that it reaches. `tight`: better bounds
  // outside and across the surface, at twice the price.
  void (*bounds)(Kernel, std::span<const Atom>, AtomList, const Eight&, bool tight,
                 std::uint8_t* masks, EightBounds& bounds);
  std::optional<double> (*find)(Kernel, std::span<const Atom>, AtomList, const RayQuery&);
};

// Those that this machine supports: the portable ones first, the best last.
std::span<const Loops* const> allLoops();
// The best.
const Loops& loops();

}  // namespace pbrt::metaballs
