#include "core/api/ray_march.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Emission final : public RayMarch {
 public:
  Emission(Params& p, const Setup& setup)
      : RayMarch(setup,
                 p.positive("stepsize", 1, "how finely volumes are looked at", "scene units")) {}

 private:
  Spectrum gained(const World& world, const DPoint3& p, const Ray& /*ray*/,
                  Point2 /*u*/) const override {
    Spectrum emission(0);
    for (const Medium* region : world.regions()) emission += region->at(p).emission;
    return emission;
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::Emission, "emission",
            "for VolumeIntegrator: volumes glow, and dim what is behind them")
