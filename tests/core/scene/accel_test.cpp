// The ray tree: packets say what single rays say, and occlusion what intersection says.

#include "core/scene/accel.h"

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

// Packets are traced another way where there are instances, and by other trees where they move.
enum class Instances { none, resting, moving };

std::unique_ptr<Scene> everything(Instances instances) {
  const std::string text = R"(TransformTimes 0.2 0.9 SurfaceIntegrator "whitted" WorldBegin
    Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
      "point P" [-2 -1 -2  -2 -1 2  2 -1 2  2 -1 -2]
    Shape "sphere" "float radius" 0.5
    TransformBegin Translate 1 0 0 Scale 1 0.4 -0.7 Shape "disk" TransformEnd
    Shape "metaballs" "point P" [-1 1 0  -0.4 1.2 0.1]
    ObjectBegin "o" Shape "sphere" "float radius" 0.4
      Shape "trianglemesh" "point P" [0 0 0  1 0 0  0 1 1]
      ActiveTransform EndTime
      Shape "metaballs" "point P" [-1 0 0  -0.4 0.2 0.1] ObjectEnd
    )";
  const std::string resting = R"(Translate 0 1 0 Rotate 30 1 2 3 ObjectInstance "o"
    Translate -1 0 1 Scale 1 2 0.5 ObjectInstance "o"
    )";
  const std::string moving =
      R"(Translate 0.1 0.3 0 ActiveTransform EndTime Rotate 80 1 1 0 ObjectInstance "o"
    Translate -1 1 1 Scale 1 0.3 1.4 Shape "sphere" "float radius" 0.7
    Shape "trianglemesh" "point P" [0 0 0  -1 0 0  0 1 0.5]
    )";
  return test::buildText(text + (instances == Instances::none ? "" : resting) +
                         (instances == Instances::moving ? moving : "") + "WorldEnd");
}

Ray randomRay(Rng& rng) {
  const Vec3 o = 3.F * uniformSphere({rng.uniform(), rng.uniform()});
  const Vec3 to = 3.F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.5F;
  const float tMax = rng.uniform() < 0.3F ? rng.uniform() : kInfinity;
  return {o, 0, to - o, tMax, rng.uniform()};
}

class Trees : public testing::TestWithParam<Instances> {};

TEST_P(Trees, PacketsOfEverySizeEqualSingleRays) {
  const auto scene = everything(GetParam());
  Rng rng(2);
  int hits = 0, rays = 0;
  for (int round = 0; round < 6000; ++round) {
    const auto n = static_cast<std::size_t>(1 + round % World::kBatch);
    std::vector<Ray> batch;
    for (std::size_t i = 0; i < n; ++i) batch.push_back(randomRay(rng));
    std::vector<const Ray*> pointers;
    for (const Ray& ray : batch) pointers.push_back(&ray);
    std::vector<Hit> found(n);
    scene->intersect(pointers, found);
    const std::uint32_t mask = scene->occluded(batch);
    EXPECT_EQ(mask >> (n - 1) >> 1, 0U) << "no bits of rays that are not there";
    for (std::size_t i = 0; i < n; ++i, ++rays) {
      const Hit one = scene->intersect(batch[i]);
      hits += one.found();
      ASSERT_EQ(found[i].found(), one.found());
      EXPECT_EQ(mask >> i & 1U, one.found());
      EXPECT_EQ(scene->occluded(batch[i]), one.found());
      if (!one.found()) continue;
      EXPECT_NEAR(found[i].t, one.t, 1e-5F * one.t + 3e-7F);
      EXPECT_EQ(found[i].geometry, one.geometry);
      EXPECT_EQ(found[i].instance, one.instance);
      EXPECT_LE(one.t, batch[i].tMax);
    }
  }
  EXPECT_GT(hits, rays / 4);
}

INSTANTIATE_TEST_SUITE_P(Instances, Trees,
                         testing::Values(Instances::none, Instances::resting, Instances::moving));

TEST_P(Trees, SurfacesLieWhereTheirHitsAre) {
  const auto scene = everything(GetParam());
  Rng rng(4);
  for (int i = 0; i < 20000; ++i) {
    const RayDifferential ray(randomRay(rng));
    const Hit hit = scene->intersect(ray);
    if (!hit.found()) continue;
    const SurfaceInteraction s = scene->surface(ray, hit);
    EXPECT_LT(glm::length(s.p - ray.at(hit.t)), 2e-5F);
    EXPECT_NEAR(glm::length(s.n), 1, 1e-6);
    EXPECT_NEAR(glm::length(s.ns), 1, 1e-6);
  }
}

TEST(Accel, CountsRaysOfEveryKind) {
  const auto scene = everything(Instances::resting);
  Rng rng(1);
  Accel::takeRayCount();
  std::array<Ray, 16> rays;
  for (Ray& ray : rays) ray = randomRay(rng);
  std::uint64_t wanted = 0;
  for (std::size_t n = 0; n <= 16; ++n, wanted += n <= 16 ? n : 0)
    scene->occluded(std::span<const Ray>(rays.data(), n));
  EXPECT_EQ(Accel::takeRayCount(), wanted);
  EXPECT_EQ(Accel::takeRayCount(), 0U);
}

TEST(Accel, AnEmptyTreeIsHitByNothing) {
  const AccelDevice device(1);
  Accel accel(device);
  accel.build();
  EXPECT_TRUE(accel.bounds().empty());
  EXPECT_FALSE(accel.intersect(Ray{{}, 0, {0, 0, 1}, kInfinity, 0}).found());
}

}  // namespace
}  // namespace pbrt
