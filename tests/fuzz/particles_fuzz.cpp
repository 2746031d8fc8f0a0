// Any bytes are a file of particles, or are refused with an Error. The first byte is the format.

#include <cstdint>

#include "core/base/error.h"
#include "shapes/metaballs/particles/particles.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr const char* kNames[] = {"a.ply", "a.vtk", "a.csv", "a.xyz", "a.bgeo"};
  if (size == 0) return 0;
  try {
    pbrt::readParticles(kNames[data[0] % std::size(kNames)], {data + 1, data + size});
  } catch (const pbrt::Error&) {
  }
  return 0;
}
