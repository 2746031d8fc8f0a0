// Path tracing (Kajiya 1986). At every vertex one light is sampled, and one direction by the BSDF,
// along which the path goes on. Light that both may find is weighted between them.

#include "core/api/direct.h"
#include "core/api/integrator.h"
#include "core/api/specular.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

// From which light a point takes its one sample. Probing, a light's chance goes by what it would
// send to the point if nothing were in between, as a few fixed samples of it say. They may be wrong
// (all face away, but some of the light does not), so a share of the choices is uniform: no light
// is left out, and none is n / kUniform times too rare (Hesterberg 1995, "Weighted Average
// Importance Sampling and Defensive Mixture Distributions").
class LightChoice {
 public:
  struct Chosen {
    const Light& light;
    float chance;
    Point2 u;  // uniform still, for the light to sample with
  };

  LightChoice(const World& world, bool probes, Scratch& scratch) : lights_(world.lights()) {
    const std::size_t n = probes && lights_.size() > 1 ? lights_.size() : 0;
    if (n > 0)
      probes_ = {static_cast<float*>(scratch.allocate(n * sizeof(float), alignof(float))), n};
  }

  bool empty() const { return lights_.empty(); }
  const Point3& point() const { return p_; }

  // From now on it is about p.
  void moveTo(const Point3& p) {
    p_ = p;
    float sum = 0;
    for (std::size_t i = 0; i < probes_.size(); ++i) sum += probes_[i] = probe(*lights_[i]);
    const auto n = static_cast<float>(lights_.size());
    probed_ = sum > 0 && sum < kInfinity;
    total_ = probed_ ? sum / (1 - kUniform) : n;
    least_ = probed_ ? total_ * kUniform / n : 1;
  }

  // The number u.x chooses the light; what is left of it is uniform again.
  Chosen choose(Point2 u) const {
    const auto weight = [&](std::size_t i) { return (probed_ ? probes_[i] : 0) + least_; };
    std::size_t i = 0;
    float rest = u.x * total_;
    for (; i + 1 < lights_.size() && rest >= weight(i); ++i) rest -= weight(i);
    return {*lights_[i], weight(i) / total_, {std::min(rest / weight(i), kOneMinusEpsilon), u.y}};
  }

  // That of choose() for this light.
  float chance(const Light& light) const {
    return ((probed_ ? probe(light) : 0) + least_) / total_;
  }

 private:
  static constexpr float kUniform = 0.2F;
  // Of lights that have an extent. One does not do: of a closed surface it faces away from half of
  // all points, though the other half of the surface shines on them.
  static constexpr std::array<Point2, 4> kProbes = {
      {{0.125F, 0.375F}, {0.375F, 0.875F}, {0.625F, 0.125F}, {0.875F, 0.625F}}};

  float probe(const Light& light) const {
    float sum = 0;
    for (const Point2& u : std::span(kProbes).first(light.isDelta() ? 1 : kProbes.size())) {
      const LightSample s = light.sample(p_, u);
      if (s.pdf > 0) sum += luminance(s.L) / s.pdf;
    }
    return light.isDelta() ? sum : sum / kProbes.size();
  }

  std::span<const Light* const> lights_;
  std::span<float> probes_;  // of the lights at p_; none: all have the same chance
  Point3 p_{};
  bool probed_ = false;
  float total_ = 0;  // of all weights, which are the probes, each raised by:
  float least_ = 0;
};

class Path final : public SamplingIntegrator {
 public:
  static constexpr std::string_view kStrategies[] = {"uniform", "spatial", "power"};

  explicit Path(Params& p)
      : maxDepth_(p.integer("maxdepth", 5, 0, 1'000'000, "most times that light is scattered")),
        rrThreshold_(p.nonNegative("rrthreshold", 1,
                                   "paths that carry less of their light than this may be ended "
                                   "at random; 0: none is")) {
    const std::string strategy =
        p.choice("lightsamplestrategy", kStrategies, "uniform",
                 "a light's chance to be sampled: equal, or by what it would send to the point");
    // pbrt-v3 has "spatial" as default, by tables made beforehand. Probing instead costs more than
    // it gains unless lights differ much.
    probes_ = strategy != "uniform";
    if (strategy == "power")
      p.warn("lightsamplestrategy", "lights do not tell their power: read as \"spatial\"");
  }

