#pragma once
// The laws of volumes come from two files.

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "law.h"

namespace pbrt::laws {

// Medium space, turned, stretched and mirrored, in render space.
inline Transform mediumPlace() {
  return Transform::translate({0.3, -0.2, 0.5}) * Transform::rotate(50, {1, 2, 3}) *
         Transform::scale({2, 1, -1.5});
}

// A medium in its place, with its box.
struct PlacedMedium {
  explicit PlacedMedium(const Subject& subject, const Transform& where = mediumPlace())
      : place(where),
        medium(subject.make<Medium>({where})),
        lo(Box::least(*medium)),
        hi(Box::most(*medium)) {
    if (!medium->bounded()) lo = DPoint3(0), hi = DPoint3(1);
  }

  // `q` in [0, 1]^3 if it is in the box, else beyond; of an unbounded medium the box is that of its
  // own space from 0 to 1.
  DPoint3 point(const DPoint3& q) const { return place.point(lo + q * (hi - lo)); }

  Transform place;
  std::unique_ptr<Medium> medium;
  DPoint3 lo, hi;

 private:
  // A medium tells its box to classes that derive from it.
  struct Box : Medium {
    static DPoint3 least(const Medium& m) { return (m.*(&Box::lo))(); }
    static DPoint3 most(const Medium& m) { return (m.*(&Box::hi))(); }
  };
};

// A straight way of some length.
struct Way {
  DPoint3 o{};
  DVec3 w{};
  double length = 0;

  DPoint3 at(double t) const { return o + t * w; }
};
inline std::string show(const Way& way) {
  return fmt::format("the way from ({}, {}, {}) along ({}, {}, {})", way.o.x, way.o.y, way.o.z,
                     way.w.x, way.w.y, way.w.z);
}

// From about the box through some point of it.
inline Way somewhere(const PlacedMedium& m, Rng& rng) {
  const DPoint3 through = m.point({rng.uniform(), rng.uniform(), rng.uniform()});
  const DVec3 w(uniformSphere({rng.uniform(), rng.uniform()}));
  const double size = glm::distance(m.point({0, 0, 0}), m.point({1, 1, 1}));
  return {through - 0.7 * rng.uniform() * size * w, glm::normalize(w), size};
}

// How light fares in them, in volume_light_laws.cpp.
void estimatesAgreeWithQuadrature(const Subject& subject, Judge& judge);
void transmittanceMultiplies(const Subject& subject, Judge& judge);

}  // namespace pbrt::laws
