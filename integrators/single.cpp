#include "core/api/direct.h"
#include "core/api/phase.h"
#include "core/api/ray_march.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Single final : public RayMarch {
 public:
  Single(Params& p, const Setup& setup)
      : RayMarch(setup,
                 p.positive("stepsize", 1, "how finely volumes are looked at", "scene units")) {}

 private:
  Spectrum gained(const World& world, const DPoint3& p, const Ray& ray, Point2 u) const override {
    const std::span<const Light* const> lights = world.lights();
    Spectrum L(0);
    LightSample light;
    if (!lights.empty()) {
      const auto n = static_cast<float>(lights.size());
      const auto i = std::min(static_cast<std::size_t>(u.x * n), lights.size() - 1);
      u.x = std::min(u.x * n - static_cast<float>(i), kOneMinusEpsilon);
      light = lights[i]->sample(Point3(p), u);
      if (light.pdf > 0) light.L *= n / light.pdf;
    }
    SurfaceInteraction at;
    at.p = Point3(p);
    at.wo = -glm::normalize(ray.d);
    at.time = ray.time;
    Spectrum scattered(0);
    for (const Medium* region : world.regions()) {
      const MediumPoint m = region->at(p);
      L += m.emission;
      if (light.pdf > 0 && !isBlack(m.scattering))
        scattered += m.scattering * Phase(region->g())(at.wo, light.wi);
    }
    if (isBlack(scattered * light.L)) return L;
    const Ray shadow = shadowRay(at, light);
    if (world.occluded(shadow)) return L;
    return L + scattered * light.L * transmittance(world, shadow, shadow.tMax);
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::Single, "single",
            "for VolumeIntegrator: volumes glow, dim what is behind them, and scatter light once")
