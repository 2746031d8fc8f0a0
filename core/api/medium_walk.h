#pragma once
// Rays through media, stretch by stretch.

#include <span>

#include "core/api/medium.h"

namespace pbrt {

// A part of a ray in which the medium has the bounds of one cell.
struct Stretch : Interval, Medium::Cell {
  double length() const { return end - begin; }
  double middle() const { return begin + 0.5 * length(); }
};

// The cells along a ray, one after the other (Amanatides and Woo 1987). Where it crosses the faces
// of cells is worked out anew from their indices: it never stands still, whatever is rounded.
class MediumWalk {
 public:
  MediumWalk() = default;
  // Render space, w of unit length. The medium must outlive it.
  MediumWalk(const Medium& medium, const DPoint3& o, const DVec3& w, Interval t);

  // Goes on to the next stretch (to the first at first); false if there is none.
  bool next();
  const Stretch& stretch() const { return stretch_; }
  const Medium& medium() const { return *medium_; }

 private:
  double crossing(int axis) const;

  const Medium* medium_ = nullptr;
  DPoint3 o_{};  // medium space
  DVec3 w_{};
  Stretch stretch_;
  double end_ = 0;
  bool more_ = false;
  glm::ivec3 cell_{0};  // the next one
  DVec3 crossings_{};   // where the ray leaves it
};

// A ray through several media that may overlap: the sum of all.
class MediaWalk {
 public:
  // Where a ray scatters.
  struct Scattering {
    Spectrum scattering{0};
    float g = 0;
  };

  // `room` for as many media as there may be.
  explicit MediaWalk(std::span<MediumWalk> room) : room_(room) {}

  // A new ray, through `around` (null: none) and the regions.
  void start(const Medium* around, std::span<const Medium* const> regions, const DPoint3& o,
             const DVec3& w, Interval t);
  // The next stretch with anything in it; false if there is none.
  bool next();
  const Stretch& stretch() const { return stretch_; }
  // At the distance t, within the stretch.
  MediumPoint at(double t) const;
  // Chooses one of the media by the number u for what they scatter there. Its expectation over u is
  // that of all.
  Scattering scattering(double t, float u) const;
  DPoint3 point(double t) const { return o_ + t * w_; }

 private:
  std::span<MediumWalk> room_;
  std::size_t count_ = 0;  // walks that go on; each has a stretch that has not ended
  DPoint3 o_{};
  DVec3 w_{};
  Stretch stretch_;
};

}  // namespace pbrt
