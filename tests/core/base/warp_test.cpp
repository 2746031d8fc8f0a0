// Each warp must fill its set, stay inside it, and have the density that it claims.

#include "core/base/warp.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/chi_square.h"

namespace pbrt {
namespace {

constexpr int kSamples = 400000;
constexpr int kCells = 16;

// Maps each warped sample to [0, 1]^2 by `flatten`, under which the claimed density is uniform,
// and tests that.
template <class Warp, class Flatten>
double deviation(Warp warp, Flatten flatten) {
  Rng rng(1);
  std::vector<double> counts(kCells * kCells);
  for (int i = 0; i < kSamples; ++i) {
    const float u = rng.uniform();
    const auto [a, b] = flatten(warp(Point2(u, rng.uniform())));
    const auto cell = [](double x) {
      return std::clamp(static_cast<int>(x * kCells), 0, kCells - 1);
    };
    counts[static_cast<std::size_t>(cell(a) * kCells + cell(b))] += 1;
  }
  return test::uniformDeviation(counts);
}

double turn(double y, double x) {
  return std::atan2(y, x) / (2 * std::numbers::pi) + 0.5;
}

// The corners and edges of the square, as far as samples reach, and its middle lines.
std::vector<Point2> extremes() {
  std::vector<Point2> points;
  for (const float x : {0.F, 1e-30F, 0.25F, 0.5F, 0.75F, kOneMinusEpsilon})
    for (const float y : {0.F, 1e-30F, 0.25F, 0.5F, 0.75F, kOneMinusEpsilon})
      points.emplace_back(x, y);
  return points;
}

TEST(ConcentricDisk, KeepsArea) {
  // The area within radius r is r^2 of the whole.
  EXPECT_LT(deviation(concentricDisk,
                      [](Point2 p) {
                        return std::pair<double, double>(lengthSquared(p), turn(p.y, p.x));
                      }),
            4);
}

TEST(ConcentricDisk, StaysInTheDiskAndReachesItsRim) {
  for (const Point2 u : extremes()) {
    const float r = glm::length(concentricDisk(u));
    EXPECT_LE(r, 1 + 1e-6F);
    // A square about the middle becomes a circle about the middle.
    EXPECT_NEAR(r, std::max(std::abs(2 * u.x - 1), std::abs(2 * u.y - 1)), 1e-6F);
  }
}

TEST(CosHemisphere, HasItsDensity) {
  // P(cos > c) = integral of (cos / pi) 2 pi sin = 1 - c^2.
  EXPECT_LT(deviation(cosHemisphere,
                      [](const Vec3& w) {
                        return std::pair<double, double>(double{w.z} * w.z, turn(w.y, w.x));
                      }),
            4);
}

TEST(CosHemisphere, PdfIntegratesToOne) {
  double sum = 0;
  const int n = 1000;
  for (int i = 0; i < n; ++i)
    sum += 2 * std::numbers::pi * cosHemispherePdf((static_cast<float>(i) + 0.5F) / n) / n;
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(CosHemisphere, IsUnitAndAbove) {
  for (const Point2 u : extremes()) {
    const Vec3 w = cosHemisphere(u);
    EXPECT_NEAR(glm::length(w), 1, 1e-6F);
    EXPECT_GE(w.z, 0);
  }
}

TEST(UniformSphere, IsUniform) {
  // Archimedes: equal heights have equal areas.
  EXPECT_LT(deviation(uniformSphere,
                      [](const Vec3& w) {
                        return std::pair<double, double>(0.5 * w.z + 0.5, turn(w.y, w.x));
                      }),
            4);
}

TEST(UniformSphere, IsUnit) {
  for (const Point2 u : extremes()) EXPECT_NEAR(glm::length(uniformSphere(u)), 1, 1e-6F);
}

TEST(UniformTriangle, IsUniform) {
  // A uniform point of the triangle b0, b1 >= 0, b0 + b1 <= 1, mirrored at its long side for
  // every other sample, is uniform in the square.
  bool mirror = false;
  EXPECT_LT(deviation(uniformTriangle,
                      [&](Point2 b) {
                        mirror = !mirror;
                        return mirror ? std::pair<double, double>(1.0 - b.x, 1.0 - b.y)
                                      : std::pair<double, double>(b.x, b.y);
                      }),
            4);
}

TEST(UniformTriangle, StaysInTheTriangle) {
  for (const Point2 u : extremes()) {
    const Point2 b = uniformTriangle(u);
    EXPECT_GE(b.x, 0);
    EXPECT_GE(b.y, 0);
    EXPECT_GE(1 - b.x - b.y, -1e-7F);
  }
}

}  // namespace
}  // namespace pbrt
