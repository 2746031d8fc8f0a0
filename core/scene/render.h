#pragma once
// The loop over tiles that all sampling integrators share: the only user of oneTBB.

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/api/integrator.h"
#include "core/scene/faults.h"
#include "core/scene/film.h"

namespace pbrt {

// What to render, and how far it has come. Another thread may read the counters and set `stop`.
struct RenderControl {
  std::uint32_t firstSample = 0;  // of each pixel
  std::uint32_t endSample = 1;    // one past the last
  int threads = 0;                // 0: all that the process may use
  // How many samples share a pixel once it is whole: textures are filtered the finer, the more.
  std::uint32_t samplesPerPixel = 0;  // 0: those of the sampler

  // One past the last sample that each tile of the film has; the render keeps it. A render that was
  // stopped goes on from there, with this or another control. Empty: each has those before
  // firstSample.
  std::vector<std::uint32_t> reached;
  // Whether the integrator has prepared itself for this scene: the first render with this control
  // does, those that go on need not.
  bool prepared = false;

  // Ends the render once each tile in progress has one sample more for all of its pixels; while the
  // integrator prepares itself, nobody looks.
  std::atomic<bool> stop{false};
  // Of all renders with this control: samples of pixels, and rays.
  std::atomic<std::uint64_t> samplesDone{0};
  std::atomic<std::uint64_t> rays{0};
  FaultLog faults;      // samples that failed: they count as black
  bool strict = false;  // whether the first of them ends the render, which then throws
};

}  // namespace pbrt
