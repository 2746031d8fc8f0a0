// Whitted 1980: light straight from the lights, and perfect reflection and refraction.

#include "core/api/direct.h"
#include "core/api/integrator.h"
#include "core/api/specular.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

class Whitted final : public SamplingIntegrator {
 public:
  explicit Whitted(Params& p)
      : maxDepth_(p.integer("maxdepth", 5, 0, 1000, "longest chain of mirrors and glass")) {}

  bool mayChooseBy(LightStrategy) const override { return false; }

  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch& scratch) const override {
    return Li(world, ray, hit, sampler, scratch, 0);
  }

 private:
  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch& scratch, int depth) const {
    if (!hit.found()) return world.escaped(glm::normalize(ray.d));
    SurfaceInteraction at = world.surface(ray, hit);
    const Bsdf bsdf = world.bsdf(at, scratch);

    Spectrum L = at.light ? at.light->emitted(at.p, at.n, at.wo) : Spectrum(0);
    if (bsdf.has(kDiffuse | kGlossy)) {
      // One sample of each light: L += f Li |cos theta| / pdf.
      ShadowedSum direct(world);
      for (const Light* light : world.lights()) {
        const LightSample s = light->sample(at.p, sampler.get2D());
        const Spectrum unblocked = unshadowed(at, bsdf, s, 1, 0, kAllLobes);
        if (!isBlack(unblocked)) direct.add(shadowRay(at, s), unblocked);
      }
      L += direct.sum();
    }
    if (depth + 1 < maxDepth_)
      L += specularLight(world, ray, at, bsdf, sampler,
                         [&](const RayDifferential& next, const Hit& nextHit) {
                           return Li(world, next, nextHit, sampler, scratch, depth + 1);
                         });
    return L;
  }

  int maxDepth_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::Whitted, "whitted",
            "light straight from the lamps, mirror images and refraction (Whitted 1980)")
