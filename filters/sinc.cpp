// The ideal low-pass filter times Lanczos' window. As in pbrt-v3, tau is the pixel count to the
// window's first zero, and the filter ends at its width, whichever comes first.

#include "core/plugin/plugin.h"

namespace pbrt {

class SincFilter final : public Filter {
 public:
  explicit SincFilter(Params& p)
      : Filter({p.positive("xwidth", 4, "half its width", "pixels"),
                p.positive("ywidth", 4, "half its height", "pixels")}),
        tau_(p.positive("tau", 3, "where the window has its first zero", "pixels")) {}

  float evaluate(Vec2 p) const override {
    return windowed(p.x, radius().x) * windowed(p.y, radius().y);
  }

 private:
  float windowed(float x, float r) const {
    x = std::abs(x);
    return x <= r ? sinc(x) * sinc(x / tau_) : 0;
  }
  // sin(pi x) / (pi x); below 1e-4 it is 1 to float precision.
  static float sinc(float x) { return x < 1e-4F ? 1 : std::sin(kPi * x) / (kPi * x); }

  float tau_;
};

}  // namespace pbrt

PBRT_PLUGIN(Filter, pbrt::SincFilter, "sinc",
            "keeps all detail that pixels can show, at the cost of ripples along edges")
