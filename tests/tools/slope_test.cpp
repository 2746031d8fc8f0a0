// How fast errors fall with the number of samples.

#include <fmt/format.h>

#include "tests/tools/measured.h"

namespace pbrt {
namespace {

using namespace test;

// As many standard errors as leave out 0.27 % of Student's t with 7 degrees of freedom, like 3 of a
// normal: the error is known from 8 slopes only.
constexpr double kThreeSigma = 4.53;
constexpr int kSeeds = 8;

// Every scene by its own integrator, which is whitted or directlighting, and by paths.
class Slope : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(Slope, OfUnbiasedRandomSamplingIsMinusOneHalf) {
  const auto& [scene, integrator] = GetParam();
  const std::string change = "Sampler \"random\" " + integrator;
  const std::filesystem::path file = kScenes + scene + ".pbrt";
  const Reference reference = renderReference(variantOf(file, change, 24), 1024, 0);
  const Plan plan{.samples = {4, 8, 16, 32, 64}, .seeds = kSeeds, .textureSamples = 1024};
  const Curve curve = measureOne(variantOf(file, change, 24), reference, plan);
  const Estimate slope = slopeAgainstSamples(curve, reference.mse.value());
  EXPECT_LT(std::abs(slope.value + 0.5), kThreeSigma * slope.error.value()) << slope.value;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes))
    if (entry.path().extension() == ".pbrt") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Slope,
                         testing::Combine(testing::ValuesIn(sceneNames()),
                                          testing::Values("", "SurfaceIntegrator \"path\"")),
                         [](const auto& test) {
                           std::string name = std::get<0>(test.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + (std::get<1>(test.param).empty() ? "" : "_path");
                         });

// Soft light on a plane, no edge in sight: samples that are spread well converge faster, by an
// exponent of 0.1 at least. Not by 0.5, since places in the pixel and on the light are spread well
// each, but paired at random.
TEST(Slope, IsSteeperForSamplesThatAreSpreadWell) {
  const std::string scene = R"(LookAt 0 3 0  0 0 0  0 0 1
Camera "perspective" "float fov" 40
Film "image" "integer xresolution" 24 "integer yresolution" 24
PixelFilter "box"
SurfaceIntegrator "directlighting"
WorldBegin
AttributeBegin
AreaLightSource "diffuse" "rgb L" [5 5 5] "bool twosided" "true"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-3 1 1  3 1 1  3 3 4  -3 3 4]
AttributeEnd
Material "matte"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point P" [-9 0 -9  9 0 -9  9 0 9  -9 0 9]
WorldEnd
)";
  const Reference reference =
      renderReference(variantOfText(scene, "Sampler \"halton\""), 1 << 13, 0);
  const auto slope = [&](const std::string& sampler) {
    const Plan plan{.samples = {4, 16, 64, 256}, .seeds = kSeeds};
    return slopeAgainstSamples(
        measureOne(variantOfText(scene, "Sampler \"" + sampler + "\""), reference, plan),
        *reference.mse);
  };
  const Estimate random = slope("random");
  EXPECT_LT(std::abs(random.value + 0.5), kThreeSigma * *random.error);
  for (const char* sampler : {"stratified", "lowdiscrepancy", "halton"}) {
    const Estimate better = slope(sampler);
    EXPECT_LT(better.value + kThreeSigma * *better.error, -0.6) << sampler;
    EXPECT_GT(better.value, -1) << sampler;
  }
}

}  // namespace
}  // namespace pbrt
