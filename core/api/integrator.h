#pragma once
// Integrators: from a scene to the light that the film records.

#include "core/api/sampler.h"
#include "core/api/world.h"

namespace pbrt {

class Film;
struct RenderControl;  // core/scene/render.h: which samples, how many threads, who is told

class Integrator {
 public:
  struct Setup {};

  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator();

  // Fills the film. The same world, sampler and sample range give the same bits, whatever the
  // number of threads.
  virtual void render(const World& world, const Sampler& sampler, Film& film,
                      RenderControl& control) const = 0;
};

// Integrators that estimate the light along one camera ray at a time. The core's loop over tiles
// makes the samples, traces the camera rays in packets and adds the results to the film.
class SamplingIntegrator : public Integrator {
 public:
  ~SamplingIntegrator() override;
  void render(const World& world, const Sampler& sampler, Film& film,
              RenderControl& control) const final;

  // Radiance that arrives at the origin of `ray` against its direction; `hit` is where the ray
  // first meets the world, which the caller has found (not found: it escapes).
  // Called from many threads at once; sampler and scratch are the thread's own.
  virtual Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit,
                      Sampler& sampler, Scratch& scratch) const = 0;
};

}  // namespace pbrt
