// Path tracing through media. Along each ray it is found out whether a medium scatters it before it
// meets a surface; whatever scatters it, one light is sampled there, and one direction, along which
// the path goes on. Light that both may find is weighted between them. What media leave of the
// light on the way is either part of that chance, or estimated for shadow rays: neither depends on
// how the direction was chosen, so the weights are those of directions.

#include <bit>

#include "core/api/direct.h"
#include "core/api/integrator.h"
#include "core/api/met_light.h"
#include "core/api/phase.h"
#include "core/api/specular.h"
#include "core/api/tracking.h"
#include "core/plugin/path_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

// The media of a world as one path sees them. In a world without any it costs nothing, and takes no
// random numbers.
class Media {
 public:
  // `ray`: the path's first.
  Media(const World& world, const Ray& ray, Sampler& sampler, Scratch& scratch)
      : world_(world),
        any_(world.cameraMedium() || world.bordersMedia() || !world.regions().empty()),
        around_(world.cameraMedium()),
        walk_({}) {
    if (!any_) return;
    const std::size_t n = world.regions().size() + 1;
    auto* room =
        static_cast<MediumWalk*>(scratch.allocate(n * sizeof(MediumWalk), alignof(MediumWalk)));
    std::uninitialized_default_construct_n(room, n);
    walk_ = MediaWalk({room, n});
    // A sampler without jitter gives all pixels the same.
    const Point2 seed = sampler.get2D();
    rng_ = Rng(hash(std::bit_cast<std::uint32_t>(seed.x), std::bit_cast<std::uint32_t>(seed.y),
                    hashOf(ray)));
  }

  bool any() const { return any_; }
  // It leaves a surface in direction w.
  void leave(const SurfaceInteraction& at, const Vec3& w) { around_ = beyond(at, w); }
  const Medium* beyond(const SurfaceInteraction& at, const Vec3& w) const {
    return at.media ? at.media->towards(w, at.n) : around_;
  }

  // See collide().
  std::optional<Collision> collide(const Ray& ray, float tEnd, float u, Spectrum& throughput,
                                   Spectrum& L) {
    start(around_, ray, tEnd);
    return pbrt::collide(walk_, u, rng_, throughput, L);
  }
  Point3 point(const Collision& c) const { return Point3(walk_.point(c.t)); }

  // Of light that comes along a shadow ray that nothing blocks and that starts in `medium`.
  Spectrum transmittance(Ray ray, const Medium* medium) {
    if (!any_) return Spectrum(1);
    const bool finite = ray.tMax < kInfinity;
    const Point3 end = ray.o + ray.d;
    Spectrum T(1);
    for (;;) {
      const Hit hit = world_.bordersMedia() ? world_.intersect(ray) : Hit();
      start(medium, ray, std::min(hit.t, ray.tMax));
      T *= estimateTransmittance(walk_, rng_);
      if (!hit.found() || isBlack(T)) return T;
      const SurfaceInteraction at = world_.surface(RayDifferential(ray), hit);
      if (at.media) medium = at.media->towards(ray.d, at.n);
      const float tMax = ray.tMax;
      ray = spawnRay(at, ray.d);
      if (finite) {
        ray.d = end - ray.o;
        ray.tMax = tMax;
      }
    }
  }

 private:
  void start(const Medium* medium, const Ray& ray, float tEnd) {
    const DVec3 d(ray.d);
    const double length = glm::length(d);
    if (!(length > 0)) return walk_.start(nullptr, {}, {}, {}, {});
    walk_.start(medium, world_.regions(), DPoint3(ray.o), d / length,
                {ray.tMin * length, tEnd * length});
  }

  const World& world_;
  bool any_;
  const Medium* around_;  // beside regions
  MediaWalk walk_;
  Rng rng_;
};

class VolPath final : public SamplingIntegrator {
 public:
  explicit VolPath(Params& p) : params_(p) {}
  bool tracesMedia() const override { return true; }
  bool mayChooseBy(LightStrategy s) const override { return s == params_.strategy; }

