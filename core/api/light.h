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

// What choosing among many lights goes by, in render space. Of a finite light everything leaves
// within `emission` of a direction of `normals`, or of the opposite one if it shines both ways.
struct LightBounds {
  Bounds3 box;  // holds the light; empty: infinitely far
  // Luminance of the radiant intensity at its largest, or its mean; of an infinite light the
  // irradiance of a surface that faces it, or its mean over all surfaces.
  double intensity = 0;
  DirectionCone normals;
  float cosEmission = 1;
  bool twoSided = false;
};

class Light {
 public:
  struct Setup {
    Transform toRender;                    // light space to render space
    const AreaSampler* surface = nullptr;  // of an area light, in render space; else null
    Bounds3 box;                           // holds that surface
  };

  Light() = default;
  Light(const Light&) = delete;
  Light& operator=(const Light&) = delete;
  virtual ~Light();

  // Luminance of the flux that it sends out; of an infinite light, into a ball of this radius. A
  // light space that is stretched unevenly counts as one stretched evenly, by the same volume.
  virtual double power(double sceneRadius) const = 0;
  virtual LightBounds bounds() const = 0;

  // Chooses a direction towards the light from p.
  virtual LightSample sample(const Point3& p, Point2 u) const = 0;
  // No other strategy finds a delta light: it has a position or a direction, but no extent.
  virtual bool isDelta() const { return true; }
  // How many samples direct lighting should take of it.
  int samples() const { return samples_; }
  // Its place in World::lights(), which the scene sets.
  std::uint32_t number = 0;

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
