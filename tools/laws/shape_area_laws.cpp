// What the AreaSampler of a shape promises.

#include "mean.h"
#include "shape_laws.h"
#include "shape_probe.h"

namespace pbrt::laws {
namespace {

class AreaProbe : public ShapeProbe {
 public:
  explicit AreaProbe(const Subject& subject)
      : ShapeProbe(subject), sampler_(shape().areaSampler()) {
    // Oblique to every axis: near the plane of a flat light densities have wild tails.
    for (const double radii : {100.0, 3.0, -1.05, 0.4, -0.2})
      from_.push_back(centre() + radii * size() * DVec3(0.48, 0.6, 0.64));
  }

  bool samples() const { return sampler_ != nullptr; }
  const AreaSampler& sampler() const { return *sampler_; }
  // Points to gather light at: far, near, and within the box.
  const std::vector<DPoint3>& from() const { return from_; }

  // A direction out of all that may meet the shape, and one over its density.
  DVec3 towards(const DPoint3& from, Point2 u, double& solidAngle) const {
    const DVec3 axis = centre() - from;
    if (glm::length(axis) <= size()) {
      solidAngle = 4 * std::numbers::pi;
      return uniformSphere(u);
    }
    const float cone = sphereConeHeight(axis, size());
    solidAngle = 1 / uniformConePdf(cone);
    return Frame::fromZ(glm::normalize(axis)).fromLocal(uniformCone(u, cone));
  }
  // The integrals over the unit square of what f(u, sums) adds to the sums, by independent sums
  // over jittered grids: each is far nearer to the integral than as many random points.
  template <std::size_t N, class F>
  std::array<Mean, N> integrals(F f) {
    constexpr int batches = 64, grid = 23;  // a prime: no edge falls between its rows every time
    std::array<Mean, N> means;
    for (int k = 0; k < batches; ++k) {
      std::array<double, N> sums{};
      for (int i = 0; i < grid; ++i)
        for (int j = 0; j < grid; ++j) f((Point2(i, j) + uniform2()) / float{grid}, sums);
      for (std::size_t i = 0; i < N; ++i) means[i].add(sums[i] / (grid * grid));
    }
    return means;
  }
  template <class F>
  Mean integral(F f) {
    return integrals<1>([&](Point2 u, std::array<double, 1>& sum) { sum[0] += f(u); })[0];
  }

