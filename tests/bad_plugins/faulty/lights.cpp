// Shines along +z; fails by the x of the lit point.

#include "fault.h"

namespace pbrt {

class FaultyLight final : public Light {
 public:
  explicit FaultyLight(Params& p) : fault_(p) {}
  double power(double) const override { return 1; }
  LightBounds bounds() const override { return {{}, 1}; }
  LightSample sample(const Point3& p, Point2) const override {
    return {.L = Spectrum(fault_.number(p.x)), .wi = {0, 0, -1}, .finite = false, .pdf = 1};
  }

 private:
  Fault fault_;
};

}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::FaultyLight, "faulty", "a light that fails")
