// Direct lighting by multiple importance sampling, with perfect reflection and refraction.

#include "core/api/direct.h"
#include "core/api/integrator.h"
#include "core/api/light_choice.h"
#include "core/api/specular.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

class DirectLighting final : public SamplingIntegrator {
 public:
  static constexpr std::uint8_t kSampledLobes = kAllLobes & ~kSpecular;
  static constexpr int kMostSamples = 64;  // of one light at one point, at a time
  static constexpr std::string_view kStrategies[] = {"all", "one", "weighted"};

  explicit DirectLighting(Params& p)
      : maxDepth_(p.integer("maxdepth", 5, 0, 1000, "longest chain of mirrors and glass")) {
    const std::string strategy =
        p.choice("strategy", kStrategies, "all",
                 "sample all lights, or one: each as often, or weighted by what it may send to the "
                 "point");
    all_ = strategy == "all";
    choice_ = strategy == "one" ? LightStrategy::uniform : LightStrategy::spatial;
  }

  bool mayChooseBy(LightStrategy s) const override { return !all_ && s == choice_; }
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
    if (bsdf.has(kDiffuse | kGlossy) && !world.lights().empty()) {
      if (all_) {
        for (const Light* light : world.lights())
          L += fromLight(world, *light, light->samples(), at, bsdf, sampler);
      } else {
        LightChoice choice(world, choice_);
        choice.moveTo(at, bsdf);
        const auto chosen = choice.choose({sampler.get1D(), 0});
        L += fromLight(world, chosen.light, 1, at, bsdf, sampler) / chosen.chance;
      }
    }
    if (depth + 1 < maxDepth_)
      L += specularLight(world, ray, at, bsdf, sampler,
                         [&](const RayDifferential& next, const Hit& nextHit) {
                           return Li(world, next, nextHit, sampler, scratch, depth + 1);
                         });
    return L;
  }

  // n samples of one light by its own strategy. Those by the BSDF's find the highlights of glossy
  // surfaces, and are as many there; a diffuse surface has no highlights, and only near a large
  // light is its strategy the better one: a quarter is enough.
  static Spectrum fromLight(const World& world, const Light& light, int n,
                            const SurfaceInteraction& at, const Bsdf& bsdf, Sampler& sampler) {
    std::array<Point2, kMostSamples> points;
    Spectrum sum(0);
    for (int done = 0; done < n; done += kMostSamples) {
      const auto now = static_cast<std::size_t>(std::min(n - done, kMostSamples));
      const std::size_t byBsdfNow = light.isDelta() ? 0 : (bsdf.has(kGlossy) ? now : (now + 3) / 4);
      const std::span<Point2> u(points.data(), now);
      sampler.get2D(u);
      sum += static_cast<float>(now) * byLight(world, light, at, bsdf, u, byBsdfNow);
      if (byBsdfNow == 0) continue;
      sampler.get2D(u.first(byBsdfNow));
      sum += static_cast<float>(now) * byBsdf(world, light, at, bsdf, u.first(byBsdfNow), now);
    }
    return sum / static_cast<float>(n);
  }

  // The mean over the points, each weighted against `others` samples of the other strategy.
  static Spectrum byLight(const World& world, const Light& light, const SurfaceInteraction& at,
                          const Bsdf& bsdf, std::span<const Point2> points, std::size_t others) {
    ShadowedSum direct(world);
    for (const Point2& u : points) {
      const LightSample s = light.sample(at.p, u);
      const Spectrum L = unshadowed(at, bsdf, s, static_cast<float>(points.size()),
                                    static_cast<float>(others), kSampledLobes);
      if (!isBlack(L)) direct.add(shadowRay(at, s), L);
    }
    return direct.sum() / static_cast<float>(points.size());
  }

  static Spectrum byBsdf(const World& world, const Light& light, const SurfaceInteraction& at,
                         const Bsdf& bsdf, std::span<const Point2> points, std::size_t others) {
    Spectrum sum(0);
    for (const Point2& u : points) {
      const auto s = bsdf.sample(at.wo, u, kSampledLobes);
      if (!s || isBlack(s->f)) continue;
      if (!light.isInfinite() && !light.mayHit(at.p, s->wi)) continue;
      const RayDifferential ray(spawnRay(at, s->wi));
      const Hit hit = world.intersect(ray);
      Spectrum L(0);
      float lightPdf = 0;
      if (hit.found()) {
        const SurfaceInteraction on = world.surface(ray, hit);
        if (on.light != &light) continue;
        L = light.emitted(on.p, on.n, on.wo);
        lightPdf = light.pdf(at.p, on);
      } else if (light.isInfinite()) {
        L = light.escaped(s->wi);
        lightPdf = light.pdfEscaped(s->wi);
      }
      if (!isBlack(L))
        sum += s->f * dimmed(L, world, ray, hit.t) *
               (std::abs(glm::dot(s->wi, at.ns)) *
                powerHeuristic(static_cast<float>(points.size()), s->pdf,
                               static_cast<float>(others), lightPdf) /
                s->pdf);
    }
    return sum / static_cast<float>(points.size());
  }

  int maxDepth_;
  bool all_ = true;  // all lights; or one, chosen by:
  LightStrategy choice_ = LightStrategy::spatial;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::DirectLighting, "directlighting",
            "light straight from the lamps, mirror images and refraction, with little noise")