 private:
  const AreaSampler* sampler_;
  std::vector<DPoint3> from_;
};

template <void (*body)(AreaProbe&, Judge&)>
void sampled(const Subject& subject, Judge& judge) {
  AreaProbe probe(subject);
  if (probe.shape().triangles()) return judge.skip("it is handed over as triangles");
  if (!probe.samples()) return judge.skip("it has no areaSampler()");
  if (probe.empty()) return judge.skip("its bounds are wrong");
  body(probe, judge);
}

// Five standard deviations: a right program fails one run in two million.
bool near(double estimate, double expected, double variance) {
  return std::abs(estimate - expected) <= 5 * std::sqrt(variance) + 1e-6 * expected;
}

// Lines through a ball of radius R, uniform in direction and place, cross a surface of area A on
// average A / (2 pi R^2) times (Crofton).
void areaIsHowOftenLinesCross(AreaProbe& probe, Judge& judge) {
  Mean crossed;
  const double size = probe.size(), disk = std::numbers::pi * size * size;
  for (int i = 0; i < 40 * probe.lines(); ++i) {
    const Frame frame = Frame::fromZ(probe.direction());
    const Point2 d = concentricDisk(probe.uniform2());
    const DVec3 z(frame.z), aside = DVec3(frame.fromLocal({d.x, d.y, 0}));
    int count = 0;
    probe.crossings({probe.centre() + size * (aside - 1.1 * z), z},
                    [&](const SurfacePoint&) { ++count; });
    crossed.add(count);
  }
  const double measured = 2 * disk * crossed.mean(), area = probe.sampler().area();
  judge.expect(
      near(measured, area, sqr(2 * disk) * crossed.variance()),
      "area() is {}, but random lines cross the surface as often as one of {:.6g} +- {:.2g}", area,
      measured, 2 * disk * crossed.error());
}

void samplesLieOnTheSurface(AreaProbe& probe, Judge& judge) {
  const AreaSampler& sampler = probe.sampler();
  for (const DPoint3& from : probe.from())
    for (int i = 0; i < 1000; ++i) {
      const Point2 u = probe.uniform2();
      const AreaSample s = sampler.sample(from, u);
      if (!judge.expect(std::isfinite(s.pdf) && s.pdf >= 0, "sample({}, {}) has the density {}",
                        show(from), show(u), s.pdf) ||
          s.pdf == 0)
        continue;
      const float pdf = sampler.pdf(from, s.p, s.n);
      judge.expect(std::abs(pdf - s.pdf) <= 1e-4F * s.pdf,
                   "sample({}, {}) chooses {} with density {}, but pdf() of it is {}", show(from),
                   show(u), show(s.p), s.pdf, pdf);
      const double h = 1e-5 * probe.size();
      const DVec3 n(s.n);
      judge.expect(
          probe.nearest({s.p + h * n, -n, 0.999 * h - s.error, 1.001 * h + s.error}).has_value(),
          "sample({}, {}) chooses {}, where along its normal {} is no surface", show(from), show(u),
          show(s.p), show(s.n));
      const DirectionCone cone = sampler.normals();
      judge.expect(glm::dot(cone.axis, s.n) >= cone.cosine - 1e-5F,
                   "the normal {} of a sample is not in the cone of normals() about {}, cosine {}",
                   show(s.n), show(cone.axis), cone.cosine);
    }
}

// The density of sample(), over all directions that meet the surface, integrates to the share of
// draws that give a sample.
void densityIntegratesToOne(AreaProbe& probe, Judge& judge) {
  const AreaSampler& sampler = probe.sampler();
  for (const DPoint3& from : probe.from()) {
    const Mean density = probe.integral([&](Point2 u) {
      double solidAngle = 0, sum = 0;
      probe.crossings({from, probe.towards(from, u, solidAngle)},
                      [&](const SurfacePoint& s) { sum += sampler.pdf(from, s.p, s.n); });
      return sum * solidAngle;
    });
    const Mean share =
        probe.integral([&](Point2 u) { return sampler.sample(from, u).pdf > 0 ? 1 : 0; });
    judge.expect(
        near(density.mean(), share.mean(), density.variance() + share.variance()),
        "seen from {} pdf() integrates to {:.6g} +- {:.2g} over all directions, but {:.6g} "
        "of all draws give a sample",
        show(from), density.mean(), density.error(), share.mean());
  }
}

// Each eighth of the shape fills as much of the view by samples as by directions. This holds only
// if sample() has the density that pdf() tells, everywhere.
void samplesFollowTheirDensity(AreaProbe& probe, Judge& judge) {
  using Octants = std::array<double, 8>;
  const AreaSampler& sampler = probe.sampler();
  const DPoint3 c = probe.centre();
  const auto octant = [&](const DPoint3& p) {
    return (p.x > c.x ? 1U : 0U) | (p.y > c.y ? 2U : 0U) | (p.z > c.z ? 4U : 0U);
  };
  for (const DPoint3& from : probe.from()) {
    const auto directions = probe.integrals<8>([&](Point2 u, Octants& seen) {
      double solidAngle = 0;
      probe.crossings({from, probe.towards(from, u, solidAngle)}, [&](const SurfacePoint& s) {
        if (sampler.pdf(from, s.p, s.n) > 0) seen[octant(s.p)] += solidAngle;
      });
    });
    const auto samples = probe.integrals<8>([&](Point2 u, Octants& seen) {
      const AreaSample s = sampler.sample(from, u);
      if (s.pdf > 0) seen[octant(s.p)] += 1.0 / s.pdf;
    });
    for (unsigned k = 0; k < 8; ++k)
      judge.expect(
          near(samples[k].mean(), directions[k].mean(),
               samples[k].variance() + directions[k].variance()),
          "seen from {} the part {} x, {} y, {} z of the middle fills {:.6g} +- {:.2g} sr, "
          "but by sample() and its densities {:.6g} +- {:.2g}",
          show(from), k & 1U ? "above" : "below", k & 2U ? "above" : "below",
          k & 4U ? "above" : "below", directions[k].mean(), directions[k].error(),
          samples[k].mean(), samples[k].error());
  }
}

void whatIsHitMayBeHit(AreaProbe& probe, Judge& judge) {
  for (int i = 0; i < ShapeProbe::kHits; ++i) {
    const ObjectRay r = probe.ray();
    judge.expect(!probe.nearest(r) || probe.sampler().mayHit(r.o, r.d),
                 "mayHit() says no, but it is hit: {}", show(r));
  }
}

constexpr Law kLaws[] = {
    {"area-is-how-often-lines-cross", "area() is the area of the surface.",
     sampled<areaIsHowOftenLinesCross>},
    {"samples-lie-on-the-surface",
     "sample() chooses points of the surface, with the density that pdf() tells of them.",
     sampled<samplesLieOnTheSurface>},
    {"density-integrates-to-one", "pdf() is the density of sample() per solid angle.",
     sampled<densityIntegratesToOne>},
    {"samples-follow-their-density", "sample() chooses as often as pdf() tells, everywhere.",
     sampled<samplesFollowTheirDensity>},
    {"what-is-hit-may-be-hit", "mayHit() is true for every ray that meets the surface.",
     sampled<whatIsHitMayBeHit>},
};

}  // namespace

std::span<const Law> shapeAreaLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
