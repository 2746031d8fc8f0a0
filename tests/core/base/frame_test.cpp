#include "core/base/frame.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/warp.h"

namespace pbrt {
namespace {

Vec3 direction(Rng& rng) {
  const float u = rng.uniform();
  return glm::normalize(uniformSphere({u, rng.uniform()}));
}

void expectOrthonormal(const Frame& f) {
  const float tolerance = 3e-5F;
  EXPECT_NEAR(glm::length(f.x), 1, tolerance);
  EXPECT_NEAR(glm::length(f.y), 1, tolerance);
  EXPECT_NEAR(glm::dot(f.x, f.y), 0, tolerance);
  EXPECT_NEAR(glm::dot(f.y, f.z), 0, tolerance);
  EXPECT_NEAR(glm::dot(f.z, f.x), 0, tolerance);
  EXPECT_NEAR(glm::dot(glm::cross(f.x, f.y), f.z), 1, tolerance);  // right-handed
}

std::vector<Vec3> directions() {
  std::vector<Vec3> all{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  all.emplace_back(1, 0, -0.F);
  for (const float s : {1e-3F, 1e-4F, 1e-20F}) all.push_back(glm::normalize(Vec3(s, -s, -1)));
  Rng rng(2);
  for (int i = 0; i < 10000; ++i) all.push_back(direction(rng));
  return all;
}

TEST(Frame, FromZIsOrthonormal) {
  for (const Vec3& z : directions()) {
    const Frame f = Frame::fromZ(z);
    EXPECT_EQ(f.z, z);
    expectOrthonormal(f);
  }
}

TEST(Frame, FromZXIsOrthonormalAndLeansTowardsTheTangent) {
  Rng rng(4);
  for (const Vec3& z : directions()) {
    const Vec3 tangent = direction(rng) * std::exp(20 * rng.uniform() - 10);
    const Frame f = Frame::fromZX(z, tangent);
    EXPECT_EQ(f.z, z);
    expectOrthonormal(f);
    // The tangent lies in the plane of x and z, on the side of x.
    const Vec3 t = glm::normalize(tangent);
    if (glm::length(glm::cross(z, t)) < 0.05F) continue;
    EXPECT_GT(glm::dot(f.x, t), 0);
    EXPECT_NEAR(glm::dot(f.y, t), 0, 1e-5F);
  }
}

TEST(Frame, AnyTangentGivesAFrame) {
  Rng rng(6);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 1000; ++i) {
    const Vec3 z = direction(rng);
    for (const Vec3& tangent : {Vec3(0), z, -1e10F * z, Vec3(nan), Vec3(kInfinity, 0, 0),
                                Vec3(3e38F, 3e38F, 0), Vec3(1e-38F, 0, 0)})
      expectOrthonormal(Frame::fromZX(z, tangent));
    // Ever closer to z.
    for (float s = 1; s > 1e-9F; s *= 0.3F)
      expectOrthonormal(Frame::fromZX(z, z + s * direction(rng)));
  }
}

TEST(Frame, LocalAndBackIsTheSame) {
  Rng rng(8);
  for (int i = 0; i < 1000; ++i) {
    const Frame f = Frame::fromZ(direction(rng));
    const Vec3 v = direction(rng);
    EXPECT_LT(glm::length(f.fromLocal(f.toLocal(v)) - v), 1e-6F);
    EXPECT_NEAR(glm::length(f.toLocal(f.z) - Vec3(0, 0, 1)), 0, 1e-6F);
  }
}

TEST(Frame, Trigonometry) {
  Rng rng(10);
  for (int i = 0; i < 100; ++i) {
    const Vec3 w = direction(rng);
    EXPECT_NEAR(sin2Theta(w), w.x * w.x + w.y * w.y, 1e-6F);
    EXPECT_NEAR(cos2Theta(w) + sin2Theta(w), 1, 1e-6F);
    EXPECT_EQ(absCosTheta(w), std::abs(cosTheta(w)));
    EXPECT_TRUE(sameHemisphere(w, w));
    EXPECT_FALSE(sameHemisphere(w, -w));
  }
  EXPECT_EQ(sin2Theta({0, 0, 1.0000001F}), 0);
}

}  // namespace
}  // namespace pbrt
