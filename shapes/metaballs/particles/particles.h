#pragma once
// Particles from the files of simulations. docs/scene-format.md says which formats, and what the
// columns of each mean.

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/spectrum.h"

namespace pbrt {

// One list a quantity, each empty or with one value a particle, all finite; lengths in the units
// of the file.
struct Particles {
  std::vector<Point3> positions;  // never empty
  std::vector<float> radii;       // of the particle itself, not of a kernel's support; any sign
  std::vector<Spectrum> colors;   // linear, 0 to 1 unless the file says more
  std::vector<Vec3> velocities;   // as the file has them
  std::vector<float> strengths;
};

// Reads a file by the format that its suffix names (.ply .vtk .csv .xyz .txt .bgeo .bhclassic);
// it may be gzipped, with or without a further suffix .gz. Throws Error: Failure::io if it cannot
// be read, Failure::scene, with the line or the byte, if what it holds is not that format, is not
// finite, or is no particle at all.
Particles readParticles(const std::filesystem::path& file);

// The same for the bytes of a file of this name, which are not unpacked.
Particles readParticles(std::string name, std::string bytes);

}  // namespace pbrt
