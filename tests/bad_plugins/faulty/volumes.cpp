// A thin fog everywhere; fails by x.

#include "fault.h"

namespace pbrt {

class FaultyMedium final : public Medium {
 public:
  FaultyMedium(Params& p, const Setup& setup)
      : Medium(setup, 0, DPoint3(-2), DPoint3(2)), fault_(p) {
    setCells({1, 1, 1}, {{Spectrum(1), false}}, true);
  }

 private:
  MediumPoint properties(const DPoint3& p) const override {
    return {Spectrum(0.1F), Spectrum(0), Spectrum(0.1F * fault_.number(p.x))};
  }

  Fault fault_;
};

}  // namespace pbrt

PBRT_PLUGIN(Medium, pbrt::FaultyMedium, "faulty", "a medium that fails")
