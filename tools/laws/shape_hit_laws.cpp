// What bounds(), intersect() and occluded() promise.

#include "shape_laws.h"
#include "shape_probe.h"

namespace pbrt::laws {
namespace {

constexpr int kHits = ShapeProbe::kHits;

void boundsHoldTheHits(ShapeProbe& probe, Judge& judge) {
  for (std::uint32_t i = 0; i < probe.shape().primitives(); ++i) {
    const Bounds3 b = probe.shape().bounds(i);
    judge.expect(b.empty() || (isFinite(b.lo) && isFinite(b.hi)),
                 "primitive {} has the bounds {} to {}", i, show(b.lo), show(b.hi));
  }
  if (judge.failures() > 0) return;
  if (probe.empty()) {
    judge.expect(false,
                 "the box around all its primitives ({}) is empty, from {} to {}: it is nowhere",
                 probe.shape().primitives(), show(probe.box().lo), show(probe.box().hi));
    return;
  }
  probe.forHits(kHits, judge, [&](const ObjectRay& r, const Found& f, const SurfacePoint& s) {
    const Bounds3 b = probe.shape().bounds(f.primitive);
    const double slack = probe.errorOf(s) + 1e-9 * probe.size();
    double outside = 0;
    for (int i = 0; i < 3; ++i) outside = std::max({outside, b.lo[i] - s.p[i], s.p[i] - b.hi[i]});
    judge.expect(outside <= slack,
                 "the point {} is {:.3g} outside of the bounds {} to {} of its primitive "
                 "{}: {}",
                 show(s.p), outside, show(b.lo), show(b.hi), f.primitive, show(r));
  });
}

void hitsLieOnTheRay(ShapeProbe& probe, Judge& judge) {
  probe.forHits(kHits, judge, [&](const ObjectRay& r, const Found& f, const SurfacePoint& s) {
    judge.expect(f.hit.primitive == f.primitive,
                 "a hit on primitive {} names primitive {} (ShapeHit::primitive): {}", f.primitive,
                 f.hit.primitive, show(r));
    const DVec3 d = glm::normalize(r.d);
    const double cosine = std::max(1e-3, std::abs(glm::dot(d, DVec3(s.n))));
    const double rounding = 0x1p-23 * f.hit.t * glm::length(r.d);  // of t to float
    const double most = rounding + (probe.errorOf(s) + 1e-9 * probe.size()) / cosine;
    const double off = glm::length(s.p - r.at(f.hit.t));
    judge.expect(f.hit.t > 0 && off <= most,
                 "the hit at t = {} gives the point {}, {:.3g} off the ray's own point there, "
                 "where its error and rounding explain {:.3g}: {}",
                 f.hit.t, show(s.p), off, most, show(r));
  });
}

void shadowRaysAgree(ShapeProbe& probe, Judge& judge) {
  for (int i = 0; i < kHits; ++i) {
    const ObjectRay r = probe.ray();
    probe.primitives(r, [&](std::uint32_t k) {
      const bool occluded = probe.shape().occluded(r, k);
      const bool hit = probe.shape().intersect(r, k).has_value();
      if (hit != occluded)
        judge.fail("primitive {} is {} by intersect(), but occluded() says {}: {}", k,
                   hit ? "hit" : "missed", occluded, show(r));
    });
    judge.expect(true, "");
  }
}

void rangeOfTIsKept(ShapeProbe& probe, Judge& judge) {
  const Shape& shape = probe.shape();
  for (int i = 0; i < kHits; ++i) {
    const ObjectRay r = probe.ray();
    probe.primitives(r, [&](std::uint32_t k) {
      const auto hit = shape.intersect(r, k);
      if (!hit) return;
      // What the range lets through, each time with the hit or without.
      const auto keeps = [&](ObjectRay cut, bool wanted, const char* where) {
        const bool found = shape.intersect(cut, k).has_value(), blocked = shape.occluded(cut, k);
        judge.expect(found == wanted && blocked == wanted,
                     "the hit of primitive {} at t = {} is {} {}: intersect() says {}, occluded() "
                     "{}: {}",
                     k, hit->t, wanted ? "just before" : "just beyond", where, found, blocked,
                     show(cut));
      };
      ObjectRay cut = r;
      cut.tMax = 0.9999F * hit->t;
      keeps(cut, false, "tMax");
      cut.tMax = 1.0001F * hit->t;
      keeps(cut, true, "tMax");
      cut = r;
      cut.tMin = 1.0001F * hit->t;
      const auto later = shape.intersect(cut, k);
      judge.expect(!later || later->t > cut.tMin,
                   "primitive {} is hit at t = {}, which is not beyond tMin: {}", k,
                   later ? later->t : 0, show(cut));
      // From a little before the hit: the same hit.
      cut.tMin = 0.999 * hit->t;
      const auto again = shape.intersect(cut, k);
      judge.expect(again && std::abs(again->t - hit->t) <= 1e-6 * hit->t,
                   "primitive {} is hit at t = {}, but from tMin = {} on {}: {}", k, hit->t,
                   cut.tMin, again ? fmt::format("at t = {}", again->t) : "it is missed", show(r));
    });
  }
}

// Where a line meets a surface does not depend on the end from which one looks.
void linesAreTheSameBackwards(ShapeProbe& probe, Judge& judge) {
  if (probe.traits().facingWidth > 0) return judge.skip("it turns towards every ray");
  Tally tally;
  for (int i = 0; i < probe.lines(); ++i) {
    const DVec3 d = probe.direction();
    const ObjectRay there{probe.inPrimitive() - 3 * probe.size() * d, d};
    const ObjectRay back{there.at(6 * probe.size()), -d};
    int forwards = 0, backwards = 0;
    probe.crossings(there, [&](const SurfacePoint&) { ++forwards; });
    probe.crossings(back, [&](const SurfacePoint&) { ++backwards; });
    tally.expect(forwards == backwards, "{} crossings there, but {} back: {}", forwards, backwards,
                 show(there));
  }
  tally.judge(judge, kHits / 1000);
}

// Along an axis or in a plane of the coordinates, short and long, from near and from 1e6 sizes
// away, also from the surface itself: what is hit lies on the ray, and nothing is not a number.
void oddRaysAreMetAsWell(ShapeProbe& probe, Judge& judge) {
  const double size = probe.size();
  for (int i = 0; i < 4 * kHits; ++i) {
    DVec3 d = probe.direction();
    for (int k = 0; k <= i % 2; ++k) d[(i + k) % 3] = i % 4 < 2 ? 0.0 : -0.0;
    DPoint3 to = probe.inPrimitive();
    if (i % 3 == 0) to[i % 3] = probe.centre()[i % 3];  // often the plane of symmetry
    const double distance = i % 5 ? 3 : 1e6;
    const double scale = i % 7 ? 0.5 + probe.uniform() : std::pow(10, 12 * probe.uniform() - 6);
    ObjectRay r{to - distance * size * d, d * scale};
    for (int again = 0; again < 2; ++again) {
      const auto found = probe.nearest(r);
      if (!found) break;
      const SurfacePoint s = probe.shape().surface(r, found->hit);
      bool finite = std::isfinite(s.p.x + s.p.y + s.p.z) && std::isfinite(s.error);
      for (const Vec3& v : {s.n, s.ns, s.dpdu, s.dpdv, s.dndu, s.dndv}) finite &= isFinite(v);
      if (!judge.expect(finite, "what surface() gives is not finite (p = {}, n = {}): {}",
                        show(s.p), show(s.n), show(r)))
        break;
      const double length = glm::length(r.d), t = found->hit.t;
      const DVec3 off = s.p - r.at(t);
      // Across the ray; along it, t is a float.
      const double across = glm::length(off - glm::dot(off, r.d) / (length * length) * r.d);
      const double rounding = 1e-9 * size + 1e-15 * t * length;
      const double cosine = std::abs(glm::dot(r.d / length, DVec3(s.n)));
      const double most = (probe.errorOf(s) + rounding) / std::max(1e-3, cosine);
      judge.expect(
          across <= most,
          "the point {} is {:.3g} beside the ray, where its error and rounding explain {:.3g}: {}",
          show(s.p), across, most, show(r));
      r.o = s.p, r.tMin = 0;  // on from the very point
    }
  }
  judge.expect(judge.trials() > 2000, "only {} of these rays hit", judge.trials());
}

constexpr Law kLaws[] = {
    {"bounds-hold-every-hit", "What is hit lies within the bounds of its primitive.",
     traced<boundsHoldTheHits, true>},
    {"hits-lie-on-the-ray", "A hit lies on the ray, at its t, and names its primitive.",
     traced<hitsLieOnTheRay>},
    {"shadow-rays-agree", "occluded() is true where intersect() hits, and only there.",
     traced<shadowRaysAgree>},
    {"range-of-t-is-kept", "intersect() and occluded() tell of hits with tMin < t <= tMax alone.",
     traced<rangeOfTIsKept>},
    {"lines-are-the-same-backwards", "A line crosses it as often from one end as from the other.",
     traced<linesAreTheSameBackwards>},
    {"odd-rays-are-met-as-well",
     "Rays along axes, from far away, of any length or from the surface: hits are on them, finite.",
     traced<oddRaysAreMetAsWell>},
};

}  // namespace

std::span<const Law> shapeHitLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
