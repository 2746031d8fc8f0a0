#include "shapes/metaballs/atoms.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/parallel.h"

namespace pbrt::metaballs {

float largestRadius(const AtomValues& values) {
  float largest = 0;
  for (std::size_t i = 0; i < values.centres.size(); ++i)
    largest = std::max(largest, pick(values.radii, i));
  return largest;
}

double defaultThreshold(Kernel kernel, float largestRadius) {
  return kernel == Kernel::poly6 && largestRadius > 0
             ? 0.5 / std::pow(static_cast<double>(largestRadius), 3)
             : 0.5;
}

Atoms makeAtoms(const AtomValues& values,
                const std::function<void(const char*, const std::string&)>& fail) {
  const std::vector<Point3>& centres = values.centres;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto check = [&](bool good, const char* parameter, float value, std::string_view rule) {
      if (!good)
        fail(parameter,
             fmt::format("atom {} (the first is 0): {} is {}, but {}", i, parameter, value, rule));
    };
    const Point3& c = centres[i];
    const float radius = pick(values.radii, i), strength = pick(values.strengths, i);
    for (int k = 0; k < 3; ++k) check(std::isfinite(c[k]), "P", c[k], "a centre must be finite");
    check(std::isfinite(radius) && radius > 0, "radius", radius,
          "a support radius must be finite and greater than 0: a field over no space has no "
          "surface");
    check(radius > 1e-15F && radius < 1e15F, "radius", radius,
          "it must lie between 1e-15 and 1e15: scale the scene");
    check(std::isfinite(strength), "strength", strength, "a strength must be finite");
  }
  if (!std::isfinite(values.threshold) || values.threshold <= 0)
    fail("threshold", fmt::format("the threshold is {}, but it must be finite and greater "
                                  "than 0: the field is 0 away from all atoms, so the inside "
                                  "would have no end",
                                  values.threshold));

  Atoms made;
  made.atoms.reserve(centres.size());
  made.numbers.reserve(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const float h = pick(values.radii, i), strength = pick(values.strengths, i);
    if (strength == 0) continue;
    const double weight = strength * scale(values.kernel, h) / values.threshold;
    if (!(std::abs(weight) < 1e30))
      fail("strength", fmt::format("atom {} (the first is 0): its field is {:.0e} times the "
                                   "threshold, but 1e30 is the most",
                                   i, std::abs(weight)));
    made.atoms.emplace_back(centres[i], h, weight);
    made.numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return made;
}

float typicalParticleRadius(const std::vector<Point3>& positions) {
  constexpr std::size_t most = 64;
  const std::size_t samples = std::min(most, positions.size());
  std::vector<float> nearest(samples, kInfinity);
  parallelFor(samples, [&](std::size_t i) {
    const Point3 p = positions[i * positions.size() / samples];
    for (const Point3& other : positions) {
      const float d = lengthSquared(other - p);
      nearest[i] = d > 0 ? std::min(nearest[i], d) : nearest[i];
    }
  });
  std::ranges::nth_element(nearest, nearest.begin() + samples / 2);
  const float d = std::sqrt(nearest[samples / 2]);
  return d < kInfinity ? 0.5F * d : 0;
}

}  // namespace pbrt::metaballs
