// Path tracing (Kajiya 1986). At every vertex one light is sampled, and one direction by the BSDF,
// along which the path goes on. Light that both may find is weighted between them.

#include "core/api/direct.h"
#include "core/api/integrator.h"
#include "core/api/specular.h"
#include "core/plugin/path_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

// A path on its way: the ray by which it goes on, and what light along that ray counts.
struct Walk {
  Walk(CameraPath& p, const LightChoice& c) : path(p), ray(*p.ray), hit(p.hit), choice(c) {}

  CameraPath& path;
  RayDifferential ray;
  Hit hit;
  LightChoice choice;
  Spectrum throughput{1};
  float density = 1;  // of radiance by refraction, which is no loss: it is undone on the way out
  float pdf = 0;      // of the ray's direction; 0: no light could have been sampled instead

  // The weight of light that the ray meets, where sampling the light itself has density lightPdf.
  float weight(const Light& light, float lightPdf) const {
    return pdf == 0 ? 1 : powerHeuristic(1, pdf, choice.chance(light), lightPdf);
  }
};

// What each path gets from a light if nothing blocks it.
class ShadowRays {
 public:
  ShadowRays() {}  // NOLINT: see rays_
  void add(const Ray& ray, const Spectrum& contribution, Spectrum& L) {
    rays_[count_] = ray;
    lights_[count_++] = {contribution, &L};
  }
  void trace(const World& world) const {
    const std::uint32_t blocked = world.occluded(std::span(rays_.data(), count_));
    for (std::size_t i = 0; i < count_; ++i)
      if (!(blocked >> i & 1U))
        *lights_[i].L += dimmed(lights_[i].contribution, world, rays_[i], rays_[i].tMax);
  }

 private:
  struct Unblocked {
    Spectrum contribution;
    Spectrum* L;
  };
  std::size_t count_ = 0;
  // Deliberately without initial values.
  union {
    std::array<Ray, World::kBatch> rays_;
  };
  union {
    std::array<Unblocked, World::kBatch> lights_;
  };
};

class Path final : public SamplingIntegrator {
 public:
  explicit Path(Params& p) : params_(p) {}

  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch& scratch) const override {
    CameraPath path{&ray, hit, &sampler};
    Li(world, {&path, 1}, scratch);
    return path.L;
  }

  // All paths take their steps together, so that their shadow rays share packets.
  void Li(const World& world, std::span<CameraPath> paths, Scratch& scratch) const override {
    std::array<Walk*, World::kBatch> walks;
    std::size_t n = 0;
    for (CameraPath& path : paths) {
      void* room = scratch.allocate(sizeof(Walk), alignof(Walk));
      walks[n++] = new (room) Walk(path, LightChoice(world, params_.strategy));
    }
    for (int bounce = 0; n > 0; ++bounce) {
      ShadowRays shadows;
      std::size_t going = 0;
      for (Walk* walk : std::span(walks.data(), n))
        if (scatter(world, *walk, bounce, shadows, scratch)) walks[going++] = walk;
      n = going;
      shadows.trace(world);
      for (Walk* walk : std::span(walks.data(), n)) {
        walk->hit = world.intersect(walk->ray);
        walk->throughput = dimmed(walk->throughput, world, walk->ray, walk->hit.t);
      }
    }
  }

 private:
  // Adds the light of the vertex where the path is. False: it ends there.
  bool scatter(const World& world, Walk& walk, int bounce, ShadowRays& shadows,
               Scratch& scratch) const {
    Spectrum& L = walk.path.L;
    if (!walk.hit.found()) {
      const Vec3 w = glm::normalize(walk.ray.d);
      for (const Light* light : world.infiniteLights())
        L += walk.throughput * light->escaped(w) * walk.weight(*light, light->pdfEscaped(w));
      return false;
    }
    SurfaceInteraction at = world.surface(walk.ray, walk.hit);
    if (at.light) {
      const Spectrum emitted = at.light->emitted(at.p, at.n, at.wo);
      if (!isBlack(emitted))
        L += walk.throughput * emitted *
             walk.weight(*at.light, at.light->pdf(walk.choice.point(), at));
    }
    if (bounce == params_.maxDepth) return false;

    // Every vertex takes the same dimensions, whatever it is made of.
    Sampler& sampler = *walk.path.sampler;
    const Point2 uLight = sampler.get2D(), uBsdf = sampler.get2D();
    const Bsdf bsdf = world.bsdf(at, scratch);
    if (!walk.choice.empty() && bsdf.has(kDiffuse | kGlossy)) {
      walk.choice.moveTo(at, bsdf);
      const auto [light, chance, u] = walk.choice.choose(uLight);
      const LightSample s = light.sample(at.p, u);
      const Spectrum direct =
          unshadowed(at, bsdf, s, chance, light.isDelta() ? 0 : 1, kAllLobes) / chance;
      if (!isBlack(direct)) shadows.add(shadowRay(at, s), walk.throughput * direct, L);
    }

    const auto s = bsdf.sample(at.wo, uBsdf);
    if (!s) return false;
    walk.throughput *= s->f * (std::abs(glm::dot(s->wi, at.ns)) / s->pdf);
    walk.density *= sqr(s->eta);
    if (bounce >= PathParams::kRouletteFrom &&
        !params_.survives(walk.throughput, walk.density, sampler.get1D()))
      return false;
    if (!(std::max({walk.throughput.x, walk.throughput.y, walk.throughput.z}) > 0)) return false;
    if (bounce + 1 == params_.maxDepth && !mayEndAtLight(world, at.p, s->wi)) return false;
    const bool specular = s->flags & kSpecular;
    walk.pdf = specular ? 0 : s->pdf;
    walk.ray = specular ? specularRay(at, walk.ray, *s) : RayDifferential(spawnRay(at, s->wi));
    return true;
  }

  PathParams params_;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Integrator, pbrt::Path, "path",
            "all light, however often it bounces, by random paths from the camera")
