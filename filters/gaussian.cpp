// A Gaussian, lowered so that it reaches zero where the filter ends.

#include "core/plugin/plugin.h"

namespace pbrt {

class GaussianFilter final : public Filter {
 public:
  explicit GaussianFilter(Params& p)
      : Filter({p.positive("xwidth", 2, "half its width", "pixels"),
                p.positive("ywidth", 2, "half its height", "pixels")}),
        alpha_(p.positive("alpha", 2, "how fast it falls", "1 / pixels^2")) {
    if (!(evaluate(Vec2(0)) > 0)) p.fail("alpha", "is too small: the filter is zero everywhere");
  }

  float evaluate(Vec2 p) const override {
    return static_cast<float>(axis(p.x, radius().x) * axis(p.y, radius().y));
  }

 private:
  // exp(-a x^2) - exp(-a r^2), without the cancellation when a is small.
  double axis(double x, double r) const {
    if (!(std::abs(x) < r)) return 0;
    return -std::exp(-alpha_ * x * x) * std::expm1(-alpha_ * (r * r - x * x));
  }

  double alpha_;
};

}  // namespace pbrt

PBRT_PLUGIN(Filter, pbrt::GaussianFilter, "gaussian",
            "a bell-shaped weight: soft, and free of ripples")
