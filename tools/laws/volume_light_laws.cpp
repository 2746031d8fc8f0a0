// The laws of every volume: how light fares in it, against quadrature in double.

#include "core/api/tracking.h"
#include "mean.h"
#include "volume_laws.h"

namespace pbrt::laws {
namespace {

// What happens to light that comes along a way to its start.
struct Theory {
  DVec3 transmittance{1}, scattered{0}, emitted{0};  // exp(-tau); of sigma_s and of Le behind it
};

Theory theory(const Medium& medium, const Way& way) {
  constexpr int steps = 20000;
  Theory t;
  const double h = way.length / steps;
  for (int i = 0; i < steps; ++i) {
    const MediumPoint m = medium.at(way.at((i + 0.5) * h));
    const DVec3 before = t.transmittance;
    t.transmittance *= glm::exp(-DVec3(m.extinction()) * h);
    const DVec3 between = 0.5 * (before + t.transmittance);
    t.scattered += between * DVec3(m.scattering) * h;
    t.emitted += between * DVec3(m.emission) * h;
  }
  return t;
}

constexpr int kWalks = 5000;
using Means = std::array<Mean, 3>;

void expectMeans(Judge& judge, const Means& means, const DVec3& expected, const char* what,
                 const Way& way) {
  constexpr double sigmas = 4.5;
  for (int c = 0; c < 3; ++c) {
    // What is rare may not have been seen at all, so that its spread is not known from the walks:
    // of weights up to 3 the variance is at most 3 times the mean.
    const double rare = expected[c] < 1e-3 ? std::sqrt(3 * expected[c] / kWalks) : 0;
    judge.expect(std::abs(means[c].mean() - expected[c]) <=
                     sigmas * std::max(means[c].error(), rare) + 2e-4 * expected[c] + 1e-6,
                 "{} of length {}, channel {}: {} is {} +- {} by random walks, {} by quadrature. "
                 "Perhaps a majorant is too low, or a cell is not uniform",
                 show(way), way.length, c, what, means[c].mean(), means[c].error(), expected[c]);
  }
}

}  // namespace

void estimatesAgreeWithQuadrature(const Subject& subject, Judge& judge) {
  const PlacedMedium placed(subject);
  const Medium& medium = *placed.medium;
  Rng rng(3);
  MediumWalk room;
  MediaWalk walk({&room, 1});
  for (int k = 0; k < 4; ++k) {
    const Way way = somewhere(placed, rng);
    const Theory expected = theory(medium, way);
    Means through, ratio, scattered, emitted;
    for (int i = 0; i < kWalks; ++i) {
      walk.start(&medium, {}, way.o, way.w, {0, way.length});
      const Spectrum T = estimateTransmittance(walk, rng);
      walk.start(&medium, {}, way.o, way.w, {0, way.length});
      Spectrum throughput(1), L(0);
      const bool collided = collide(walk, rng.uniform(), rng, throughput, L).has_value();
      for (int c = 0; c < 3; ++c) {
        if (!judge.expect(T[c] >= 0 && T[c] <= 1, "{}: a walk finds the transmittance {}",
                          show(way), T[c]) ||
            !judge.expect(throughput[c] >= 0 && std::isfinite(throughput[c]),
                          "{}: a walk ends with the throughput {}", show(way), throughput[c]))
          return;
        ratio[c].add(T[c]);
        through[c].add(collided ? 0 : throughput[c]);
        scattered[c].add(collided ? throughput[c] : 0);
        emitted[c].add(L[c]);
      }
    }
    expectMeans(judge, ratio, expected.transmittance, "the transmittance", way);
    expectMeans(judge, through, expected.transmittance, "what comes through", way);
    expectMeans(judge, scattered, expected.scattered, "what is scattered", way);
    expectMeans(judge, emitted, expected.emitted, "what is emitted", way);
  }
}

// Of two media in one place, and of the parts of a way.
void transmittanceMultiplies(const Subject& subject, Judge& judge) {
  const PlacedMedium placed(subject);
  const PlacedMedium moved(subject, Transform::translate({0.5, 0.2, 0.4}) * mediumPlace());
  const std::array<const Medium*, 2> regions = {placed.medium.get(), moved.medium.get()};
  Rng rng(4);
  std::array<MediumWalk, 3> room;
  MediaWalk walk(room);
  for (int k = 0; k < 2; ++k) {
    const Way way = somewhere(placed, rng);
    const double cut = way.length * rng.uniform();
    const DVec3 expected =
        theory(*regions[0], way).transmittance * theory(*regions[1], way).transmittance;
    Means whole, parts, through;
    for (int i = 0; i < kWalks; ++i) {
      const auto T = [&](double begin, double end) {
        walk.start(nullptr, regions, way.o, way.w, {begin, end});
        return estimateTransmittance(walk, rng);
      };
      const Spectrum a = T(0, way.length), b = T(0, cut) * T(cut, way.length);
      walk.start(nullptr, regions, way.o, way.w, {0, way.length});
      Spectrum throughput(1), L(0);
      const bool collided = collide(walk, rng.uniform(), rng, throughput, L).has_value();
      for (int c = 0; c < 3; ++c) {
        whole[c].add(a[c]);
        parts[c].add(b[c]);
        through[c].add(collided ? 0 : throughput[c]);
      }
    }
    expectMeans(judge, whole, expected, "the transmittance of two that overlap", way);
    expectMeans(judge, parts, expected, "that of two parts of the way", way);
    expectMeans(judge, through, expected, "what comes through two that overlap", way);
  }
}

}  // namespace pbrt::laws
