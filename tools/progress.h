#pragma once
// Tells the user how far a render has come.

#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/scene/render.h"

namespace pbrt {

// Reports on standard error from construction to destruction: on a terminal one bar that is
// redrawn, elsewhere a line now and then.
class Progress {
 public:
  Progress(const RenderControl& control, int tiles);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  void run();
  void show(double seconds, bool last);

  const RenderControl& control_;
  int tiles_;
  bool terminal_;
  int linesShown_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace pbrt
