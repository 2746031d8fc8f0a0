// Implicit surfaces as surface particles: what the camera sees of them are discs, where free
// particles cling to them (van Kooten, van den Bergen and Telea 2007). Shadows fall from, and on,
// the surfaces themselves.

#include <mutex>

#include "core/api/direct.h"
#include "core/plugin/plugin.h"
#include "integrators/surfaceparticles/cover.h"

namespace pbrt {
namespace {

using surfels::Cover;

class SurfaceParticles final : public SamplingIntegrator {
 public:
  explicit SurfaceParticles(Params& p) {
    settings_.particles = p.integer("particles", settings_.particles, 1, 1 << 24,
                                    "on all implicit surfaces together");
    settings_.quality =
        p.nonNegative("quality", settings_.quality,
                      "above 0: instead of \"particles\", as many as lie 3 / quality pixels apart");
    settings_.steps = p.integer("steps", settings_.steps, 1, 100000,
                                "in which the particles spread before the picture is taken");
    shadows_ = p.flag("shadows", true, "whether things are in the way of light");
  }

  bool mayChooseBy(LightStrategy) const override { return false; }

  // Once for all renders: an integrator belongs to one scene.
  void prepare(const World& world, Point2i resolution) const override {
    std::call_once(covered_, [&] { cover_.emplace(world, resolution, settings_); });
  }
  int blockWidth() const override { return 32; }
  void look(const World&, std::span<const Ray* const> rays, int width,
            std::span<Hit> hits) const override {
    cover_->look(rays, width, hits);
  }
  SurfaceInteraction surface(const World&, const RayDifferential& ray,
                             const Hit& hit) const override {
    return cover_->surface(ray, hit);
  }

  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch& scratch) const override {
    if (!hit.found()) return world.escaped(glm::normalize(ray.d));
    SurfaceInteraction at = surface(world, ray, hit);
    const Bsdf bsdf = world.bsdf(at, scratch);
    Spectrum L = at.light ? at.light->emitted(at.p, at.n, at.wo) : Spectrum(0);
    if (!bsdf.has(kDiffuse | kGlossy)) return L;
    if (shadows_) at.error += cover_->depth(hit, at);
    // One sample of each light.
    ShadowedSum direct(world);
    for (const Light* light : world.lights()) {
      const LightSample s = light->sample(at.p, sampler.get2D());
      const Spectrum unblocked = unshadowed(at, bsdf, s, 1, 0, kAllLobes);
      if (isBlack(unblocked)) continue;
      const Ray toLight = shadowRay(at, s);
      if (shadows_)
        direct.add(toLight, unblocked);
      else
        L += dimmed(unblocked, world, toLight, toLight.tMax);
    }
    return L + direct.sum();
  }

 private:
  Cover::Settings settings_;
  bool shadows_ = true;
  mutable std::once_flag covered_;
  mutable std::optional<Cover> cover_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::SurfaceParticles, "surfaceparticles",
            "implicit surfaces as discs where particles cling to them; light straight from the "
            "lamps, no reflections")
