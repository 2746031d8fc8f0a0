#include "frame_files.h"

#include <fmt/format.h>

#include <bit>

#include "core/base/error.h"
#include "core/base/replacement.h"

namespace fs = std::filesystem;

namespace pbrt {

FrameFiles::FrameFiles(const std::string& pattern, int first, int last) {
  const auto refuse = [&](std::string_view reason) {
    throw Error(fmt::format("--out {}: {}", shown(pattern), reason), Failure::usage);
  };
  const std::size_t begin = std::min(pattern.find('#'), pattern.size());
  const std::size_t end = std::min(pattern.find_first_not_of('#', begin), pattern.size());
  if (pattern.find('#', end) != std::string::npos || pattern.find('/', end) != std::string::npos)
    refuse("only one run of # in the file's name stands for the number of the frame");
  if (begin == end && first != last)
    refuse("several frames need a name with # for their numbers, such as frames/####.png");
  before_ = pattern.substr(0, begin);
  after_ = pattern.substr(end);
  digits_ = end - begin;
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

fs::path FrameFiles::file(int number) const {
  if (digits_ == 0) return before_ + after_;
  return before_ + fmt::format("{:0{}}", number, digits_) + after_;
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
