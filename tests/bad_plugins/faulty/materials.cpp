// A grey surface; fails by the x of the point. All of its lobes are the core's own.

#include "core/api/lobes.h"
#include "fault.h"

namespace pbrt {

class FaultyMaterial final : public Material {
 public:
  explicit FaultyMaterial(Params& p) : fault_(p) {}
  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    bsdf.add(place<Lambertian>(scratch, Spectrum(0.5F * fault_.number(at.p.x))));
  }

 private:
  Fault fault_;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::FaultyMaterial, "faulty", "a surface that fails")
