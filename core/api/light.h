#pragma once
// Lights.

#include "core/api/shape.h"

namespace pbrt {

// Light that arrives at a point from one chosen direction.
struct LightSample {
  Spectrum L{0};       // radiance; for a delta light intensity over squared distance
  Vec3 wi{};           // unit, from the lit point towards the light
  Point3 p{};          // where it comes from, if `finite`
  Normal3 n{};         // geometric normal there; zero for points
  float error = 0;     // as SurfaceInteraction::error
  bool finite = true;  // false: from infinitely far along wi
  float pdf = 0;       // per solid angle; 1 for a delta light; 0: no light arrives
};

class Light {
 public:
  struct Setup {
    Transform toRender;                    // light space to render space
    const AreaSampler* surface = nullptr;  // of an area light, in render space; else null
  };

  Light() = default;
  Light(const Light&) = delete;
  Light& operator=(const Light&) = delete;
  virtual ~Light();

  // Called once, before rendering.
  virtual void prepare(const Bounds3& /*scene*/) {}

  // Chooses a direction towards the light from p.
  virtual LightSample sample(const Point3& p, Point2 u) const = 0;
  // No other strategy finds a delta light: it has a position or a direction, but no extent.
  virtual bool isDelta() const { return true; }
  // How many samples direct lighting should take of it.
  int samples() const { return samples_; }

  // Area lights: radiance that leaves the surface point in direction w.
  virtual Spectrum emitted(const Point3& /*p*/, const Normal3& /*n*/, const Vec3& /*w*/) const {
    return Spectrum(0);
  }
  // Area lights: the density of sample() for the surface point `on` seen from p.
  virtual float pdf(const Point3& /*p*/, const SurfaceInteraction& /*on*/) const { return 0; }
  // Area lights: false only if no ray from p along w reaches the light.
  virtual bool mayHit(const Point3& /*p*/, const Vec3& /*w*/) const { return false; }

  // Infinite lights: radiance from the unit direction w, for rays that hit nothing.
  virtual bool isInfinite() const { return false; }
  virtual Spectrum escaped(const Vec3& /*w*/) const { return Spectrum(0); }
  // Infinite lights: the density of sample() for direction w.
  virtual float pdfEscaped(const Vec3& /*w*/) const { return 0; }

 protected:
  int samples_ = 1;
};

}  // namespace pbrt
