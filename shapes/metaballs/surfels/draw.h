#pragma once
// Draws discs: what each of many rays sees of them.

#include <vector>

#include "core/base/ray.h"
#include "shapes/metaballs/surfels/draw_loops.h"
#include "shapes/metaballs/surfels/simulation.h"

namespace pbrt::surfels {

// The rays of a block of neighbouring pixels, any camera's; best some 32 x 32 of them. Good for as
// many frames as they stay.
class Beam {
 public:
  Beam() = default;
  Beam(std::span<const Ray> rays, int width) { set(rays, width); }

  // Row by row, `width` to a row; rays.size() is a multiple of it. A ray whose direction is zero,
  // or of which something is not a number, sees nothing. Asks for memory only as it grows.
  void set(std::span<const Ray> rays, int width);

  std::size_t size() const { return size_; }

 private:
  friend class Discs;
  // 8 x 4 pixels in packets of 4 x 2.
  struct Patch {
    Bound bound;
    Rays rays[4];
    Floats scale[4];                  // from distances to the rays' own parameters
    std::uint32_t pixels[4][kLanes];  // where what they see belongs
  };
  std::size_t size_ = 0;
  Bound bound_;
  std::vector<Patch> patches_;
};

// What a ray sees of the discs: the blend of those about the nearest point.
struct Fragment {
  float t = kInfinity;       // along the ray, in its own parameter; infinite: no disc is met
  Normal3 n{};               // unit, outward
  std::uint32_t surfel = 0;  // the one that counts most
};

// The discs of a frame, made ready to be drawn. Const and thread-safe but for set().
class Discs {
 public:
  Discs() = default;
  Discs(std::span<const Surfel> surfels, const DPoint3& origin) { set(surfels, origin); }

  // `origin`: where the rays' space has its origin; places are in floats from there. What is drawn
  // fast is in an order in which neighbours are near each other, as a Simulation's are. A surfel
  // without a radius, or of which something is not finite, is left out. Uses all threads.
  void set(std::span<const Surfel> surfels, const DPoint3& origin);

  // What each ray of the beam sees, between its tMin and tMax. Surfaces are seen from the front
  // alone: from within, nothing of what is about. out: one for each ray. Rays of other beams, or
  // other threads, may be drawn at the same time.
  void draw(const Beam& beam, std::span<Fragment> out) const;

 private:
  std::vector<Disc> discs_;
  // Balls about the discs, about each 32 of those, and so on until they are few.
  std::vector<std::vector<Balls>> levels_;
};

}  // namespace pbrt::surfels
