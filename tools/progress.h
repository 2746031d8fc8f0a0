#pragma once
// Tells the user how far a render has come.

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "core/scene/render.h"

namespace pbrt {

// Reports on standard error from construction to destruction: on a terminal one bar that is
// redrawn, elsewhere a line now and then.
class Progress {
 public:
  Progress(const RenderControl& control, int tiles);
  ~Progress();
  // A pass over all tiles begins, which takes the render from one part of 1 to another. `error`:
  // the estimate so far, if there is one.
  void begin(double from, double to, std::optional<double> error);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  void run();
  void show(double seconds, bool last);

  const RenderControl& control_;
  int tiles_;
  int tilesBefore_ = 0;  // of earlier passes
  double from_ = 0, to_ = 1;
  std::optional<double> error_;
  bool terminal_;
  int linesShown_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace pbrt
