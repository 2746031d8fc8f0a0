#pragma once
// Tells the user how far a render has come.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "core/scene/render.h"
#include "passes.h"
#include "progress_state.h"
#include "rate_estimate.h"

namespace pbrt {

// Reports while it lives: a bar or a line now and then on standard error, messages for machines on
// standard output, no more than one a second. A thread of its own does so, which sleeps.
class Progress {
 public:
  // `pixels`: how many samples one sample per pixel is; `firstSample`: that of the whole render, of
  // whose samples so many are there: a render that was resumed does not get the credit for them.
  // `control` must outlive it, and has taken no samples yet.
  Progress(ProgressStyle style, const RenderControl& control, int pixels, std::uint32_t firstSample,
           std::uint64_t samplesThere = 0, std::optional<int> frame = {});
  // Takes a bar away. Says nothing more.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // The pass over the picture that is next.
  void next(const Passes::Pass& pass);
  // Rendering begins, or goes on after a rest.
  void begin();
  // Nothing is rendered until begin(), such as while pictures are written.
  void rest();
  // The estimated error has become known.
  void error(double error);
  // The last report: the render is done, or was interrupted.
  void end(Stage stage);

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  ProgressState look();  // under the lock
  void show(const ProgressState& state);

  const ProgressStyle style_;
  const RenderControl& control_;
  const double pixels_;
  const std::uint32_t firstSample_;
  const double samplesThere_;
  const Clock::time_point start_ = Clock::now();

  std::mutex mutex_;  // of all that follows
  std::condition_variable wake_;
  ProgressState state_;
  Passes::Pass pass_;
  bool begun_ = false, resting_ = true, ended_ = false;
  RateEstimate rate_;
  double nextReport_ = 0;   // seconds since the start
  std::string percentage_;  // as it was reported last
  std::thread thread_;      // last: it uses all the others
};

}  // namespace pbrt
