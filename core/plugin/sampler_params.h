#pragma once
// Parameters that several samplers read.

#include <array>

#include "core/base/sobol.h"
#include "core/plugin/plugin.h"

namespace pbrt {

inline int sampleCount(Params& p, const Sampler::Setup& setup, int fallback) {
  const int scene =
      p.integer("pixelsamples", fallback, 1, std::numeric_limits<int>::max(), "samples per pixel");
  return setup.samplesPerPixel.value_or(scene);
}

// The seed of the render, mixed with that of the scene: renders with several seeds differ whatever
// the scene says.
inline std::uint64_t samplerSeed(Params& p, const Sampler::Setup& setup) {
  constexpr int least = std::numeric_limits<int>::min(), most = std::numeric_limits<int>::max();
  const int own = p.integer("seed", 0, least, most, "another one gives other noise");
  return own == 0 ? setup.seed : hash(setup.seed, own);
}

inline Randomization randomization(Params& p) {
  constexpr std::array<std::string_view, 4> names = {"none", "permutedigits", "fastowen", "owen"};
  const std::string how = p.choice("randomization", names, "owen",
                                   "how each coordinate is randomised; fastowen is owen");
  if (how == "none") return Randomization::none;
  return how == "permutedigits" ? Randomization::permuteDigits : Randomization::owen;
}

}  // namespace pbrt
