// Alpha textures: shapes with holes.

#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/scene/scene.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

const std::string kChecks =
    "Texture \"checks\" \"float\" \"checkerboard\" \"string aamode\" \"none\"\n"
    "\"float uscale\" 7 \"float vscale\" 5 \"float tex1\" 1 \"float tex2\" 0\n";

bool isHole(Point2 uv) {
  return (static_cast<int>(std::floor(7 * uv.x)) + static_cast<int>(std::floor(5 * uv.y))) % 2 != 0;
}

std::unique_ptr<Scene> world(const std::string& statements, BuildOptions options = {}) {
  return test::buildText(
      "Integrator \"whitted\" WorldBegin\n" + kChecks + statements + "\nWorldEnd",
      std::move(options));
}

// Every way a shape can get into the ray tree: `{}` is where its parameters go.
const std::vector<std::string> kWays = {
    "Shape \"sphere\" {}",
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 0  1 -1 0  1 1 0\n"
    "-1 1 0] \"float uv\" [0 0 1 0 1 1 0 1] {}",
    "ObjectBegin \"o\" Shape \"sphere\" {} ObjectEnd Rotate 40 1 2 3 ObjectInstance \"o\"",
    "ActiveTransform EndTime Translate 0.4 0 0 Rotate 90 1 2 0 Shape \"sphere\" {}",
    "ActiveTransform EndTime Translate 0.4 0 0 Rotate 90 1 2 0 Shape \"trianglemesh\"\n"
    "\"integer indices\" [0 1 2] \"point P\" [-1 -1 0  1 -1 0  1 1 0]\n"
    "\"float uv\" [0 0 1 0 1 1] {}"};

class Cutouts : public testing::TestWithParam<std::string> {
 protected:
  static std::string way(const std::string& parameters) {
    return fmt::format(fmt::runtime(GetParam()), parameters);
  }
};

INSTANTIATE_TEST_SUITE_P(Ways, Cutouts, testing::ValuesIn(kWays));

Ray randomRay(Rng& rng) {
  const Vec3 o = 3.F * uniformSphere({rng.uniform(), rng.uniform()});
  const Vec3 to = uniformSphere({rng.uniform(), rng.uniform()});
  return {o, 0, to - o, kInfinity, rng.uniform()};
}

// A ray goes through the holes and stops where the whole shape would be.
TEST_P(Cutouts, RaysPassTheHolesAndNothingElse) {
  const auto whole = world(way("")), cut = world(way("\"texture alpha\" \"checks\""));
  Rng rng(1);
  int holes = 0, stops = 0;
  for (int i = 0; i < 20000; ++i) {
    RayDifferential ray(randomRay(rng));
    const Hit got = cut->intersect(ray);
    const bool blocked = cut->occluded(ray);
    EXPECT_EQ(blocked, got.found());
    Hit wanted;
    while ((wanted = whole->intersect(ray)).found()) {
      if (!isHole(whole->surface(ray, wanted).uv)) break;
      ++holes;
      ray.tMin = wanted.t * (1 + 1e-5F);
    }
    ASSERT_EQ(got.found(), wanted.found());
    stops += got.found();
    if (got.found()) {
      EXPECT_NEAR(got.t, wanted.t, 1e-5F * wanted.t);
    }
  }
  EXPECT_GT(holes, 1000);
  EXPECT_GT(stops, 1000);
}

TEST_P(Cutouts, PacketsSeeTheSameHoles) {
  const auto scene = world(way("\"texture alpha\" \"checks\""));
  Rng rng(2);
  for (int round = 0; round < 1000; ++round) {
    const auto n = static_cast<std::size_t>(1 + round % World::kBatch);
    std::vector<Ray> batch;
    for (std::size_t i = 0; i < n; ++i) batch.push_back(randomRay(rng));
    std::vector<const Ray*> pointers;
    for (const Ray& ray : batch) pointers.push_back(&ray);
    std::vector<Hit> found(n);
    scene->intersect(pointers, found);
    const std::uint32_t mask = scene->occluded(batch);
    for (std::size_t i = 0; i < n; ++i) {
      const Hit one = scene->intersect(batch[i]);
      ASSERT_EQ(found[i].found(), one.found());
      EXPECT_EQ(mask >> i & 1U, one.found());
      if (one.found()) {
        EXPECT_NEAR(found[i].t, one.t, 1e-5F * one.t);
      }
    }
  }
}

