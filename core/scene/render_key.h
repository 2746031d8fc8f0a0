#pragma once
// What tells whether two renders are parts of one.

#include <cstdint>
#include <string>

namespace pbrt {

enum class Dialect : std::uint8_t;
class PluginLoader;
class Scene;

// All that a picture's samples depend on, but which pixels and samples they are. Renders of equal
// keys may be continued and merged.
struct RenderKey {
  std::uint64_t scene = 0;  // hash of every file that was read to build it, byte by byte
  // Hash of the files of the core library and of the plug-ins that were opened: a build that comes
  // out different is another program, since it may round differently.
  std::uint64_t programs = 0;
  std::uint64_t seed = 0;
  int samplesPerPixel = 1;  // as the sampler spreads them
  // The rest, in words: "pbrt-v3, 640 x 480 pixels, stored: variance normal, permissive".
  std::string settings;

  bool operator==(const RenderKey&) const = default;
};

// That of a scene which was just built by these plug-ins. `files`: the FileDigest from the first
// byte that was parsed to here. Which window of the picture the scene's film has does not count.
// Throws Error, Failure::io.
RenderKey renderKey(const Scene& scene, Dialect dialect, bool permissive,
                    const PluginLoader& plugins, std::uint64_t files);

// All in which the second differs, for people ("it has another seed: 3, not 0"); empty: nothing.
std::string difference(const RenderKey& wanted, const RenderKey& found);

// The widest vectors of this processor: "sse", "avx", "avx2" or "avx512". Embree chooses its code
// by them, and with it rounds the meetings of rays with edges one way or the other.
std::string instructionSet();

}  // namespace pbrt
