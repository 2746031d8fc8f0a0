#pragma once
// Lights before their laws.

#include <span>

#include "core/base/rng.h"
#include "disk.h"
#include "law.h"

namespace pbrt::laws {

// A light, its space turned and moved. If it is an area light, it is a disk about the origin of
// render space that faces +z.
class Lamp {
 public:
  explicit Lamp(const Subject& subject);
  Lamp(const Subject& subject, const Transform& toRender);
  const Light* operator->() const { return light_.get(); }

  // Whether all its light leaves from one point.
  bool isPoint() const;
  // The middle of what shines; the origin for an infinite light.
  Point3 centre() const { return centre_; }

  // A place to be lit, up to 5 times the light's size (at least 5 units) away from the centre. Half
  // of those about a point lie where its bounds let it shine, or hardly beyond.
  Point3 place(Rng& rng) const;
  // The direction of such a place from the centre, and the density of the choice per solid angle.
  struct Direction {
    Vec3 w{};
    double pdf = 0;
  };
  Direction direction(Rng& rng) const;

  // What comes in direction w from a light that has an extent and is seen from p.
  Spectrum radiance(const Point3& p, const Vec3& w) const;
  double pdf(const Point3& p, const Vec3& w) const;  // of its sample(), per solid angle

 private:
  DiskSampler disk_;
  std::unique_ptr<Light> light_;
  LightBounds bounds_;
  Point3 centre_{};
  float size_ = 1;
  double capHeight_ = 0;  // 1 - cos of the cone about what a point shines into; 0: everywhere
};

// Where area lights do not look for their surface: as a scene makes other lights.
std::unique_ptr<Light> withoutSurface(const Subject& subject);

std::span<const Law> lightIntegralLaws();

}  // namespace pbrt::laws
