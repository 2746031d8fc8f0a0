#pragma once
// Fluids that move, frame by frame: what surfels follow.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/bounds.h"
#include "shapes/metaballs/field.h"

namespace pbrt::motion {

// A fluid at one moment; lengths in scene units.
struct Fluid {
  metaballs::Kernel kernel = metaballs::Kernel::poly6;
  std::vector<metaballs::Atom> atoms;
  std::vector<Vec3> velocities;  // one for each atom, per second
};

// The number of a frame is below this.
inline constexpr int kMostFrames = 1'000'000'000;

class Motion {
 public:
  virtual ~Motion() = default;
  // The frames that there are.
  virtual int first() const { return 1; }
  virtual int last() const { return kMostFrames - 1; }
  // Throws Error, Failure::io, if one of these frames is not there.
  virtual void require(int /*first*/, int /*last*/) const {}
  // The files that frames come from, if they do.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
  // Seconds from one frame to the next.
  virtual double dt() const = 0;
  // Holds nearly all of the fluid, at all times: what a camera should see.
  virtual Bounds3 bounds() const = 0;
  // Sets `out`, whose memory is used again, to frame `number`. Cheap if numbers rise by one; any
  // order will do, and a number always gives the same bits. Atoms keep their order, unless they
  // come and go. Throws Error if there is no such frame.
  virtual void frame(int number, Fluid& out) = 0;
};

// The names of those that are built in.
const std::vector<std::string>& motionNames();
// A built-in one: of `atoms` atoms, 100 to a million, and `fps` frames a second, above 0. Its y
// axis points up; it is about 1 wide. Throws Error, Failure::usage.
std::unique_ptr<Motion> makeMotion(const std::string& name, int atoms = 1500, double fps = 60);

// Throws Error, Failure::usage, if there cannot be so many frames a second.
void checkFrameRate(double fps);

}  // namespace pbrt::motion
