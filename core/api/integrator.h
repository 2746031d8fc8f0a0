#pragma once
// Integrators: from a scene to the light that the film records.

#include "core/api/sampler.h"
#include "core/api/world.h"

namespace pbrt {

class Film;
class SamplingIntegrator;
class VolumeIntegrator;
enum class LightStrategy : std::uint8_t;  // core/api/light_choice.h
struct RenderControl;  // core/scene/render.h: which samples, how many threads, who is told

class Integrator {
 public:
  struct Setup {
    // For a volume integrator: what it adds to. It must outlive it.
    const SamplingIntegrator* surface = nullptr;
  };

  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator();

  // Fills the film. The same world, sampler and sample range give the same bits, whatever the
  // number of threads.
  virtual void render(const World& world, const Sampler& sampler, Film& film,
                      RenderControl& control) const = 0;

  // Whether without any light its picture is black.
  virtual bool usesLights() const { return true; }
  // Whether it may choose lights by this (LightChoice). What it does not is not prepared, and would
  // choose each light as often.
  virtual bool mayChooseBy(LightStrategy) const { return true; }
  // Whether it traces light through media itself. Others see surfaces alone.
  virtual bool tracesMedia() const { return false; }
  // What they are able to do; null: not that.
  virtual const SamplingIntegrator* sampling() const { return nullptr; }
  virtual const VolumeIntegrator* volume() const { return nullptr; }
};

// Integrators that estimate the light along one camera ray at a time. The core's loop over tiles
// makes the samples, traces the camera rays in packets and adds the results to the film.
class SamplingIntegrator : public Integrator {
 public:
  static constexpr int kBlock = 4;
  static_assert(kBlock * kBlock == World::kBatch);

  ~SamplingIntegrator() override;
  void render(const World& world, const Sampler& sampler, Film& film,
              RenderControl& control) const final;
  const SamplingIntegrator* sampling() const final { return this; }

  // Called before the first rays of each render, not when it goes on, within its limit of threads;
  // `resolution` is that of the whole picture. May throw Error.
  virtual void prepare(const World& /*world*/, Point2i /*resolution*/) const {}
  // The camera rays of so many by so many neighbouring pixels are looked at together: a power of
  // two, 32 at most.
  virtual int blockWidth() const { return kBlock; }
  // What such rays see first, row by row, `width` to a row; a block may be cut off at the border of
  // the picture. Instead of what the world has there an integrator may find what it has itself: it
  // then gives those hits their meaning, in surface(); t, geometry and instance are as in any.
  virtual void look(const World& world, std::span<const Ray* const> rays, int /*width*/,
                    std::span<Hit> hits) const {
    world.intersect(rays, hits);
  }
  // The point that a hit of look() names; it must be found.
  virtual SurfaceInteraction surface(const World& world, const RayDifferential& ray,
                                     const Hit& hit) const {
    return world.surface(ray, hit);
  }
  // Radiance that arrives at the origin of `ray` against its direction; `hit` is what look() has
  // found for it (not found: it escapes).
  // Called from many threads at once; sampler and scratch are the thread's own.
  virtual Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit,
                      Sampler& sampler, Scratch& scratch) const = 0;
};

// What the regions of a scene (pbrt-v1, v2) make of the light that another integrator finds. Its
// mirrors and shadow rays ask it, too: World::volume().
class VolumeIntegrator : public SamplingIntegrator {
 public:
  // Throws Error if there is no other integrator.
  explicit VolumeIntegrator(const Setup& setup);
  ~VolumeIntegrator() override;
  const VolumeIntegrator* volume() const final { return this; }
  // What it adds to.
  const SamplingIntegrator& inner() const { return surface_; }

  void prepare(const World& world, Point2i resolution) const final {
    surface_.prepare(world, resolution);
  }
  int blockWidth() const final { return surface_.blockWidth(); }
  void look(const World& world, std::span<const Ray* const> rays, int width,
            std::span<Hit> hits) const final {
    surface_.look(world, rays, width, hits);
  }
  SurfaceInteraction surface(const World& world, const RayDifferential& ray,
                             const Hit& hit) const final {
    return surface_.surface(world, ray, hit);
  }
  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch& scratch) const final {
    return through(world, ray, hit, surface_.Li(world, ray, hit, sampler, scratch), sampler);
  }

  // What arrives of radiance L that starts against the ray where it hits (or far away), with what
  // is added on the way.
  virtual Spectrum through(const World& world, const Ray& ray, const Hit& hit, const Spectrum& L,
                           Sampler& sampler) const = 0;
  // The share that comes through from where the ray has the parameter t.
  virtual Spectrum transmittance(const World& world, const Ray& ray, float t) const = 0;

 private:
  const SamplingIntegrator& surface_;
};

// The share of light that the regions leave on a ray up to its parameter t, where `light` is what
// comes: for integrators of surfaces.
inline Spectrum dimmed(const Spectrum& light, const World& world, const Ray& ray, float t) {
  const VolumeIntegrator* const volume = world.volume();
  return volume ? light * volume->transmittance(world, ray, t) : light;
}

}  // namespace pbrt
