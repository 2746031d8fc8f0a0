#pragma once
// The loop over tiles that all sampling integrators share: the only user of oneTBB.

#include <atomic>
#include <cstdint>

#include "core/api/integrator.h"
#include "core/scene/film.h"

namespace pbrt {

// What to render, and how far it has come. Another thread may read the counters and set `stop`.
struct RenderControl {
  std::uint32_t firstSample = 0;  // of each pixel
  std::uint32_t endSample = 1;    // one past the last
  int threads = 0;                // 0: all that the process may use
  // How many samples share a pixel once it is whole: textures are filtered the finer, the more.
  std::uint32_t samplesPerPixel = 0;  // 0: those of the sampler

  std::atomic<bool> stop{false};  // ends the render after the tiles in progress
  std::atomic<int> tilesDone{0};
  std::atomic<std::uint64_t> rays{0};
  std::atomic<std::uint64_t> badSamples{0};  // not a number or infinite; counted as black
};

}  // namespace pbrt
