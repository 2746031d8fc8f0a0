#pragma once
// Light that a path meets by going on, beside the light that is sampled.

#include "core/api/direct.h"
#include "core/api/light_choice.h"

namespace pbrt {

// A light that the last vertex could have sampled instead is weighted against that.
struct MetLight {
  MetLight(const World& world, LightStrategy strategy) : choice(world, strategy) {}

  LightChoice choice;  // about the last vertex
  float pdf = 0;       // of the ray's direction; 0: no light could have been sampled instead

  // Adds what comes from infinitely far along a ray that hits nothing.
  void addEscaped(const World& world, const Ray& ray, const Spectrum& throughput,
                  Spectrum& L) const {
    const Vec3 w = glm::normalize(ray.d);
    for (const Light* light : world.infiniteLights())
      L += throughput * light->escaped(w) * (pdf == 0 ? 1 : weight(*light, light->pdfEscaped(w)));
  }
  // Adds what the surface that the ray meets emits.
  void addEmitted(const SurfaceInteraction& at, const Spectrum& throughput, Spectrum& L) const {
    if (!at.light) return;
    const Spectrum emitted = at.light->emitted(at.p, at.n, at.wo);
    if (!isBlack(emitted))
      L += throughput * emitted *
           (pdf == 0 ? 1 : weight(*at.light, at.light->pdf(choice.point(), at)));
  }

 private:
  // Where sampling the light itself has density lightPdf.
  float weight(const Light& light, float lightPdf) const {
    return powerHeuristic(1, pdf, choice.chance(light), lightPdf);
  }
};

}  // namespace pbrt
