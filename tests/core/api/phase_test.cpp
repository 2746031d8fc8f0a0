// The phase function of Henyey and Greenstein against its definition in double.

#include "core/api/phase.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/chi_square.h"

namespace pbrt {
namespace {

constexpr float kG[] = {-0.99F, -0.7F, -0.2F, 0, 0.2F, 0.7F, 0.99F};
constexpr double kPi2 = 2 * std::numbers::pi;

// By the cosine between the direction in which light comes and that in which it goes on.
double exact(double g, double cosine) {
  return (1 - g * g) / (2 * kPi2 * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}
// Its integral over cosines from -1, over the whole circle; 1 at 1.
double cumulative(double g, double cosine) {
  if (g == 0) return (1 + cosine) / 2;
  return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * cosine) - 1 / (1 + g));
}

// In an angle d from the forward or from the backward direction.
TEST(Phase, IsItsFormulaAlsoWhereThatCancels) {
  Rng rng(1);
  for (const float g : kG)
    for (const double d : {0.0, 1e-6, 1e-4, 1e-2, 0.5, 1.5, std::numbers::pi}) {
      const Vec3 wo = uniformSphere({rng.uniform(), rng.uniform()});
      const Frame frame = Frame::fromZ(wo);
      const auto sine = static_cast<float>(std::sin(d)), cosine = static_cast<float>(std::cos(d));
      for (const float side : {1.F, -1.F}) {
        const Vec3 wi = glm::normalize(frame.fromLocal({sine, 0, side * cosine}));
        // Of the directions as they are, in double.
        const double c =
            -glm::dot(DVec3(wo), DVec3(wi)) / glm::length(DVec3(wo)) / glm::length(DVec3(wi));
        EXPECT_NEAR(Phase(g)(wo, wi) / exact(g, c), 1, 1e-3) << g << ' ' << d << ' ' << side;
      }
    }
}

TEST(Phase, SamplesFollowTheirDensity) {
  constexpr int kSamples = 100000, kCells = 40;
  for (const float g : kG) {
    Rng rng(2);
    const Vec3 wo = glm::normalize(Vec3(0.3F, -0.5F, 0.8F));
    const Frame frame = Frame::fromZ(wo);
    std::vector<double> cosines(kCells), azimuths(8);
    double mean = 0;
    for (int i = 0; i < kSamples; ++i) {
      const PhaseSample s = Phase(g).sample(wo, {rng.uniform(), rng.uniform()});
      ASSERT_NEAR(glm::length(s.wi), 1, 1e-5);
      ASSERT_EQ(s.pdf, Phase(g)(wo, s.wi));
      const double forward = lengthSquared(DVec3(wo) - DVec3(s.wi)) / 2 - 1;
      mean += forward / kSamples;
      const double p = std::clamp(cumulative(g, std::clamp(forward, -1.0, 1.0)), 0.0, 1.0 - 1e-9);
      ++cosines[static_cast<std::size_t>(p * kCells)];
      const Vec3 local = frame.toLocal(s.wi);
      ++azimuths[static_cast<std::size_t>((std::atan2(local.y, local.x) / kPi2 + 0.5) * 7.9999)];
    }
    EXPECT_LT(test::uniformDeviation(cosines), 4) << g;
    EXPECT_LT(test::uniformDeviation(azimuths), 4) << g;
    EXPECT_NEAR(mean, g, 4.5 / std::sqrt(kSamples)) << g;
  }
}

TEST(Phase, IsNormalisedAndHasMeanCosineG) {
  for (const float g : kG) {
    constexpr int kSteps = 20000;
    double sum = 0, cosine = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double theta = std::numbers::pi * (i + 0.5) / kSteps;
      const Vec3 wo(0, 0, -1);
      const Vec3 wi(static_cast<float>(std::sin(theta)), 0, static_cast<float>(std::cos(theta)));
      const double f = Phase(g)(wo, wi) * kPi2 * std::sin(theta) * std::numbers::pi / kSteps;
      sum += f;
      cosine += f * std::cos(theta);
    }
    EXPECT_NEAR(sum, 1, 1e-4) << g;
    EXPECT_NEAR(cosine, g, 1e-4) << g;
  }
}

}  // namespace
}  // namespace pbrt
