#include "frame_files.h"

#include <fmt/format.h>

#include <bit>

#include "core/base/error.h"
#include "core/base/replacement.h"

namespace fs = std::filesystem;

namespace pbrt {

FrameFiles::FrameFiles(const std::string& pattern, int first, int last) : pattern_(pattern) {
  const auto refuse = [&](std::string_view reason) {
    throw Error(fmt::format("--out {}: {}", shown(pattern), reason), Failure::usage);
  };
  const std::size_t runs = numberRuns(pattern);
  if (runs > numberRuns(fs::path(pattern).filename().string()) || runs > 1)
    refuse("only one run of # in the file's name stands for the number of the frame");
  if (runs == 0 && first != last)
    refuse("several frames need a name with # for their numbers, such as frames/####.png");
  suffix_ = fs::path(pattern).extension().string();
  for (char& c : suffix_)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (suffix_ != ".png" && suffix_ != ".exr" && suffix_ != ".ply")
    refuse("the name must end in .png or .exr (pictures) or in .ply (surfels)");
  if (ofSurfels())
    checkReplaceable(file(first));
  else
    checkWritable(file(first));
}

void writePly(const fs::path& file, std::span<const surfels::Surfel> surfels) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment surfels of pbrt-particles\nelement vertex "
      "{}\n",
      surfels.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "radius", "density"})
    bytes += fmt::format("property float {}\n", name);
  bytes += "end_header\n";
  bytes.reserve(bytes.size() + 32 * surfels.size());
  for (const surfels::Surfel& s : surfels)
    for (const double value : {s.p.x, s.p.y, s.p.z, double{s.n.x}, double{s.n.y}, double{s.n.z},
                               double{s.radius}, double{s.density}}) {
      const auto word = std::bit_cast<std::uint32_t>(static_cast<float>(value));
      for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(word >> shift & 0xffU);
    }
  writeFile(file, bytes);
}

}  // namespace pbrt
