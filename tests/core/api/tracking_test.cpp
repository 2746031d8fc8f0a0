// What rays cost, and what is left of their arithmetic, in media at the ends of the floats.

#include "core/api/tracking.h"

#include "tests/support.h"

namespace pbrt {
namespace {

// One cell that counts how often it is looked at; its density goes from 1/2 to 1 along x.
class Counting final : public Medium {
 public:
  Counting(const Spectrum& absorption, bool uniform = false)
      : Medium({}, 0, DPoint3(0), DPoint3(1)), absorption_(absorption), uniform_(uniform) {
    setCells({1, 1, 1}, {{absorption, uniform}}, false);
  }
  mutable int looks = 0;

 private:
  MediumPoint properties(const DPoint3& p) const override {
    ++looks;
    const double density = uniform_ ? 1 : 0.5 + 0.5 * p.x;
    return {static_cast<float>(density) * absorption_, Spectrum(0), Spectrum(0)};
  }

  Spectrum absorption_;
  bool uniform_;
};

constexpr DPoint3 kStart{-1, 0.5, 0.5};
constexpr DVec3 kAlongX{1, 0, 0};
constexpr float kNothing = std::numeric_limits<float>::min();

// Where red is opaque, nobody looks at each of its millions of collisions for green and blue.
TEST(Tracking, OpaqueChannelsDoNotStopTheOthers) {
  const Counting medium({1e6F, 0, 0});
  std::array<MediumWalk, 1> room;
  MediaWalk walk(room);
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    walk.start(&medium, {}, kStart, kAlongX, {0, 3});
    const Spectrum T = estimateTransmittance(walk, rng);
    EXPECT_LT(T.x, kNothing);
    EXPECT_EQ(T.y, 1);
    EXPECT_EQ(T.z, 1);
    walk.start(&medium, {}, kStart, kAlongX, {0, 3});
    Spectrum throughput(1), L(0);
    const auto collision = collide(walk, rng.uniform(), rng, throughput, L);
    EXPECT_LT(throughput.x, kNothing);
    EXPECT_EQ(throughput.y, collision ? 0 : throughput.z);
  }
  EXPECT_LT(medium.looks, 100 * 1000);
}

// Nor where it is a medium denser than any that may vary that makes it so.
TEST(Tracking, OpaqueMediaMayOverlapThoseThatVary) {
  for (const float dense : {1e10F, 1e30F}) {
    const Counting opaque({dense, 0, 0}, true), varies(Spectrum(1));
    const std::array<const Medium*, 2> regions = {&opaque, &varies};
    std::array<MediumWalk, 3> room;
    MediaWalk walk(room);
    Rng rng(2);
    for (int i = 0; i < 100; ++i) {
      walk.start(nullptr, regions, kStart, kAlongX, {0, 3});
      EXPECT_LT(estimateTransmittance(walk, rng).x, kNothing);
      walk.start(nullptr, regions, kStart, kAlongX, {0, 3});
      Spectrum throughput(1), L(0);
      collide(walk, rng.uniform(), rng, throughput, L);
      EXPECT_LT(throughput.x, kNothing);
    }
    EXPECT_LT(opaque.looks, 100 * 1000) << dense;
  }
}

// Its densities are below the normal floats, its weights above the greatest.
TEST(Tracking, TheThinnestMediaHaveFiniteWeights) {
  const auto medium = test::make<Medium>(
      "homogeneous", {test::rgb("sigma_a", 1e-39F, 0, 0), test::rgb("sigma_s", 2e-39F, 1e-39F, 0)});
  std::array<MediumWalk, 1> room;
  MediaWalk walk(room);
  Rng rng(3);
  for (int i = 0; i < 1000; ++i) {
    walk.start(medium.get(), {}, kStart, kAlongX, {0, std::numeric_limits<double>::infinity()});
    Spectrum throughput(1), L(0);
    collide(walk, rng.uniform(), rng, throughput, L);
    for (int c = 0; c < 3; ++c) {
      ASSERT_TRUE(std::isfinite(throughput[c]));
      ASSERT_LE(throughput[c], 3.001F);
    }
  }
}

}  // namespace
}  // namespace pbrt
