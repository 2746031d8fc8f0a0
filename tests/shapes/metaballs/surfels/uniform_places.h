#pragma once
// Places on the surface of metaballs, for measures of coverage.

#include "core/base/rng.h"
#include "shapes/metaballs/area.h"
#include "shapes/metaballs/surfels/coverage.h"

namespace pbrt::surfels::test {

// At most `count`, weighted so that each part of the surface counts as its area does.
inline std::vector<Place> uniformPlaces(const metaballs::Field& field, std::size_t count,
                                        std::uint64_t seed = 0) {
  const metaballs::Cells cells(field);
  const metaballs::PatchSampler sampler(field, cells);
  Rng rng(seed);
  std::vector<Place> places;
  for (std::size_t i = 0; i < count; ++i) {
    const AreaSample s = sampler.sample(DPoint3(0), {rng.uniform(), rng.uniform()});
    if (s.pdf == 0) continue;
    // From a distance of one along the normal, the density by solid angle is that by area.
    const float density = sampler.pdf(s.p + DVec3(s.n), s.p, s.n);
    if (density > 0) places.push_back({s.p, s.n, 1.0 / density});
  }
  return places;
}

}  // namespace pbrt::surfels::test
