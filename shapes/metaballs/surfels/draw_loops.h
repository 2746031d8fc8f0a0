#pragma once
// The inner loops of drawing: compiled for several instruction sets, all of which give the same
// bits (see shapes/metaballs/loops.h).

#include <span>

#include "core/base/math.h"
#include "shapes/metaballs/lanes.h"

namespace pbrt::surfels {

using metaballs::Floats;
using metaballs::kLanes;
using Numbers __attribute__((vector_size(kLanes * sizeof(std::uint32_t)))) = std::uint32_t;
// Without wide registers the compiler aligns vectors less than the loops for wide ones expect.
inline constexpr std::size_t kAligned = sizeof(Floats);

// Holds some rays: their origins lie in a ball, their unit directions within an angle of an axis.
struct Bound {
  Point3 centre{};
  float radius = -kInfinity;  // less than any: no ray is in it
  Vec3 axis{};
  float cosine = 0, sine = 0;  // of the angle; both and the axis 0: any direction
  float spread = 2;            // a unit direction less the axis is no longer than that
};

// Eight balls that hold discs. Where a surface in one faces, n, changes by no more than `turn`.
struct alignas(kAligned) Balls {
  Floats x{}, y{}, z{}, radius = Floats{} - kInfinity;  // less than any: nothing is in it
  Floats nx{}, ny{}, nz{}, turn{};
};

// A surfel as it is drawn: the part within a radius of p of the surface on which
// F(x) = n . u + u^T B u / 2 is zero, u = x - p. The gradient of F is n + B u, which is where the
// surface faces: to second order it is the surface about p.
struct Disc {
  Point3 p{};
  Normal3 n{};
  float bend[6] = {};  // B: xx, yy, zz, xy, xz, yz
  float rim2 = 0;      // rays meet the disc within the square root of that
  float inverse2 = 0;  // radius^-2
};

// Eight rays of unit direction.
struct alignas(kAligned) Rays {
  Floats ox{}, oy{}, oz{}, dx{}, dy{}, dz{};
  Floats tMin{}, tMax = Floats{} - kInfinity;  // less than tMin: not a ray
};

// What eight rays see. t is infinite where they see nothing.
struct alignas(kAligned) Seen {
  Floats t, nx, ny, nz;  // n is not a unit vector
  Numbers surfel;
};

struct DrawLoops {
  // Writes the places in `balls` of those that rays of the bound may meet from the front, in
  // ascending order, and says how many they are. At most all are written to `out`.
  std::size_t (*narrow)(const Bound& bound, std::span<const Balls> balls, std::uint32_t* out);
  // What the rays see of the discs that are listed. At most all of the list are written to `near`.
  void (*look)(const Rays& rays, const Disc* discs, std::span<const std::uint32_t> list,
               std::uint32_t* near, Seen& seen);
};

// Those that this machine supports: the portable ones first, the best last.
std::span<const DrawLoops* const> allDrawLoops();

}  // namespace pbrt::surfels
