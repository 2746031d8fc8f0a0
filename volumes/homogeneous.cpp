#include "core/plugin/medium_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Homogeneous final : public Medium {
 public:
  Homogeneous(Params& p, const Setup& setup) : Homogeneous(p, setup, readMedium(p), readPlace(p)) {}

 private:
  Homogeneous(Params& p, const Setup& setup, const MediumParams& medium, const MediumBox& box)
      : Medium(setup, medium.g, box.lo, box.hi), point_(medium.unit) {
    point_.emission *= p.nonNegative("Lescale", 1, "multiplies Le");
    setCells({1, 1, 1}, {{point_.extinction(), true}}, !isBlack(point_.emission));
  }

  static MediumBox readPlace(Params& p) {
    constexpr double kEverywhere = std::numeric_limits<double>::infinity();
    const bool bounded = p.available("p0") || p.available("p1") || p.describing();
    return bounded ? readMediumBox(p) : MediumBox{DPoint3(-kEverywhere), DPoint3(kEverywhere)};
  }

  MediumPoint properties(const DPoint3& /*p*/) const override { return point_; }

  MediumPoint point_;
};

}  // namespace pbrt

PBRT_PLUGIN(Medium, pbrt::Homogeneous, "homogeneous",
            "a medium that is the same everywhere or, with p0 or p1, all over a box")
