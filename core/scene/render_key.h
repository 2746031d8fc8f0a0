#pragma once
// What tells whether two renders are parts of one.

#include <cstdint>
#include <string>

namespace pbrt {

// All that a picture's samples depend on, but which pixels and samples they are. Renders of equal
// keys may be continued and merged.
struct RenderKey {
  std::uint64_t scene = 0;     // hash of every file that was read to build it, byte by byte
  std::uint64_t programs = 0;  // hash of the core library and of the plug-ins that were opened
  std::uint64_t seed = 0;
  int samplesPerPixel = 1;  // as the sampler spreads them
  std::string settings;     // the rest, in words: dialect, size, what is stored beside the picture

  bool operator==(const RenderKey&) const = default;
};

// In what the second differs, for people ("it is of another seed: 3, not 0"); empty: in nothing.
std::string difference(const RenderKey& wanted, const RenderKey& found);

}  // namespace pbrt
