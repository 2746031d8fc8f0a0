#pragma once
// The parameters that path tracers share.

#include "core/api/light_choice.h"
#include "core/plugin/params.h"

namespace pbrt {

struct PathParams {
  explicit PathParams(Params& p)
      : maxDepth(p.integer("maxdepth", 5, 0, 1'000'000, "most times that light is scattered")),
        rrThreshold(p.nonNegative("rrthreshold", 1,
                                  "paths that carry less of their light than this may be ended "
                                  "at random; 0: none is")) {
    constexpr std::string_view kStrategies[] = {"uniform", "spatial", "power"};
    const std::string strategy =
        p.choice("lightsamplestrategy", kStrategies, "uniform",
                 "a light's chance to be sampled: equal, or by what it would send to the point");
    // pbrt-v3 has "spatial" as default, by tables made beforehand. Probing instead costs more than
    // it gains unless lights differ much.
    probes = strategy != "uniform";
    if (strategy == "power")
      p.warn("lightsamplestrategy", "lights do not tell their power: read as \"spatial\"");
  }

  // Russian roulette (Arvo and Kirk 1990): a path survives with a chance near the share of light
  // that it carries, and then stands for those that do not. `density` undoes that of radiance by
  // refraction, which is no loss.
  bool survives(Spectrum& throughput, float density, float u) const {
    const float carried = std::max({throughput.x, throughput.y, throughput.z}) * density;
    if (carried >= rrThreshold) return true;
    const float chance = std::min(carried, 0.95F);
    throughput /= chance;
    return u < chance;
  }

  static constexpr int kRouletteFrom = 4;  // bounce

  int maxDepth;
  float rrThreshold;
  bool probes = false;  // see LightChoice
};

}  // namespace pbrt
