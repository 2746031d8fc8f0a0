#pragma once
// What motions are made of: atoms that fill a drop, and how a drop moves.

#include <span>

#include "core/base/dual.h"
#include "tools/particles/motion/motion.h"

namespace pbrt::motion {

// An atom of a fluid of one atom a cube of the spacing. Its support is two spacings, and one alone
// is a ball of the volume of that cube.
metaballs::Atom fluidAtom(const Point3& p, float spacing);

// `count` points of unit density, in round shells about the origin, so that a drop looks round.
std::vector<DVec3> ball(std::size_t count);
// The radius of so many.
double ballRadius(std::size_t count);

// A time in seconds, or what depends on it and its derivative.
using Varying = Dual<double, 1>;
inline Varying at(double seconds) {
  return {seconds, {1}};
}

// The point x of a drop is at centre + axes x, where axes[i] is what becomes of axis i.
struct Pose {
  std::array<Varying, 3> centre{};
  std::array<std::array<Varying, 3>, 3> axes{};
};

// Adds the drop to the fluid.
void place(std::span<const DVec3> drop, const Pose& pose, float spacing, Fluid& out);

// A motion that goes on for ever. Throws Error at frames before the first.
class Endless : public Motion {
 public:
  explicit Endless(double fps) : dt_(1 / fps) {}
  double dt() const final { return dt_; }
  void frame(int number, Fluid& out) final;

 private:
  // Sets the atoms and velocities of `out`, which is empty, to frame 1 + `step`.
  virtual void frameAfter(int step, Fluid& out) = 0;

  double dt_;
};

std::unique_ptr<Motion> makeDam(int atoms, double fps);
std::unique_ptr<Motion> makeSplit(int atoms, double fps);
std::unique_ptr<Motion> makeRing(int atoms, double fps);

}  // namespace pbrt::motion
