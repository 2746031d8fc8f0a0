#include "core/base/sampled_spectrum.h"

#include <gtest/gtest.h>

namespace pbrt {
namespace {

TEST(SampledSpectrum, IsLinearBetweenItsSamplesAndConstantBeyond) {
  const SampledSpectrum s(SampledSpectrum::Samples{{500, 1}, {600, 3}, {601, 0}});
  EXPECT_EQ(s.at(1), 1);
  EXPECT_EQ(s.at(500), 1);
  EXPECT_EQ(s.at(525), 1.5);
  EXPECT_EQ(s.at(600), 3);
  EXPECT_EQ(s.at(600.5), 1.5);
  EXPECT_EQ(s.at(601), 0);
  EXPECT_EQ(s.at(1e9), 0);
  EXPECT_EQ(constantSpectrum(2).at(555), 2);
}

TEST(SampledSpectrum, SamplesAFunctionOverTheVisible) {
  const SampledSpectrum s = sampleVisible([](double nm) { return 2 * nm + 1; });
  EXPECT_EQ(s.samples().size(), 95U);
  EXPECT_EQ(s.samples().rbegin()->first, 830);
  EXPECT_NEAR(s.at(533.3), 2 * 533.3 + 1, 1e-9);
}

}  // namespace
}  // namespace pbrt
