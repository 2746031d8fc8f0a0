#pragma once
// The numbered files that frames are written to.

#include <filesystem>

#include "core/base/image.h"
#include "core/base/numbered_name.h"
#include "shapes/metaballs/surfels/simulation.h"

namespace pbrt {

// Names such as "frames/####.png": the run of # stands for the frame's number, of at least so many
// digits.
class FrameFiles {
 public:
  // Throws Error: Failure::usage if there is not one run of # in the name, though there are several
  // frames, or if the suffix is none of .png, .exr and .ply; Failure::io if the first of the frames
  // could not be written.
  FrameFiles(const std::string& pattern, int first, int last);

  std::filesystem::path file(int number) const { return numbered(pattern_, number); }
  // Surfels (.ply), not pictures.
  bool ofSurfels() const { return suffix_ == ".ply"; }
  // Pictures with all channels (.exr), not colours alone.
  bool ofChannels() const { return suffix_ == ".exr"; }

 private:
  std::string pattern_, suffix_;
};

// Writes a binary PLY file with a vertex for each surfel: x, y, z, nx, ny, nz, radius and density,
// all float. Throws Error, Failure::io.
void writePly(const std::filesystem::path& file, std::span<const surfels::Surfel> surfels);

}  // namespace pbrt
