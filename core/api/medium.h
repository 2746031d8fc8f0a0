#pragma once
// Participating media: smoke, fog, milk.

#include <optional>
#include <vector>

#include "core/base/spectrum.h"
#include "core/base/transform.h"

namespace pbrt {

// What a medium does to light at a point, per unit length of the scene.
struct MediumPoint {
  Spectrum absorption{0};
  Spectrum scattering{0};
  Spectrum emission{0};  // radiance that a ray gains

  Spectrum extinction() const { return absorption + scattering; }
  // Of so many times the density.
  MediumPoint operator*(float density) const {
    return {absorption * density, scattering * density, emission * density};
  }
};

// A part of a ray, in distances from its origin.
struct Interval {
  double begin = 0, end = 0;
};

// A medium fills a box of its own space, or all of space. A scene has it by its name on either side
// of surfaces (pbrt-v3, v4), or as a region that lies wherever surfaces are (pbrt-v1, v2).
class Medium {
 public:
  struct Setup {
    Transform toRender;  // medium space to render space
  };
  // Bounds over a cell of the box; all cells have one size. A cell whose majorant is 0 in every
  // channel is empty.
  struct Cell {
    Spectrum majorant{0};  // no less than the extinction anywhere in the cell
    bool uniform = true;   // whether the medium is the same all over it, its emission too
  };

  Medium(const Medium&) = delete;
  Medium& operator=(const Medium&) = delete;
  virtual ~Medium();

  // At a point in render space; nothing outside the box.
  MediumPoint at(const DPoint3& p) const;
  // The same for a point that only rounding can have moved out of the box.
  MediumPoint inside(const DPoint3& p) const;
  // Mean cosine of the scattering angle, for Phase.
  float g() const { return g_; }
  bool bounded() const { return std::isfinite(hi_.x - lo_.x); }
  // The part of o + t w, begin <= t <= end, in the box; empty if there is none. Render space; w has
  // unit length, so that t is a distance.
  std::optional<Interval> clip(const DPoint3& o, const DVec3& w, Interval t) const;

 protected:
  // The box, in medium space; infinite in all directions if the medium fills all of space.
  Medium(const Setup& setup, float g, const DPoint3& lo, const DPoint3& hi)
      : toMedium_(setup.toRender.inverse()), g_(g), lo_(lo), hi_(hi) {}

  // At a point of the box, in medium space.
  virtual MediumPoint properties(const DPoint3& p) const = 0;

  // To be called once by every constructor; x goes fastest. Of a medium that glows the majorants
  // are raised, so that light is found where nothing is extinguished. Throws Error if a majorant is
  // not finite, or so great that nobody could trace a ray through a cell that is not uniform.
  void setCells(const glm::ivec3& n, std::vector<Cell> cells, bool glows);
  const DPoint3& lo() const { return lo_; }
  const DPoint3& hi() const { return hi_; }

 private:
  friend class MediumWalk;
  friend class WatchedMedium;  // core/scene/watch.cpp

  Transform toMedium_;
  float g_;
  DPoint3 lo_, hi_;
  glm::ivec3 n_{1};
  std::vector<Cell> cells_;
};

// What lies on the two sides of a surface; null is clear air.
struct MediumInterface {
  const Medium* inside = nullptr;
  const Medium* outside = nullptr;  // where the normal points to

  const Medium* towards(const Vec3& w, const Normal3& n) const {
    return glm::dot(w, n) > 0 ? outside : inside;
  }
};

}  // namespace pbrt
