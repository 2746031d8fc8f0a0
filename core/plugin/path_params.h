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
    constexpr std::string_view kStrategies[] = {"uniform", "power", "spatial"};
    const std::string name =
        p.choice("lightsamplestrategy", kStrategies, "spatial",
                 "a light's chance to be sampled: equal, by its power, or by what it may send to "
                 "the point");
    strategy = name == "uniform" ? LightStrategy::uniform
               : name == "power" ? LightStrategy::power
                                 : LightStrategy::spatial;
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
  LightStrategy strategy = LightStrategy::spatial;
};

}  // namespace pbrt
