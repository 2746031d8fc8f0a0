// Piecewise cubics in the filter's two parameters (Mitchell and Netravali 1988, "Reconstruction
// Filters in Computer Graphics", equation 8); the pieces are scaled from [-2, 2] to the width.

#include "core/plugin/plugin.h"

namespace pbrt {

class MitchellFilter final : public Filter {
 public:
  explicit MitchellFilter(Params& p)
      : Filter({p.positive("xwidth", 2, "half its width", "pixels"),
                p.positive("ywidth", 2, "half its height", "pixels")}),
        b_(p.inRange("B", 1.F / 3, -kMost, kMost, "blurs")),
        c_(p.inRange("C", 1.F / 3, -kMost, kMost, "rings; B + 2 C = 1 is best")) {}

  float evaluate(Vec2 p) const override {
    return cubic(2 * p.x / radius().x) * cubic(2 * p.y / radius().y);
  }

 private:
  static constexpr float kMost = 10;  // far beyond sense, far below overflow

  float cubic(float x) const {
    x = std::abs(x);
    if (x < 1)
      return ((12 - 9 * b_ - 6 * c_) * x * x * x + (-18 + 12 * b_ + 6 * c_) * x * x + 6 - 2 * b_) /
             6;
    if (x < 2)
      return ((-b_ - 6 * c_) * x * x * x + (6 * b_ + 30 * c_) * x * x + (-12 * b_ - 48 * c_) * x +
              8 * b_ + 24 * c_) /
             6;
    return 0;
  }

  float b_, c_;
};

}  // namespace pbrt

PBRT_PLUGIN(Filter, pbrt::MitchellFilter, "mitchell",
            "sharper than a bell: cubics that balance blur against ripples along edges")
