#pragma once
// What the tests of lights shine from.

#include "core/base/rng.h"
#include "tests/support.h"
#include "tools/laws/disk.h"

namespace pbrt::test {

using laws::DiskSampler;

// Irradiance of a surface element at p with normal n, nothing in between, by n samples.
inline Spectrum irradiance(const Light& light, const Point3& p, const Normal3& n, int samples = 1) {
  Rng rng(1);
  Spectrum E(0);
  for (int i = 0; i < samples; ++i) {
    const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
    if (s.pdf > 0) E += s.L * (std::max(0.F, glm::dot(s.wi, n)) / s.pdf / samples);
  }
  return E;
}

// The flux through a sphere around the origin, whose centre is not where the light is.
inline double flux(const Light& light, float radius) {
  constexpr int n = 300;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 w = uniformSphere({(i + 0.5F) / n, (j + 0.5F) / n});
      sum += irradiance(light, radius * w, -w).x;
    }
  return sum * 4 * std::numbers::pi * radius * radius / (n * n);
}

}  // namespace pbrt::test
