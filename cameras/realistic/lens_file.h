#pragma once
// Lenses as their designers write them down.

#include <filesystem>
#include <vector>

namespace pbrt {

// One surface. In millimetres.
struct LensRow {
  double radius = 0;     // of curvature, > 0 if bent towards the scene; 0: flat
  double thickness = 0;  // from its vertex to that of the next
  double index = 1;      // of refraction of what lies behind it
  double diameter = 0;   // of its rim
};

// Reads a text of rows of four numbers, radius, thickness, index (0 means 1) and diameter, from the
// surface that faces the scene to the one that faces the film; # begins a comment. Throws Error
// with the place in that file if it is no such text, is longer than 1 MiB, or a number makes no
// sense; Failure::io if it cannot be read.
std::vector<LensRow> readLensFile(const std::filesystem::path& path);

}  // namespace pbrt