TEST_P(Cutouts, ShadowAlphaIsForShadowsAlone) {
  const auto scene = world(way("\"float shadowalpha\" 0"));
  Rng rng(3);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = randomRay(rng);
    hits += scene->intersect(ray).found();
    EXPECT_FALSE(scene->occluded(ray));
  }
  EXPECT_GT(hits, 200);
}

TEST_P(Cutouts, AConstantIsAllOrNothingAsInV3) {
  const auto none = world(way("\"float alpha\" 0")), some = world(way("\"float alpha\" 0.1"));
  const auto whole = world(way(""));
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = randomRay(rng);
    EXPECT_FALSE(none->intersect(ray).found());
    EXPECT_EQ(some->intersect(ray).t, whole->intersect(ray).t);
  }
}

// pbrt-v4: a surface stops a ray with the chance alpha, each layer for itself.
TEST(Cutout, InV4AlphaIsAChance) {
  BuildOptions v4;
  v4.dialect = dialectByName("v4");
  if (!v4.dialect) GTEST_SKIP() << "this build does not know pbrt-v4";
  const std::string plate = "Translate 0 0 1 Shape \"disk\" \"float alpha\" 0.3\n";
  const auto one = world(plate, v4), three = world(plate + plate + plate, v4);
  Rng rng(5);
  constexpr int n = 40000;
  int stopsOne = 0, stopsThree = 0;
  for (int i = 0; i < n; ++i) {
    const Point2 p = 0.5F * concentricDisk({rng.uniform(), rng.uniform()});
    const Ray ray{{p, 0}, 0, {0, 0, 1}, kInfinity, 0};
    const bool stops = one->intersect(ray).found();
    EXPECT_EQ(one->intersect(ray).found(), stops) << "the same ray sees the same";
    stopsOne += stops;
    stopsThree += three->intersect(ray).found();
  }
  const auto expectShare = [&](int got, double share) {
    EXPECT_NEAR(got, n * share, 4.5 * std::sqrt(n * share * (1 - share)));
  };
  expectShare(stopsOne, 0.3);
  expectShare(stopsThree, 1 - std::pow(0.7, 3));
}

TEST(Cutout, AHoleShowsWhatIsBehind) {
  const Image image = test::renderText(
      "Camera \"orthographic\" \"float screenwindow\" [-0.9 0.9 -0.9 0.9]\n"
      "Film \"image\" \"integer xresolution\" 70 \"integer yresolution\" 50\n"
      "Sampler \"stratified\" Integrator \"directlighting\" WorldBegin\n" +
      kChecks +
      "Translate 0 0 2 AttributeBegin AreaLightSource \"diffuse\" Translate 0 0 1\n"
      "Rotate 180 1 0 0 Shape \"disk\" \"float radius\" 5 AttributeEnd\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"texture alpha\" \"checks\"\n"
      "\"point P\" [-0.9 -0.9 0  0.9 -0.9 0  0.9 0.9 0 -0.9 0.9 0]\n"
      "\"float uv\" [0 0 1 0 1 1 0 1] WorldEnd");
  EXPECT_NEAR(test::mean(image, "G"), 17 / 35.0, 0.03);  // 17 of 35 squares are holes
}

TEST(Cutout, AWrongTextureIsAnErrorWithAPlace) {
  try {
    world("Shape \"sphere\" \"texture alpha\" \"cheks\"");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(format(error.diagnostics().at(0)).find("did you mean \"checks\""), std::string::npos);
  }
}

}  // namespace
}  // namespace pbrt
