#pragma once
// The search for the first zero of the field along a ray; see roots.h for what it promises.

#include "shapes/metaballs/chord.h"
#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

// The largest T not above x, the smallest not below.
template <class T>
T roundDown(double x) {
  const T r = static_cast<T>(x);
  return r > x ? std::nextafter(r, std::numeric_limits<T>::lowest()) : r;
}
template <class T>
T roundUp(double x) {
  return -roundDown<T>(-x);
}

// A first look in float excludes most pieces, and narrows the others down so far that few looks in
// double decide. All s are distances from the middle of the ray's piece in the cell.
template <class K>
class Search {
 public:
  Search(std::span<const Atom> atoms, AtomList list, const Segment& piece, const RayQuery& query)
      : atoms_(atoms),
        list_(list),
        piece_(piece),
        effort_(*query.effort),
        any_(query.any),
        tolerance_(0x1p-46 * (2 * piece.half) + piece.error),
        acceptable_(std::max(std::max(query.acceptable, tolerance_), 0x1p-44 * piece.half)),
        startsUntil_(piece.starts ? -piece.half : -kInfinity),
        floats_(atoms, list, piece, query.near) {}
  ~Search() {
    if (hasDoubles_) doubles_.~Chord();
  }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  // The first zero in [s0, s1].
  std::optional<double> first(double s0, double s1, bool inFloat);

 private:
  Bernstein look(double s0, double s1, bool inFloat);

  std::span<const Atom> atoms_;
  AtomList list_;
  const Segment& piece_;
  Effort& effort_;
  bool any_;
  double tolerance_;   // a suspect as short as this is a touch, if only rounding is left
  double acceptable_;  // a certain zero is known well enough
  double
      startsUntil_;  // from its start to here the ray is on the surface, for all that double tells
  Chord<K, Floats> floats_;
  bool hasDoubles_ = false;
  union {
    Chord<K, Doubles> doubles_;  // made when first used
  };
};

// In float s0 and s1 are floats.
template <class K>
Bernstein Search<K>::look(double s0, double s1, bool inFloat) {
  if (inFloat) {
    ++effort_.floats;
    return floats_.over(static_cast<float>(s0), static_cast<float>(s1));
  }
  ++effort_.doubles;
  if (!hasDoubles_) {
    new (&doubles_) Chord<K, Doubles>(atoms_, list_, piece_, piece_.o);
    hasDoubles_ = true;
  }
  return doubles_.over(s0, s1);
}

template <class K>
std::optional<double> Search<K>::first(double s0, double s1, bool inFloat) {
  const double start = inFloat ? roundDown<float>(s0) : s0;
  const double w = (inFloat ? roundUp<float>(s1) : s1) - start;
  const Bernstein f = look(start, start + w, inFloat);
  const bool sharp = !inFloat && f.hi - f.lo <= 4 * f.rounding;
  Suspect suspect;
  for (double from = 0; from < 1 && f.suspect(from, suspect); from = suspect.b + 0x1p-50) {
    double a = start + suspect.a * w, b = start + suspect.b * w;
    const bool certain = suspect.certain && (!inFloat || (a >= s0 && b <= s1));
    a = std::max(a, s0);
    b = std::min(b, s1);
    if (!(a <= b)) continue;
    if (certain && (any_ || b - a <= acceptable_)) return start + suspect.guess * w;
    // From nearer nothing would be seen better. (Rounding is that of the steepest place.)
    if (certain && sharp &&
        (w <= 0x1p-10 * piece_.half || look(a, b, false).rounding > 0.5 * f.rounding))
      return start + suspect.guess * w;
    if (!certain && sharp) {
      if (a <= startsUntil_) {
        startsUntil_ = b + tolerance_;
        continue;
      }
      if (b - a <= tolerance_) return 0.5 * (a + b);
    }
    std::optional<double> s;
    if (b - a <= 0.5 * w || inFloat) {
      s = first(a, b, inFloat && b - a > 0x1p-7 * piece_.half && b - a <= 0.5 * w);
    } else {
      s = first(a, 0.5 * (a + b), false);
      if (!s) s = first(0.5 * (a + b), b, false);
    }
    if (s) return s;
  }
  return {};
}

template <class K>
std::optional<double> find(std::span<const Atom> atoms, AtomList list, const RayQuery& query) {
  const ObjectRay& ray = *query.ray;
  const Segment piece = clip(ray, query.lo, query.hi);
  if (piece.half < 0) return {};
  const auto s = Search<K>(atoms, list, piece, query).first(-piece.half, piece.half, true);
  if (!s) return {};
  const double t = piece.t(*s);
  return t > ray.tMin && t <= ray.tMax ? std::optional(t) : std::nullopt;
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
