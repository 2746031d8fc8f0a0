// What surface() promises.

#include "shape_laws.h"
#include "shape_probe.h"

namespace pbrt::laws {
namespace {

constexpr int kHits = ShapeProbe::kHits;

// Along the normal, from h away: the surface is h away, give or take `slack`.
bool metAlongNormal(const ShapeProbe& probe, const SurfacePoint& s, double h, double slack) {
  const DVec3 n(s.n);
  return probe.nearest({s.p + h * n, -n, h - slack, h + slack}).has_value();
}

// How far off the surface a point is along its normal, for a person to read.
std::string distance(const ShapeProbe& probe, const SurfacePoint& s) {
  const auto within = [&](double h) { return metAlongNormal(probe, s, 2 * h, h); };
  double h = 1e-12 * probe.size();
  while (!within(h)) {
    h *= 2;
    if (h > 2 * probe.size()) return "nowhere near the surface";
  }
  double less = h / 2;
  for (int i = 0; i < 8; ++i) {
    const double middle = (less + h) / 2;
    (within(middle) ? h : less) = middle;
  }
  return fmt::format("{:.2g} off the surface", h);
}

void pointsLieOnTheSurface(ShapeProbe& probe, Judge& judge) {
  Tally lost;
  probe.forHits(kHits, judge, [&](const ObjectRay& r, const Found&, const SurfacePoint& s) {
    const double most = probe.traits().facingWidth + 1e-5 * probe.size();
    judge.expect(s.error >= 0 && s.error <= most,
                 "the error of the point {} is {}, not from 0 to {}: {}", show(s.p), s.error, most,
                 show(r));
    const double h = std::max(64 * s.error, 1e-5 * probe.size());
    const double slack = s.error + 1e-6 * h + 1e-15 * glm::length(s.p);
    const bool met = metAlongNormal(probe, s, h, slack);
    lost.expect(met, "the point {} is {} along its normal {}, its error says {}: {}", show(s.p),
                met ? "" : distance(probe, s), show(s.n), s.error, show(r));
  });
  lost.judge(judge, kHits / 1000);
}

void framesAreConsistent(ShapeProbe& probe, Judge& judge) {
  probe.forHits(kHits, judge, [&](const ObjectRay& r, const Found&, const SurfacePoint& s) {
    judge.expect(std::abs(glm::length(s.n) - 1) <= 1e-5, "the normal {} has length {}: {}",
                 show(s.n), glm::length(s.n), show(r));
    if (s.ns != Normal3(0))
      judge.expect(std::abs(glm::length(s.ns) - 1) <= 1e-5 && glm::dot(s.n, s.ns) > 0,
                   "the shading normal {} has length {}, and {} with n: {}", show(s.ns),
                   glm::length(s.ns), glm::dot(s.n, s.ns), show(r));
    const std::pair<const char*, Vec3> tangents[] = {
        {"dpdu", s.dpdu}, {"dpdv", s.dpdv}, {"dndu", s.dndu}, {"dndv", s.dndv}};
    for (const auto& [name, v] : tangents)
      judge.expect(isFinite(v) && std::abs(glm::dot(v, s.n)) <= 1e-4F * glm::length(v) + 1e-30F,
                   "{} = {} is not across the normal {}: {}", name, show(v), show(s.n), show(r));
    judge.expect(std::isfinite(s.uv.x) && std::isfinite(s.uv.y), "uv = {} is not finite: {}",
                 show(s.uv), show(r));
  });
}

// What every line crosses an even number of times has an inside. There the first crossing from
// outside leads into it.
void normalsOfClosedShapesPointOutward(ShapeProbe& probe, Judge& judge) {
  if (probe.traits().facingWidth > 0) return judge.skip("it turns towards every ray");
  Tally inward;
  int odd = 0;
  for (int i = 0; i < probe.lines(); ++i) {
    const DVec3 d = probe.direction();
    const ObjectRay r{probe.inPrimitive() - 3 * probe.size() * d, d};
    int crossings = 0;
    probe.crossings(r, [&](const SurfacePoint& s) {
      if (crossings++ == 0)
        inward.expect(glm::dot(DVec3(s.n), d) <= 0,
                      "at the point {} the normal {} points into it, the way of {}", show(s.p),
                      show(s.n), show(r));
    });
    odd += crossings % 2;
  }
  if (odd > kHits / 1000)
    return judge.skip("it is not closed: lines cross it an odd number of times");
  inward.judge(judge, kHits / 1000);
}

// Which side is outward does not depend on the ray.
void normalsDoNotTurnToTheRay(ShapeProbe& probe, Judge& judge) {
  if (probe.traits().facingWidth > 0) return judge.skip("it turns towards every ray");
  Tally turned;
  probe.forHits(kHits, judge, [&](const ObjectRay& r, const Found&, const SurfacePoint& s) {
    const DVec3 d = glm::normalize(r.d);
    if (std::abs(glm::dot(d, DVec3(s.n))) < 0.3) return;
    const double h = std::max(64 * s.error, 1e-5 * probe.size());
    const ObjectRay back{s.p + h * d, -d, 0.5 * h, 1.5 * h};
    const auto found = probe.nearest(back);
    if (!found) return;
    const Normal3 n = probe.shape().surface(back, found->hit).n;
    turned.expect(glm::dot(n, s.n) > 0,
                  "the normal is {}, but {} for a ray from the other side: {}", show(s.n), show(n),
                  show(r));
  });
  turned.judge(judge, kHits / 1000);
}

// p and n at a neighbouring point are what the derivatives foretell, but for seams and poles.
void derivativesForetell(ShapeProbe& probe, Judge& judge) {
  Tally tally;
  bool any = false;
  const auto hasNone = [](const SurfacePoint& s) { return s.dpdu == Vec3(0) && s.dpdv == Vec3(0); };
  probe.forHits(kHits, judge, [&](const ObjectRay& r, const Found& f, const SurfacePoint& s) {
    any |= !hasNone(s);
    if (std::abs(glm::dot(glm::normalize(r.d), DVec3(s.n))) < 0.3) return;
    const double step = 1e-3 * std::min(probe.size(), probe.sizeOf(f.primitive));
    ObjectRay aside = r;
    aside.o += step * probe.direction();
    const auto found = probe.nearest(aside);
    if (!found) return;
    const SurfacePoint q = probe.shape().surface(aside, found->hit);
    const Vec3 moved = q.p - s.p;
    const Vec2 d = q.uv - s.uv;
    if (hasNone(s) && hasNone(q)) return;
    if (glm::length(moved) > 10 * step || glm::length(moved) < 0.1 * step) return;
    const Vec3 foretold = d.x * s.dpdu + d.y * s.dpdv;
    const Vec3 turned = q.n - s.n, foretoldTurn = d.x * s.dndu + d.y * s.dndv;
    // uv are floats, however small the step.
    const Vec2 lost = 1e-7F * glm::max(glm::abs(s.uv), glm::abs(q.uv));
    const float rounding = lost.x * glm::length(s.dpdu) + lost.y * glm::length(s.dpdv);
    const float roundingTurn = lost.x * glm::length(s.dndu) + lost.y * glm::length(s.dndv);
    const bool flat = !probe.traits().looksRound;
    tally.expect(
        !(flat && glm::length(foretold - moved) > 0.05F * glm::length(moved) + rounding) &&
            !(glm::length(foretoldTurn - turned) >
              0.1F * glm::length(turned) + 1e-5F + roundingTurn),
        "from uv = {} to {} the point moves by {}, foretold {} (dpdu {}, dpdv {}); its normal by "
        "{}, foretold {} (dndu {}, dndv {}): {}",
        show(s.uv), show(q.uv), show(moved), show(foretold), show(s.dpdu), show(s.dpdv),
        show(turned), show(foretoldTurn), show(s.dndu), show(s.dndv), show(r));
  });
  if (!any) return judge.skip("it tells none: dpdu and dpdv are zero");
  judge.expect(tally.tried() > 1000, "only {} pairs of neighbours were found", tally.tried());
  tally.judge(judge, tally.tried() / 10);
}

// Rays that leave a point, off by no more than its error, do not meet the surface they leave.
void raysLeaveTheSurface(ShapeProbe& probe, Judge& judge) {
  Tally stuck;
  probe.forHits(kHits, judge, [&](const ObjectRay&, const Found&, const SurfacePoint& s) {
    const DVec3 n(s.n);
    for (const double side : {1.0, -1.0}) {
      DVec3 w = probe.direction();
      const double cosine = glm::dot(w, n);
      if (cosine * side < 0) w -= 2 * cosine * n;
      const ObjectRay leaving{s.p + side * s.error * n, w};
      const auto found = probe.nearest(leaving);
      if (!found) continue;
      judge.expect(side < 0 || !probe.traits().convex,
                   "it is convex, but a ray that leaves outward meets it at t = {}: {}",
                   found->hit.t, show(leaving));
      // From inside or over a hollow the way to the surface grows with the cosine; what faces all
      // rays is left by far already.
      const double far = (probe.traits().facingWidth > 0 ? 0.01 : 100) * s.error;
      stuck.expect(found->hit.t >= far + 1e-9 * probe.size(),
                   "a ray that leaves the point {} with error {} meets the surface again at once, "
                   "at t = {}: {}",
                   show(s.p), s.error, found->hit.t, show(leaving));
    }
  });
  stuck.judge(judge, kHits / 1000);
}

// Rays that leave along the surface, at 1e-7 of a right angle over it or under it: those that
// leave above a convex surface meet nothing.
void grazingRaysAreMetAsWell(ShapeProbe& probe, Judge& judge) {
  probe.forHits(kHits, judge, [&](const ObjectRay&, const Found&, const SurfacePoint& s) {
    const DVec3 n(s.n), along = glm::cross(n, probe.direction());
    if (!(glm::length(along) > 0.1)) return;
    for (const double side : {1.0, -1.0}) {
      const DVec3 w = glm::normalize(along) + side * 2e-7 * n;  // n is a float: good to 6e-8
      const ObjectRay leaving{s.p + side * s.error * n, w};
      const auto found = probe.nearest(leaving);
      if (!found) continue;
      const SurfacePoint q = probe.shape().surface(leaving, found->hit);
      judge.expect(isFinite(q.n) && std::isfinite(q.error), "the normal is {}, the error {}: {}",
                   show(q.n), q.error, show(leaving));
      judge.expect(side < 0 || !probe.traits().convex,
                   "it is convex, but a ray that leaves along it meets it at t = {}: {}",
                   found->hit.t, show(leaving));
    }
  });
}

constexpr Law kLaws[] = {
    {"points-lie-on-the-surface", "A point is no farther from the surface than its error tells.",
     traced<pointsLieOnTheSurface>},
    {"frames-are-consistent", "Normals have length 1, derivatives lie across them, uv is finite.",
     traced<framesAreConsistent>},
    {"normals-do-not-turn-to-the-ray",
     "The normal is the same for rays from either side of the surface.",
     traced<normalsDoNotTurnToTheRay>},
    {"normals-of-closed-shapes-point-outward",
     "The normal of a shape that every line enters and leaves points out of it.",
     traced<normalsOfClosedShapesPointOutward>},
    {"derivatives-foretell-the-neighbourhood",
     "A step in uv moves the point by dpdu, dpdv and turns the normal by dndu, dndv.",
     traced<derivativesForetell>},
    {"rays-leave-the-surface",
     "A ray that starts at a point, off by its error, does not meet the surface there again.",
     traced<raysLeaveTheSurface>},
    {"grazing-rays-are-met-as-well", "What rays along the surface meet is finite.",
     traced<grazingRaysAreMetAsWell>},
};

}  // namespace

std::span<const Law> shapeSurfaceLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
