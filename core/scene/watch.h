#pragma once
// Who gave what is not a number, or infinite.

#include <functional>
#include <memory>

#include "core/api/integrator.h"
#include "core/plugin/culprit.h"

namespace pbrt {

// Stand-ins for a world, its parts and an integrator, which pass every call on and look at what
// comes back: the first value that is not a number, or infinite, names the plug-in that gave it. A
// sample depends on nothing but its pixel and its number, so whoever takes it once more meets the
// same values. Slow, and for one thread.
class Watch {
 public:
  // All must outlive it.
  Watch(const SamplingIntegrator& integrator, const World& world, const Sampler& sampler);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  const SamplingIntegrator& integrator() const;
  const World& world() const;
  const Sampler& sampler() const;

  // Takes the sample by the stand-ins. Null: nothing was found, as where hits of a block of rays
  // differ from those of one ray in their last digits.
  const PluginCode* culprit(const std::function<void()>& take);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pbrt
