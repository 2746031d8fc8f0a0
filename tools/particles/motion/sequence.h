#pragma once
// Frames from the numbered files of a simulation.

#include <optional>

#include "tools/particles/motion/motion.h"

namespace pbrt::motion {

// What the parameters of the shape "metaballs" say, by the same names and with the same defaults;
// for the whole sequence one default, so that a surface does not jump from frame to frame.
struct SequenceSettings {
  double fps = 24;  // frames a second, above 0; velocities of the files are per second
  metaballs::Kernel kernel = metaballs::Kernel::poly6;
  std::optional<float> radius;  // of the atoms' supports
  float radiusScale = 4;        // without `radius`: the support's over the particle's own
  std::optional<float> threshold;
};

// The files of `pattern`, such as "splash/fluid####.ply": the one run of # in its last part stands
// for a number of at least so many digits; any format of readParticles(). Throws Error:
// Failure::usage for what is wrong with the pattern or the settings, Failure::io if there is no
// such file; and what readParticles() throws, also from frame().
std::unique_ptr<Motion> openSequence(const std::string& pattern, const SequenceSettings& settings);

}  // namespace pbrt::motion
