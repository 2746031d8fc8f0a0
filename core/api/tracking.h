#pragma once
// Light on its way through media: what is left of it, and where it is scattered. Unbiased wherever
// the random numbers are.

#include <bit>

#include "core/api/medium_walk.h"
#include "core/base/rng.h"

namespace pbrt {

// Where a ray was scattered.
struct Collision {
  double t = 0;  // distance
  float g = 0;   // of the phase function
};

// Of its origin and direction, to draw other numbers for each ray than for all others.
inline std::uint64_t hashOf(const Ray& ray) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return hash(bits(ray.o.x), bits(ray.o.y), bits(ray.o.z), bits(ray.d.x), bits(ray.d.y),
              bits(ray.d.z));
}

// exp(-sigma length), without 0 times infinity.
inline Spectrum attenuation(const Spectrum& sigma, double length) {
  Spectrum T(1);
  for (int c = 0; c < 3; ++c)
    if (sigma[c] > 0) T[c] = static_cast<float>(std::exp(-double{sigma[c]} * length));
  return T;
}

// The integral of exp(-sigma t) over 0 <= t <= length.
inline Spectrum reach(const Spectrum& sigma, double length) {
  Spectrum r(static_cast<float>(length));
  for (int c = 0; c < 3; ++c)
    if (const double s = sigma[c]; s > 0) r[c] = static_cast<float>(-std::expm1(-s * length) / s);
  return r;
}

// The distance to the next collision in a medium of extinction sigma, uniform u in [0, 1). If sigma
// is 0 it is infinite, or not a number.
inline double freeFlight(float sigma, float u) {
  return -std::log1p(-double{u}) / sigma;
}

// The greatest of the majorants in channels that light is left in. Free flights have no memory, so
// it may be another one after each collision: else an opaque channel, in which nothing is left,
// would go on to stop the others. What is below the normal floats is nothing, as it need not ever
// be rounded to 0.
inline float majorantFor(const Spectrum& majorant, const Spectrum& light) {
  float most = 0;
  for (int c = 0; c < 3; ++c)
    if (light[c] >= std::numeric_limits<float>::min()) most = std::max(most, majorant[c]);
  return most;
}

// Goes along a walk, from its start, until the ray is scattered; empty: it comes through. The
// throughput takes what absorption and the chances make of it, and L what the medium emits.
// `first` is a random number, best of a sampler; what more it takes comes from rng.
//
// Free paths are drawn for one channel of the spectrum, chosen by what the throughput has of each;
// the densities of all are added (balance heuristic, Veach 1997, section 9.2.2), so that no weight
// exceeds the sum of the channels. In a uniform stretch the densities are known. Elsewhere
// collisions are drawn at the rate of the majorant, and the chance that one is real is treated in
// the same way (delta tracking, Woodcock et al. 1965; for spectra Kutz et al. 2017, section 4).
inline std::optional<Collision> collide(MediaWalk& walk, float first, Rng& rng,
                                        Spectrum& throughput, Spectrum& L) {
  float u = first;
  const auto shares = [&] { return throughput / (throughput.x + throughput.y + throughput.z); };
  const auto gain = [&](const Spectrum& emission, const Spectrum& length) {
    for (int c = 0; c < 3; ++c)
      if (emission[c] > 0 && throughput[c] > 0) L[c] += throughput[c] * emission[c] * length[c];
  };
  // `weight` is that of a unit of scattering; it may be too great for floats.
  const auto scatterAt = [&](double t, const DVec3& weight) {
    const MediaWalk::Scattering s = walk.scattering(t, rng.uniform());
    throughput *= Spectrum(weight * DVec3(s.scattering));
    return Collision{t, s.g};
  };
  while (!isBlack(throughput) && walk.next()) {
    const Stretch& stretch = walk.stretch();
    if (stretch.uniform) {
      const MediumPoint m = walk.at(std::isfinite(stretch.end) ? stretch.middle() : stretch.begin);
      const Spectrum sigma = m.extinction();
      gain(m.emission, reach(sigma, stretch.length()));
      if (isBlack(sigma)) continue;
      const Spectrum share = shares();
      const float which = rng.uniform();
      const int channel = which < share.x ? 0 : which < share.x + share.y ? 1 : 2;
      const double flight = sigma[channel] > 0 ? freeFlight(sigma[channel], u) : stretch.length();
      u = rng.uniform();
      const bool collides = flight < stretch.length();
      const Spectrum T = attenuation(sigma, collides ? flight : stretch.length());
      const DVec3 left(T);
      const double density = glm::dot(DVec3(share), collides ? DVec3(sigma) * left : left);
      if (!(density > 0)) {
        throughput = Spectrum(0);
        return {};
      }
      if (collides) return scatterAt(stretch.begin + flight, left / density);
      throughput *= Spectrum(left / density);
    } else {
      double t = stretch.begin;
      for (;; u = rng.uniform()) {
        const float majorant = majorantFor(stretch.majorant, throughput);
        t += freeFlight(majorant, u);
        if (!(t < stretch.end)) break;
        const MediumPoint m = walk.at(t);
        gain(m.emission, Spectrum(1 / majorant));
        const Spectrum real = glm::min(m.extinction() / majorant, Spectrum(1));
        const float chance = glm::dot(shares(), real);
        if (rng.uniform() < chance) return scatterAt(t, DVec3(1 / (double{majorant} * chance)));
        throughput *= (Spectrum(1) - real) / (1 - chance);
      }
      u = rng.uniform();
    }
  }
  return {};
}

// Of light that comes along a walk, from its start, the expected share that comes through: exact
// where media are uniform, elsewhere an estimate (ratio tracking, Novak et al. 2014) with Russian
// roulette.
inline Spectrum estimateTransmittance(MediaWalk& walk, Rng& rng) {
  constexpr float kRouletteBelow = 0.05F, kSurvival = 0.25F;
  Spectrum T(1);
  while (!isBlack(T) && walk.next()) {
    const Stretch& stretch = walk.stretch();
    if (stretch.uniform) {
      T *= attenuation(
          walk.at(std::isfinite(stretch.end) ? stretch.middle() : stretch.begin).extinction(),
          stretch.length());
      continue;
    }
    for (double t = stretch.begin;;) {
      const float majorant = majorantFor(stretch.majorant, T);
      t += freeFlight(majorant, rng.uniform());
      if (!(t < stretch.end)) break;
      T *= glm::max(Spectrum(1) - walk.at(t).extinction() / majorant, Spectrum(0));
      if (std::max({T.x, T.y, T.z}) < kRouletteBelow)
        T = rng.uniform() < kSurvival ? T / kSurvival : Spectrum(0);
    }
  }
  return T;
}

}  // namespace pbrt
