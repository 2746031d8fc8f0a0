#include "core/scene/watch.h"

#include <map>
#include <optional>

#include "core/scene/scene.h"
#include "core/scene/watched_parts.h"

namespace pbrt {

class WatchedMedium final : public Medium {
 public:
  WatchedMedium(const Medium& medium, Finding& finding)
      : Medium({}, medium.g_, medium.lo_, medium.hi_), medium_(medium), finding_(finding) {
    toMedium_ = medium.toMedium_;
    n_ = medium.n_;
    cells_ = medium.cells_;
  }

 private:
  MediumPoint properties(const DPoint3& p) const override {
    const MediumPoint m = medium_.properties(p);
    finding_.expect(isFinite(m.extinction()) && isFinite(m.emission), pluginOf(medium_));
    return m;
  }

  const Medium& medium_;
  Finding& finding_;
};

namespace {

class WatchedIntegrator final : public SamplingIntegrator {
 public:
  WatchedIntegrator(const SamplingIntegrator& integrator, Finding& finding)
      : integrator_(integrator), finding_(finding) {}
  void look(const World& world, std::span<const Ray* const> rays, int width,
            std::span<Hit> hits) const override {
    integrator_.look(world, rays, width, hits);
    for (const Hit& hit : hits) finding_.expect(!hit.found() || std::isfinite(hit.t), maker());
  }
  SurfaceInteraction surface(const World& world, const RayDifferential& ray,
                             const Hit& hit) const override {
    const SurfaceInteraction s = integrator_.surface(world, ray, hit);
    finding_.expect(allFinite(s), maker());
    return s;
  }
  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch& scratch) const override {
    const Spectrum L = integrator_.Li(world, ray, hit, sampler, scratch);
    finding_.expect(isFinite(L), maker());
    return L;
  }

 private:
  const PluginCode* maker() const { return pluginOf(integrator_); }

  const SamplingIntegrator& integrator_;
  Finding& finding_;
};

class WatchedVolume final : public VolumeIntegrator {
 public:
  WatchedVolume(const VolumeIntegrator& volume, const SamplingIntegrator& inner, Finding& finding)
      : VolumeIntegrator({&inner}), volume_(volume), finding_(finding) {}
  Spectrum through(const World& world, const Ray& ray, const Hit& hit, const Spectrum& L,
                   Sampler& sampler) const override {
    return seen(volume_.through(world, ray, hit, L, sampler));
  }
  Spectrum transmittance(const World& world, const Ray& ray, float t) const override {
    return seen(volume_.transmittance(world, ray, t));
  }

 private:
  Spectrum seen(const Spectrum& s) const {
    finding_.expect(isFinite(s), pluginOf(volume_));
    return s;
  }

  const VolumeIntegrator& volume_;
  Finding& finding_;
};

class WatchedWorld final : public World {
 public:
  WatchedWorld(const World& world, const SamplingIntegrator& integrator,
               const VolumeIntegrator* volume, Finding& finding)
      : World(world),
        world_(world),
        scene_(dynamic_cast<const Scene*>(&world)),
        integrator_(integrator),
        finding_(finding),
        camera_{world.camera(), finding} {
    World::camera_ = &camera_;
    volume_ = volume;
    lights_.clear();
    infiniteLights_.clear();
    for (const Light* light : world.lights()) {
      ownLights_.push_back(std::make_unique<WatchedLight>(*light, finding));
      lights_.push_back(ownLights_.back().get());
    }
    for (const Light* light : world.infiniteLights()) infiniteLights_.push_back(watched(light));
    for (const Medium*& region : regions_) region = watched(region);
    cameraMedium_ = watched(cameraMedium_);
  }

