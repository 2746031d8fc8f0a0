// Light that comes from infinitely far, gathered by every integrator: a convex matte body of
// reflectance rho sends rho E / pi, which in a white furnace is rho.

#include "core/base/warp.h"
#include "tests/integrators/estimate.h"
#include "tests/lights/pictures.h"

namespace pbrt {
namespace {

using namespace test;

// At the sphere's +z, and askew.
const std::string kViews[] = {"0 0 5  0 0 0  0 1 0", "3 -4 1  0 0 0  0 0 1"};
const std::string kSphere = "Material \"matte\" \"rgb Kd\" [0.6 0.6 0.6] Shape \"sphere\"\n";
const std::string kGlossy =
    "Material \"plastic\" \"rgb Kd\" [0.5 0.5 0.5] \"rgb Ks\" [0.3 0.3 0.3] \"float roughness\" "
    "0.05 "
    "Shape \"sphere\"\n";

class InfiniteLight : public testing::TestWithParam<std::string> {
 protected:
  std::string integrator() const { return "\"" + GetParam() + "\""; }
  Folder folder;
};

TEST_P(InfiniteLight, WhiteFurnace) {
  for (const std::string& view : kViews)
    expectMean(estimate(view, integrator(), "LightSource \"infinite\"\n" + kSphere), 0.6);
}

// A mirror sees the light itself, and what misses everything too.
TEST_P(InfiniteLight, IsSeenInMirrorsAndBeside) {
  const std::string light = "LightSource \"infinite\" \"rgb L\" [3 3 3]\n";
  const Estimate mirror =
      estimate(kViews[1], integrator(),
               light + "Material \"mirror\" \"rgb Kr\" [0.5 0.5 0.5] Shape \"sphere\"\n");
  EXPECT_NEAR(mirror.mean, 1.5, 1e-4);
  const Estimate beside = estimate("0 0 5  0 5 0  0 1 0", integrator(), light + kSphere);
  EXPECT_NEAR(beside.mean, 3, 1e-5);
}

// A sky that is dark but for a small sun: the picture's irradiance, whoever finds the sun.
TEST_P(InfiniteLight, SunInASky) {
  std::vector<float> sky(32 * 16, 0.25F);
  sky[5 * 32 + 7] = 400;  // about 1.08 from +z and 1.47 about it
  const std::string light = "LightSource \"infinite\" \"string mapname\" \"" +
                            greyPicture(folder, "sky.exr", 32, sky) + "\"\n";
  const auto lamp =
      make<Light>("infinite", {text("mapname", (folder.path() / "sky.exr").string())});
  const auto expected = [&](const Normal3& n) {
    constexpr int cells = 1000;
    const Frame frame = Frame::fromZ(n);
    double sum = 0;
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j)
        sum +=
            lamp->escaped(frame.fromLocal(cosHemisphere({(i + 0.5F) / cells, (j + 0.5F) / cells})))
                .x;
    return 0.6 * sum / (cells * cells);
  };
  const double up = expected({0, 0, 1});
  const Estimate e = estimate(kViews[0], integrator(), light + kSphere);
  EXPECT_NEAR(e.mean, up, kSigmas * e.error() + 1e-3 * up);
  // Sampling the sun's cell, not the sky, a sample is off by a few times the mean, not hundreds.
  EXPECT_LT(e.error() * 100, 4 * up);
}

INSTANTIATE_TEST_SUITE_P(Integrators, InfiniteLight,
                         testing::Values("path", "directlighting", "whitted"));

// Both strategies, and each alone, have the same mean on a glossy body.
TEST(InfiniteLightGlossy, StrategiesAgree) {
  const Folder folder;
  std::vector<float> sky(16 * 8, 0.2F);
  sky[2 * 16 + 3] = 60;
  const std::string light = "LightSource \"infinite\" \"string mapname\" \"" +
                            greyPicture(folder, "sky.exr", 16, sky) + "\"\n";
  for (const std::string& view : kViews) {
    const Estimate path = estimate(view, "\"path\" \"integer maxdepth\" 1", light + kGlossy, 200);
    const Estimate direct = estimate(view, "\"directlighting\"", light + kGlossy, 200);
    const Estimate whitted = estimate(view, "\"whitted\"", light + kGlossy, 200);
    const auto error = [](const Estimate& a, const Estimate& b) {
      return kSigmas * std::hypot(a.error(), b.error());
    };
    EXPECT_NEAR(path.mean, direct.mean, error(path, direct));
    EXPECT_NEAR(path.mean, whitted.mean, error(path, whitted));
  }
}

}  // namespace
}  // namespace pbrt
