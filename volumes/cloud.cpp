#include "core/base/noise.h"
#include "core/plugin/medium_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The cloud of pbrt-v4: noise at five scales, looked up at points that finer noise has moved, thick
// below and thin above. Its box is thought to be the unit cube.
class Cloud final : public Medium {
 public:
  Cloud(Params& p, const Setup& setup) : Cloud(p, setup, readMedium(p), readMediumBox(p)) {}

 private:
  Cloud(Params& p, const Setup& setup, const MediumParams& medium, const MediumBox& box)
      : Medium(setup, medium.g, box.lo, box.hi),
        unit_(medium.unit),
        density_(p.nonNegative("density", 1, "how thick the cloud is; no part is denser than 1")),
        wispiness_(p.nonNegative("wispiness", 1, "how much finer noise moves it")),
        frequency_(p.positive("frequency", 5, "of the noise")) {
    setCells({1, 1, 1}, {{unit_.extinction(), false}}, !isBlack(unit_.emission));
  }

  // By differences, as the noise has no derivative at hand.
  static DVec3 noiseGradient(const DPoint3& p) {
    constexpr double kDelta = 0.01;
    DVec3 gradient;
    for (int i = 0; i < 3; ++i) {
      DPoint3 q = p;
      q[i] += kDelta;
      gradient[i] = (noise(q) - noise(p)) / kDelta;
    }
    return gradient;
  }

  float density(const DPoint3& p) const {
    DPoint3 q = double{frequency_} * p;
    double strength = 0.05 * wispiness_, fineness = 10;
    for (int i = 0; i < 2 && wispiness_ > 0; ++i, strength *= 0.5, fineness *= 1.99)
      q += strength * noiseGradient(fineness * q);
    double d = 0;
    strength = 0.5;
    fineness = 1;
    for (int i = 0; i < 5; ++i, strength *= 0.5, fineness *= 1.99)
      d += strength * noise(fineness * q);
    d = std::clamp((1 - p.y) * 4.5 * density_ * d, 0.0, 1.0);
    return static_cast<float>(std::clamp(d + 2 * std::max(0.0, 0.5 - p.y), 0.0, 1.0));
  }

  MediumPoint properties(const DPoint3& p) const override { return unit_ * density(p); }

  MediumPoint unit_;
  float density_, wispiness_, frequency_;
};

}  // namespace pbrt

PBRT_PLUGIN(Medium, pbrt::Cloud, "cloud", "a cloud of noise, as in pbrt-v4")
