#pragma once
// A scene on its way to pictures: passes, checkpoints, interruptions.

#include <functional>
#include <string>
#include <vector>

#include "core/scene/film_file.h"
#include "core/scene/render.h"
#include "core/scene/scene.h"
#include "options.h"
#include "progress.h"
#include "signals.h"

namespace pbrt {

class RenderJob {
 public:
  // All outlive it. `key` is that of the scene if films are written.
  RenderJob(const Options& o, Scene& scene, RenderKey key, std::vector<std::string> outputs,
            RenderControl& control, Signals& signals);

  // Goes on from the checkpoint if there is one. Throws Error if it is of another render.
  void resume();
  // Renders until the goal is reached, or a signal asks it to end; returns whether the first. What
  // should be saved now and then is.
  bool run();
  // Saves the checkpoint, then pictures and films, of the samples that there are; returns whether
  // it did so: what has the name of a frame of an animation is whole, or not written. If one cannot
  // be written the others are. Throws Error.
  bool finish();

  // Says where it ended before its goal was reached, and how to go on.
  std::string interruption() const;
  // That each pixel has at least.
  std::uint32_t samples() const { return least() - goal_.firstSample; }

 private:
  bool renderPass(const Passes::Pass& pass, Progress& progress);
  void saveCheckpoint();
  void adviseToResume() const;
  void writeOutputs() const;
  void writeSoFar() const;
  void tryTo(const std::function<void()>& write) const;
  FilmInfo info() const;
  bool mayWrite() const;
  bool saves() const { return !o_.checkpoint.empty(); }
  std::string progress() const;                           // "12 to 64 of 64 samples per pixel"
  std::uint64_t samplesSince(std::uint32_t first) const;  // of all pixels together
  std::uint32_t least() const;  // one past the last sample that all tiles have, and
  std::uint32_t most() const;   // that any has
  double seconds() const;       // of rendering, all runs together

  const Options& o_;
  Scene& scene_;
  Goal goal_;
  RenderKey key_;
  std::vector<std::string> outputs_;
  RenderControl& control_;
  Signals& signals_;
  double start_;               // as now() has it, earlier by what earlier runs took
  double due_;                 // when the next checkpoint is
  bool whole_ = false;         // the goal is reached
  std::uint32_t passEnd_ = 0;  // see FilmInfo
};

}  // namespace pbrt
