// The laws of every shape that can be an area light: what AreaSampler promises.

#include "tests/mean.h"
#include "tests/shapes/conformance.h"

namespace pbrt {
namespace {

using test::Mean;

// Five standard deviations: a right program fails one run in two million.
void expectNear(double estimate, double expected, double variance, const char* what) {
  EXPECT_NEAR(estimate, expected, 5 * std::sqrt(variance) + 1e-6 * expected) << what;
}

class Emitters : public test::Shapes {
 protected:
  void SetUp() override {
    Shapes::SetUp();
    if (!shape_) return;
    sampler_ = shape_->areaSampler();
    // Oblique to every axis: near the plane of a flat light densities have wild tails.
    for (const double radii : {100.0, 3.0, -1.05, 0.4, -0.2})
      from_.push_back(centre_ + radii * size_ * DVec3(0.48, 0.6, 0.64));
  }
  // A direction out of all that may meet the shape, and one over its density.
  DVec3 towards(const DPoint3& from, Point2 u, double& solidAngle) {
    const DVec3 axis = centre_ - from;
    if (glm::length(axis) <= size_) {
      solidAngle = 4 * std::numbers::pi;
      return uniformSphere(u);
    }
    const float cone = sphereConeHeight(axis, size_);
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
        for (int j = 0; j < grid; ++j)
          f((Point2(i, j) + Point2(rng_.uniform(), rng_.uniform())) / float{grid}, sums);
      for (std::size_t i = 0; i < N; ++i) means[i].add(sums[i] / (grid * grid));
    }
    return means;
  }
  template <class F>
  Mean integral(F f) {
    return integrals<1>([&](Point2 u, std::array<double, 1>& sum) { sum[0] += f(u); })[0];
  }

  const AreaSampler* sampler_ = nullptr;
  std::vector<DPoint3> from_;
};

// Lines through a ball of radius R, uniform in direction and place, cross a surface of area A on
// average A / (2 pi R^2) times (Crofton).
TEST_P(Emitters, AreaIsHowOftenRandomLinesCross) {
  Mean crossed;
  const double disk = std::numbers::pi * size_ * size_;
  for (int i = 0; i < 200000; ++i) {
    const Frame frame = Frame::fromZ(uniformSphere({rng_.uniform(), rng_.uniform()}));
    const Point2 d = concentricDisk({rng_.uniform(), rng_.uniform()});
    const DVec3 z(frame.z), aside = DVec3(frame.fromLocal({d.x, d.y, 0}));
    int count = 0;
    crossings({centre_ + size_ * (aside - 1.1 * z), z}, [&](const SurfacePoint&) { ++count; });
    crossed.add(count);
  }
  expectNear(2 * disk * crossed.mean(), sampler_->area(), sqr(2 * disk) * crossed.variance(),
             "area");
}

TEST_P(Emitters, SamplesLieOnTheSurfaceWithTheDensityTheyTell) {
  for (const DPoint3& from : from_)
    for (int i = 0; i < 1000; ++i) {
      const AreaSample s = sampler_->sample(from, {rng_.uniform(), rng_.uniform()});
      ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf >= 0);
      if (s.pdf == 0) continue;
      EXPECT_NEAR(sampler_->pdf(from, s.p, s.n), s.pdf, 1e-4F * s.pdf);
      const double h = 1e-5 * size_;
      const DVec3 n(s.n);
      EXPECT_TRUE(nearest({s.p + h * n, -n, 0.999 * h - s.error, 1.001 * h + s.error}));
    }
}

// The density of sample(), over all directions that meet the surface, integrates to the share of
// draws that give a sample.
TEST_P(Emitters, DensityIntegratesToTheShareOfSamples) {
  for (const DPoint3& from : from_) {
    const Mean density = integral([&](Point2 u) {
      double solidAngle = 0, sum = 0;
      crossings({from, towards(from, u, solidAngle)},
                [&](const SurfacePoint& s) { sum += sampler_->pdf(from, s.p, s.n); });
      return sum * solidAngle;
    });
    const Mean share =
        integral([&](Point2 u) { return sampler_->sample(from, u).pdf > 0 ? 1 : 0; });
    expectNear(density.mean(), share.mean(), density.variance() + share.variance(), "density");
  }
}

// Each eighth of the shape fills as much of the view by samples as by directions. This holds only
// if sample() has the density that pdf() tells, everywhere.
TEST_P(Emitters, SamplesAndDirectionsSeeTheSame) {
  using Octants = std::array<double, 8>;
  const auto octant = [&](const DPoint3& p) {
    return (p.x > centre_.x ? 1U : 0U) | (p.y > centre_.y ? 2U : 0U) | (p.z > centre_.z ? 4U : 0U);
  };
  for (const DPoint3& from : from_) {
    const auto directions = integrals<8>([&](Point2 u, Octants& seen) {
      double solidAngle = 0;
      crossings({from, towards(from, u, solidAngle)}, [&](const SurfacePoint& s) {
        if (sampler_->pdf(from, s.p, s.n) > 0) seen[octant(s.p)] += solidAngle;
      });
    });
    const auto samples = integrals<8>([&](Point2 u, Octants& seen) {
      const AreaSample s = sampler_->sample(from, u);
      if (s.pdf > 0) seen[octant(s.p)] += 1.0 / s.pdf;
    });
    for (unsigned k = 0; k < 8; ++k)
      expectNear(samples[k].mean(), directions[k].mean(),
                 samples[k].variance() + directions[k].variance(), "solid angle");
  }
}

TEST_P(Emitters, WhatIsHitMayBeHit) {
  for (int i = 0; i < 5000; ++i) {
    const ObjectRay r = ray();
    EXPECT_TRUE(!nearest(r) || sampler_->mayHit(r.o, r.d));
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Emitters, testing::ValuesIn(test::casesWhere([](Shape& s) {
                           return s.areaSampler();
                         })),
                         test::caseName);

}  // namespace
}  // namespace pbrt