  Spectrum Li(const World& world, const RayDifferential& cameraRay, const Hit& firstHit,
              Sampler& sampler, Scratch& scratch) const override {
    RayDifferential ray = cameraRay;
    Hit hit = firstHit;
    LightChoice choice(world, probes_, scratch);
    Spectrum L(0), throughput(1);
    float density = 1;  // of radiance by refraction, which is no loss: it is undone on the way out
    float pdf = 0;      // of the ray's direction; 0: no light could have been sampled instead

    // The weight of light that the ray meets, where sampling the light itself has density lightPdf.
    const auto weight = [&](const Light& light, float lightPdf) {
      return powerHeuristic(1, pdf, choice.chance(light), lightPdf);
    };

    for (int bounce = 0;; ++bounce) {
      if (!hit.found()) {
        const Vec3 w = glm::normalize(ray.d);
        for (const Light* light : world.infiniteLights())
          L += throughput * light->escaped(w) *
               (pdf == 0 ? 1 : weight(*light, light->pdfEscaped(w)));
        return L;
      }
      SurfaceInteraction at = world.surface(ray, hit);
      if (at.light) {
        const Spectrum emitted = at.light->emitted(at.p, at.n, at.wo);
        if (!isBlack(emitted))
          L += throughput * emitted *
               (pdf == 0 ? 1 : weight(*at.light, at.light->pdf(choice.point(), at)));
      }
      if (bounce == maxDepth_) return L;

      // Every vertex takes the same dimensions, whatever it is made of.
      const Point2 uLight = sampler.get2D(), uBsdf = sampler.get2D();
      const Bsdf bsdf = world.bsdf(at, scratch);
      if (!choice.empty() && bsdf.has(kDiffuse | kGlossy)) {
        choice.moveTo(at.p);
        L += throughput * direct(world, at, bsdf, choice.choose(uLight));
      }

      const auto s = bsdf.sample(at.wo, uBsdf);
      if (!s) return L;
      throughput *= s->f * (std::abs(glm::dot(s->wi, at.ns)) / s->pdf);
      density *= sqr(s->eta);
      if (bounce >= kRouletteFrom && !survives(throughput, density, sampler.get1D())) return L;
      if (!(largest(throughput) > 0)) return L;
      if (bounce + 1 == maxDepth_ && !mayEndAtLight(world, at.p, s->wi)) return L;
      const bool specular = s->flags & kSpecular;
      pdf = specular ? 0 : s->pdf;
      ray = specular ? specularRay(at, ray, *s) : RayDifferential(spawnRay(at, s->wi));
      hit = world.intersect(ray);
    }
  }

 private:
  static constexpr int kRouletteFrom = 4;  // bounce

  static float largest(const Spectrum& s) { return std::max({s.x, s.y, s.z}); }

  static Spectrum direct(const World& world, const SurfaceInteraction& at, const Bsdf& bsdf,
                         const LightChoice::Chosen& chosen) {
    const LightSample s = chosen.light.sample(at.p, chosen.u);
    const float others = chosen.light.isDelta() ? 0 : 1;
    const Spectrum L = unshadowed(at, bsdf, s, chosen.chance, others, kAllLobes);
    if (isBlack(L) || world.occluded(shadowRay(at, s))) return Spectrum(0);
    return L / chosen.chance;
  }

  // Whether a ray from p along w may meet any light.
  static bool mayEndAtLight(const World& world, const Point3& p, const Vec3& w) {
    return !world.infiniteLights().empty() ||
           std::ranges::any_of(world.lights(), [&](const Light* l) { return l->mayHit(p, w); });
  }

  // Russian roulette (Arvo and Kirk 1990): a path survives with a chance near the share of light
  // that it carries, and then stands for those that do not.
  bool survives(Spectrum& throughput, float density, float u) const {
    const float carried = largest(throughput) * density;
    if (carried >= rrThreshold_) return true;
    const float chance = std::min(carried, 0.95F);
    throughput /= chance;
    return u < chance;
  }

  int maxDepth_;
  float rrThreshold_;
  bool probes_ = false;  // see LightChoice
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::Path, "path",
            "all light, by paths from the camera with one light sampled at every vertex")