  Hit intersect(const Ray& ray) const override {
    const Ray* one = &ray;
    Hit hit;
    intersect({&one, 1}, {&hit, 1});
    return hit;
  }
  void intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const override {
    for (const Ray* ray : rays) finding_.expect(allFinite(*ray), pluginOf(integrator_));
    world_.intersect(rays, hits);
    for (const Hit& hit : hits)
      finding_.expect(!hit.found() || isFinite(Vec3(hit.t, hit.u, hit.v)), shape(hit));
  }
  bool occluded(const Ray& ray) const override { return world_.occluded(ray); }
  std::uint32_t occluded(std::span<const Ray> rays) const override { return world_.occluded(rays); }
  SurfaceInteraction surface(const RayDifferential& ray, const Hit& hit) const override {
    SurfaceInteraction s = world_.surface(ray, hit);
    finding_.expect(allFinite(s), shape(hit));
    if (s.light) s.light = watched(s.light);
    if (s.media) s.media = watched(s.media);
    return s;
  }
  Bsdf bsdf(SurfaceInteraction& at, Scratch& scratch) const override {
    const Bsdf plain = world_.bsdf(at, scratch);
    Bsdf bsdf(at);
    for (int i = 0; i < plain.count(); ++i)
      bsdf.add(place<WatchedLobe>(scratch, plain.lobe(i), *at.material, finding_));
    return bsdf;
  }
  ImplicitSurfaces implicitSurfaces() const override { return world_.implicitSurfaces(); }

 private:
  const PluginCode* shape(const Hit& hit) const {
    return scene_ && hit.found() ? pluginOf(scene_->shape(hit)) : nullptr;
  }
  const Light* watched(const Light* light) const {
    return light->number < lights_.size() && world_.lights()[light->number] == light
               ? lights_[light->number]
               : light;
  }
  const Medium* watched(const Medium* medium) const {
    if (!medium) return nullptr;
    auto& own = ownMedia_[medium];
    if (!own) own = std::make_unique<WatchedMedium>(*medium, finding_);
    return own.get();
  }
  const MediumInterface* watched(const MediumInterface* sides) const {
    return &(interfaces_[sides] = {watched(sides->inside), watched(sides->outside)});
  }

  const World& world_;
  const Scene* scene_;  // null: another world, whose shapes nobody knows
  const SamplingIntegrator& integrator_;
  Finding& finding_;
  WatchedCamera camera_;
  std::vector<std::unique_ptr<WatchedLight>> ownLights_;
  mutable std::map<const Medium*, std::unique_ptr<WatchedMedium>> ownMedia_;
  mutable std::map<const MediumInterface*, MediumInterface> interfaces_;
};

const SamplingIntegrator& innermost(const SamplingIntegrator& integrator) {
  return integrator.volume() ? integrator.volume()->inner() : integrator;
}

}  // namespace

struct Watch::State {
  State(const SamplingIntegrator& given, const World& w, const Sampler& s)
      : inner(innermost(given), finding), sampler(s.clone(), finding) {
    const VolumeIntegrator* own = given.volume();
    if (const VolumeIntegrator* v = own ? own : w.volume()) volume.emplace(*v, inner, finding);
    world.emplace(w, innermost(given), w.volume() ? &*volume : nullptr, finding);
    if (own) integrator = &*volume;
  }

  Finding finding;
  WatchedIntegrator inner;
  std::optional<WatchedVolume> volume;
  const SamplingIntegrator* integrator = &inner;
  WatchedSampler sampler;
  std::optional<WatchedWorld> world;
};

Watch::Watch(const SamplingIntegrator& integrator, const World& world, const Sampler& sampler)
    : state_(std::make_unique<State>(integrator, world, sampler)) {}
Watch::~Watch() = default;

const SamplingIntegrator& Watch::integrator() const {
  return *state_->integrator;
}
const World& Watch::world() const {
  return *state_->world;
}
const Sampler& Watch::sampler() const {
  return state_->sampler;
}

const PluginCode* Watch::culprit(const std::function<void()>& take) {
  try {
    take();
  } catch (...) {
    return thrower();
  }
  return state_->finding.culprit;
}

}  // namespace pbrt
