// Path tracing (Kajiya 1986). At every vertex one light is sampled, and one direction by the BSDF,
// along which the path goes on. Light that both may find is weighted between them.

#include "core/api/direct.h"
#include "core/api/integrator.h"
#include "core/api/met_light.h"
#include "core/api/specular.h"
#include "core/plugin/path_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

class Path final : public SamplingIntegrator {
 public:
  explicit Path(Params& p) : params_(p) {}
  bool mayChooseBy(LightStrategy s) const override { return s == params_.strategy; }

  Spectrum Li(const World& world, const RayDifferential& cameraRay, const Hit& firstHit,
              Sampler& sampler, Scratch& scratch) const override {
    RayDifferential ray = cameraRay;
    Hit hit = firstHit;
    MetLight met(world, params_.strategy);
    LightChoice& choice = met.choice;
    Spectrum L(0), throughput(1);
    float density = 1;  // of radiance by refraction, which is no loss: it is undone on the way out

    for (int bounce = 0;; ++bounce) {
      if (!hit.found()) {
        met.addEscaped(world, ray, throughput, L);
        return L;
      }
      SurfaceInteraction at = world.surface(ray, hit);
      met.addEmitted(at, throughput, L);
      if (bounce == params_.maxDepth) return L;

      // Every vertex takes the same dimensions, whatever it is made of.
      const Point2 uLight = sampler.get2D(), uBsdf = sampler.get2D();
      const Bsdf bsdf = world.bsdf(at, scratch);
      if (!choice.empty() && bsdf.has(kDiffuse | kGlossy)) {
        choice.moveTo(at, bsdf);
        L += throughput * direct(world, at, bsdf, choice.choose(uLight));
      }

      const auto s = bsdf.sample(at.wo, uBsdf);
      if (!s) return L;
      throughput *= s->f * (std::abs(glm::dot(s->wi, at.ns)) / s->pdf);
      density *= sqr(s->eta);
      if (bounce >= PathParams::kRouletteFrom &&
          !params_.survives(throughput, density, sampler.get1D()))
        return L;
      if (!(largest(throughput) > 0)) return L;
      if (bounce + 1 == params_.maxDepth && !mayEndAtLight(world, at.p, s->wi)) return L;
      const bool specular = s->flags & kSpecular;
      met.pdf = specular ? 0 : s->pdf;
      ray = specular ? specularRay(at, ray, *s) : RayDifferential(spawnRay(at, s->wi));
      hit = world.intersect(ray);
      throughput = dimmed(throughput, world, ray, hit.t);
    }
  }

 private:
  static float largest(const Spectrum& s) { return std::max({s.x, s.y, s.z}); }

  static Spectrum direct(const World& world, const SurfaceInteraction& at, const Bsdf& bsdf,
                         const LightChoice::Chosen& chosen) {
    const LightSample s = chosen.light.sample(at.p, chosen.u);
    const float others = chosen.light.isDelta() ? 0 : 1;
    const Spectrum L = unshadowed(at, bsdf, s, chosen.chance, others, kAllLobes);
    if (isBlack(L)) return Spectrum(0);
    const Ray ray = shadowRay(at, s);
    if (world.occluded(ray)) return Spectrum(0);
    return dimmed(L / chosen.chance, world, ray, ray.tMax);
  }

  PathParams params_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::Path, "path",
            "all light, however often it bounces, by random paths from the camera")