  Spectrum Li(const World& world, const RayDifferential& cameraRay, const Hit& firstHit,
              Sampler& sampler, Scratch& scratch) const override {
    RayDifferential ray = cameraRay;
    Hit hit = firstHit;
    Media media(world, ray, sampler, scratch);
    MetLight met(world, params_.strategy);
    LightChoice& choice = met.choice;
    Spectrum L(0), throughput(1);
    float density = 1;  // of radiance by refraction, which is no loss: it is undone on the way out

    for (int bounce = 0;;) {
      std::optional<Collision> collision;
      if (media.any()) {
        collision = media.collide(ray, hit.t, sampler.get1D(), throughput, L);
        if (isBlack(throughput)) return L;
      }
      SurfaceInteraction at;
      if (collision) {
        at.p = media.point(*collision);
        at.wo = -glm::normalize(ray.d);
        at.time = ray.time;
      } else {
        if (!hit.found()) {
          met.addEscaped(world, ray, throughput, L);
          return L;
        }
        at = world.surface(ray, hit);
        met.addEmitted(at, throughput, L);
        if (!at.material) {
          media.leave(at, ray.d);
          static_cast<Ray&>(ray) = spawnRay(at, ray.d);
          hit = world.intersect(ray);
          continue;
        }
      }
      if (bounce == params_.maxDepth) return L;

      // Every vertex takes the same dimensions, whatever it is made of.
      const Point2 uLight = sampler.get2D(), uScatter = sampler.get2D();
      Vec3 wi;
      bool specular = false;
      BsdfSample scattered;
      if (collision) {
        const Phase phase(collision->g);
        if (!choice.empty()) {
          choice.moveTo(at.p);
          const auto chosen = choice.choose(uLight);
          const LightSample s = chosen.light.sample(at.p, chosen.u);
          if (s.pdf > 0 && !isBlack(s.L)) {
            const float f = phase(at.wo, s.wi);
            const float w = chosen.light.isDelta() ? 1 : powerHeuristic(chosen.chance, s.pdf, 1, f);
            L += throughput * fromLight(world, media, at, s, s.L * (f * w / s.pdf), chosen.chance);
          }
        }
        const PhaseSample s = phase.sample(at.wo, uScatter);
        wi = s.wi;
        met.pdf = s.pdf;
      } else {
        const Bsdf bsdf = world.bsdf(at, scratch);
        if (!choice.empty() && bsdf.has(kDiffuse | kGlossy)) {
          choice.moveTo(at, bsdf);
          const auto chosen = choice.choose(uLight);
          const LightSample s = chosen.light.sample(at.p, chosen.u);
          const float others = chosen.light.isDelta() ? 0 : 1;
          L += throughput * fromLight(world, media, at, s,
                                      unshadowed(at, bsdf, s, chosen.chance, others, kAllLobes),
                                      chosen.chance);
        }
        const auto s = bsdf.sample(at.wo, uScatter);
        if (!s) return L;
        throughput *= s->f * (std::abs(glm::dot(s->wi, at.ns)) / s->pdf);
        density *= sqr(s->eta);
        scattered = *s;
        wi = s->wi;
        specular = s->flags & kSpecular;
        met.pdf = specular ? 0 : s->pdf;
      }
      if (bounce >= PathParams::kRouletteFrom &&
          !params_.survives(throughput, density, sampler.get1D()))
        return L;
      if (!(std::max({throughput.x, throughput.y, throughput.z}) > 0)) return L;
      ++bounce;
      if (bounce == params_.maxDepth && !media.any() && !mayEndAtLight(world, at.p, wi)) return L;
      ray = specular ? specularRay(at, ray, scattered) : RayDifferential(spawnRay(at, wi));
      if (!collision) media.leave(at, wi);
      hit = world.intersect(ray);
    }
  }

 private:
  // What arrives of `unblocked` from a light that was chosen with a chance.
  static Spectrum fromLight(const World& world, Media& media, const SurfaceInteraction& at,
                            const LightSample& s, const Spectrum& unblocked, float chance) {
    if (isBlack(unblocked)) return Spectrum(0);
    const Ray ray = shadowRay(at, s);
    if (world.occluded(ray)) return Spectrum(0);
    return unblocked / chance * media.transmittance(ray, media.beyond(at, ray.d));
  }

  PathParams params_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::VolPath, "volpath",
            "all light, also that which media scatter, by paths from the camera")
