#include "core/base/noise.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

DPoint3 somewhere(Rng& rng, double size) {
  const auto x = [&] { return size * (2 * double{rng.uniform()} - 1); };
  return {x(), x(), x()};
}

TEST(Noise, VanishesAtWholeNumbersAndRepeats) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const DPoint3 p = somewhere(rng, 300);
    EXPECT_EQ(noise(glm::floor(p)), 0);
    EXPECT_NEAR(noise(p), noise(p + DPoint3(256, -512, 1024)), 1e-5);
  }
}

// With two derivatives: differences over the borders of cells are as small as elsewhere.
TEST(Noise, IsSmoothAndBounded) {
  Rng rng(2);
  constexpr double h = 1e-3;
  double sum = 0, absolute = 0;
  for (int i = 0; i < 100000; ++i) {
    DPoint3 p = somewhere(rng, 100);
    if (i % 2) p[i % 3] = std::round(p[i % 3]);  // on a border
    const DVec3 d = i % 3 == 0 ? DVec3(h, 0, 0) : i % 3 == 1 ? DVec3(0, h, 0) : DVec3(0, 0, h);
    const double a = noise(p - d), b = noise(p), c = noise(p + d);
    ASSERT_LE(std::abs(b), 1);
    ASSERT_LT(std::abs(a - c) / (2 * h), 4);
    ASSERT_LT(std::abs(a - 2 * b + c) / (h * h), 60);
    sum += b;
    absolute += std::abs(b);
  }
  EXPECT_NEAR(sum / 100000, 0, 0.01);
  EXPECT_GT(absolute / 100000, 0.1);
}

TEST(Noise, FiniteFarAway) {
  Rng rng(3);
  for (const double size : {1e6, 1e12, 1e20, 1e38})
    for (int i = 0; i < 100; ++i) {
      const float v = noise(somewhere(rng, size));
      ASSERT_TRUE(std::isfinite(v) && std::abs(v) <= 1) << size;
    }
}

TEST(Noise, OctavesAddUp) {
  Rng rng(4);
  for (int i = 0; i < 200; ++i) {
    const DPoint3 p = somewhere(rng, 10);
    double sum = 0, absolute = 0;
    for (int k = 0; k <= 3; ++k) {
      if (k < 3) {
        sum += std::pow(0.6, k) * noise(std::pow(1.99, k) * p);
        absolute += std::pow(0.6, k) * std::abs(noise(std::pow(1.99, k) * p));
      }
    }
    // Without a footprint all octaves are there, and what fades has no share.
    EXPECT_NEAR(fbm(p, DVec3(0), DVec3(0), 0.6F, 3), sum, 1e-5);
    EXPECT_NEAR(turbulence(p, DVec3(0), DVec3(0), 0.6F, 3), absolute + std::pow(0.6, 3) * 0.2,
                1e-5);
  }
}

// What a pixel cannot show is gone: the mean is left.
TEST(Noise, FootprintsFadeOctavesOut) {
  const DPoint3 p(0.3, 0.4, 0.7);
  EXPECT_EQ(fbm(p, {1, 0, 0}, {0, 0, 0}, 0.5F, 8), 0);
  EXPECT_NEAR(turbulence(p, {1, 0, 0}, {0, 0, 0}, 0.5F, 3), 0.2 * (1 + 1 + 0.5 + 0.25), 1e-6);
  // A footprint of 1/8 leaves two octaves: -1 - log2(1/8) = 2.
  EXPECT_NEAR(fbm(p, {0, 0.125, 0}, {0, 0, 0}, 0.5F, 8), noise(p) + 0.5 * noise(1.99 * p), 1e-6);
}

}  // namespace
}  // namespace pbrt
