#pragma once
// Signals and a timer that stop a render, so that what it has can be saved.

#include <atomic>

namespace pbrt {

// While it lives, SIGUSR1 sets a flag that ends the render (RenderControl::stop), and so do, once
// catchInterruptions() is called, SIGTERM, SIGHUP and the first SIGINT: the second ends the
// process. Those interruptions that were ignored stay so. Afterwards they are as before, but
// SIGUSR1 never ends the process again. One at a time.
class Signals {
 public:
  // `stop` outlives it.
  explicit Signals(std::atomic<bool>& stop);
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  void catchInterruptions();
  // Sets the flag after some seconds, too. An earlier timer is forgotten; infinity: there is none.
  void setTimer(double seconds);

  // Whether SIGUSR1 came since the last call.
  static bool takeRequest();
  // Whether the process was asked to end, since the last of these objects was made.
  static bool interrupted();
};

}  // namespace pbrt
