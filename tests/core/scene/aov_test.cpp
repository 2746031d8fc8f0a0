// What the film stores beside the picture: the surface that is seen, and the noise that is left.

#include "core/scene/aov.h"

#include "core/base/rng.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

BuildOptions storing(AovSet aovs) {
  BuildOptions options;
  options.aovs = aovs;
  return options;
}

// A ball of radius 1 about `centre`, seen from 5 units before it.
std::string ball(const std::string& centre, const std::string& eye, const std::string& material) {
  return "LookAt " + eye + "  " + centre + R"(  0 1 0
    Camera "perspective" "float fov" 30
    Film "image" "integer xresolution" 40 "integer yresolution" 30
    Sampler "random" "integer pixelsamples" 9
    Integrator "whitted"
    WorldBegin
    LightSource "distant" "point from" [0 0 1] "point to" [0 0 0]
    Translate )" +
         centre + "\nMaterial " + material + "\nShape \"sphere\" WorldEnd";
}

TEST(Aov, NamesAreSets) {
  AovSet all = 0;
  for (const std::string_view name : aovNames()) {
    const auto bit = aovByName(name);
    ASSERT_TRUE(bit);
    EXPECT_EQ(all & *bit, 0);
    all |= *bit;
  }
  EXPECT_EQ(all, 1023);
  EXPECT_FALSE(aovByName("colour"));
}

TEST(Aov, OnlyWhatIsAskedForIsStored) {
  const std::string scene = ball("0 0 0", "0 0 5", "\"matte\"");
  const Image plain = test::renderText(scene);
  EXPECT_EQ(plain.names, (std::vector<std::string>{"R", "G", "B", "A"}));
  const Image one = test::renderText(scene, 0, storing(kDepth));
  EXPECT_EQ(one.names, (std::vector<std::string>{"R", "G", "B", "A", "Z"}));
  const Image all = test::renderText(scene, 0, storing(kEveryAov));
  EXPECT_EQ(all.names.size(), 4U + 7 * 3 + 5);
  for (int c = 0; c < 4; ++c)
    EXPECT_EQ(all.channels[c], plain.channels[c]) << "the picture itself must not change";
}

TEST(Aov, TheSceneMayAskItself) {
  const std::string scene =
      "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string aov\" "
      "[\"samples\" \"depth\"] WorldBegin Shape \"sphere\" WorldEnd";
  const Image image = test::renderText(scene, 0, storing(kNormal));
  for (const char* name : {"samples", "Z", "N.X"}) EXPECT_NE(image.channel(name), nullptr) << name;
  EXPECT_EQ(image.channel("P.X"), nullptr);
  EXPECT_THROW(test::buildText("Film \"image\" \"string aov\" \"deep\" WorldBegin WorldEnd"),
               Error);
}

// The channels against the ball's equation, at home and a million units away.
TEST(Aov, TellOfTheSurface) {
  struct Place {
    std::string centre, eye;
    glm::dvec3 c;
  };
  for (const Place& place : {Place{"0 0 0", "0 0 5", {0, 0, 0}},
                             Place{"1e6 -2e6 3e6", "1e6 -2e6 3000005", {1e6, -2e6, 3e6}}}) {
    const Image image = test::renderText(
        ball(place.centre, place.eye, "\"matte\" \"rgb Kd\" [0.3 0.5 0.7]"), 0, storing(kEveryAov));
    const double unit = 1e-6 * (1 + glm::length(place.c));  // rounding of a channel's floats
    int inside = 0;
    for (std::size_t i = 0; i < image.channels[0].size(); ++i) {
      const auto at = [&](const char* name) { return double{(*image.channel(name))[i]}; };
      EXPECT_EQ(at("samples"), 9);
      if (at("A") == 0) {
        for (const char* name : {"Z", "N.X", "N.Z", "P.X", "P.Z", "Albedo.G"})
          EXPECT_EQ(at(name), 0) << name;
        continue;
      }
      EXPECT_NEAR(at("Albedo.R"), 0.3, 1e-5);
      EXPECT_NEAR(at("Albedo.G"), 0.5, 1e-5);
      EXPECT_NEAR(at("Albedo.B"), 0.7, 1e-5);
      if (at("A") < 1) continue;  // only some of the samples see the ball
      ++inside;
      // Means over the pixel: the normal and the place lie a little inside the ball.
      const glm::dvec3 n(at("N.X"), at("N.Y"), at("N.Z"));
      const glm::dvec3 p = glm::dvec3(at("P.X"), at("P.Y"), at("P.Z")) - place.c;
      EXPECT_NEAR(glm::length(n), 1, 0.02);
      EXPECT_NEAR(glm::distance(n, p), 0, 1e-4 + unit);
      EXPECT_NEAR(at("Z"), glm::distance(p, glm::dvec3(0, 0, 5)), 0.02 + unit);
    }
    EXPECT_GT(inside, 200);
  }
}

// A parallelogram whose u and v run along its sides, 4 and 2 long, tilted shading normals, and an
// instance beside it.
TEST(Aov, DetailsOfTheSurfaceAreThoseOfItsParameters) {
  const std::string text = R"(
    LookAt 2 1 8  2 1 0  0 1 0
    Camera "orthographic" "float screenwindow" [-4 4 -4 4]
    Film "image" "integer xresolution" 16 "integer yresolution" 16
      "string aov" ["uv" "geometricnormal" "derivatives" "shape" "depth"]
    Sampler "stratified" "integer xsamples" 2 "integer ysamples" 2 PixelFilter "box"
    SurfaceIntegrator "whitted" WorldBegin
    Translate 100 0 0
    Shape "sphere" "float radius" 0.1
    Translate -100 0 0
    Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [0 0 0  4 0 0  4 2 0  0 2 0]
      "normal N" [0.6 0 0.8  0.6 0 0.8  0.6 0 0.8  0.6 0 0.8] "float uv" [0 0 1 0 1 1 0 1]
    ObjectBegin "o" Shape "disk" "float radius" 0.4 ObjectEnd
    Translate 2 3.5 0 ObjectInstance "o"
    WorldEnd)";
  const Image image = test::renderText(text);
  EXPECT_EQ(image.channel("N.X"), nullptr);
  int mesh = 0, instance = 0;
  for (int i = 0; i < 256; ++i) {
    const auto at = [&](const char* name) {
      return double{(*image.channel(name))[static_cast<std::size_t>(i)]};
    };
    if (at("shape") == 0) {
      EXPECT_EQ(at("u"), 0);
      EXPECT_EQ(at("dPdv.Y"), 0);
    } else if (at("shape") == 2) {
      ++mesh;
      const double x = 6 - 0.5 * (i % 16 + 0.5), y = 5 - 0.5 * (i / 16 + 0.5);
      EXPECT_NEAR(at("u"), x / 4, 0.05);
      EXPECT_NEAR(at("v"), y / 2, 0.1);
      EXPECT_NEAR(std::abs(at("Ng.Z")), 1, 1e-6);  // where N is the one for shading
      EXPECT_NEAR(at("dPdu.X"), 4, 1e-5);
      EXPECT_NEAR(at("dPdu.Y"), 0, 1e-5);
      EXPECT_NEAR(at("dPdv.X"), 0, 1e-5);
      EXPECT_NEAR(at("dPdv.Y"), 2, 1e-5);
      EXPECT_NEAR(at("Z"), 8, 1e-4);
    } else {
      ++instance;
      EXPECT_EQ(at("shape"), 3);
    }
  }
  EXPECT_EQ(mesh, 8 * 4);
  EXPECT_GE(instance, 1);
}

TEST(Aov, AlbedoIsWhatTheMaterialSendsBack) {
  const auto albedo = [](const std::string& material) {
    const Image image = test::renderText(ball("0 0 0", "0 0 5", material), 0, storing(kAlbedo));
    return (*image.channel("Albedo.G"))[15 * 40 + 20];  // the middle: seen head-on
  };
  EXPECT_NEAR(albedo("\"mirror\" \"rgb Kr\" [0.9 0.9 0.9]"), 0.9, 1e-4);
  EXPECT_NEAR(albedo("\"glass\""), 1, 1e-3) << "reflection and refraction are all of the light";
  // Oren and Nayar 1994: seen head-on only the term A = 1 - s^2 / (2 s^2 + 0.66) is left.
  const double s2 = sqr(30 * kPi / 180);
  EXPECT_NEAR(albedo("\"matte\" \"rgb Kd\" [0.25 0.25 0.25] \"float sigma\" 30"),
              0.25 * (1 - s2 / (2 * s2 + 0.66)), 2e-3);
}

// A disk under a square lamp: smooth but for the noise of one light sample each.
const std::string kNoisy = R"(
    LookAt 0 3 4  0 0 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "image" "integer xresolution" 48 "integer yresolution" 48
    Sampler "random" "integer pixelsamples" 8
    Integrator "whitted"
    %FILTER%
    WorldBegin
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [10 5 20]
      Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
        "point P" [-2 1.5 -2  2 1.5 -2  2 1.5 2  -2 1.5 2]
    AttributeEnd
    Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
      "point P" [-50 0 -50  -50 0 50  50 0 50  50 0 -50]
    WorldEnd)";

class Variance : public testing::TestWithParam<std::string> {};

// The channel against the spread of renders with other seeds: of pixels, and of means over blocks.
TEST_P(Variance, IsThatOfRendersWithOtherSeeds) {
  constexpr int kSeeds = 60, kBlock = 8, kSize = 32, kFrom = 8;
  std::string text = kNoisy;
  text.replace(text.find("%FILTER%"), 8, "PixelFilter " + GetParam());
  const auto scene = test::buildText(text, storing(kVariance));
  const Film empty = scene->film();
  std::vector<double> sum(kSize * kSize), squares(kSize * kSize);
  constexpr int kBlocks = kSize / kBlock;
  std::vector<double> blockSum(kBlocks * kBlocks), blockSquares(kBlocks * kBlocks);
  double stated = 0, statedOfBlocks = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Film film = empty;
    RenderControl control;
    control.endSample = 8;
    const auto sampler = scene->makeSampler(seed, 8);
    scene->integrator().render(*scene, *sampler, film, control);
    const Image image = film.image();
    std::vector<double> blocks(kBlocks * kBlocks);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const int i = (y + kFrom) * 48 + x + kFrom, to = y * kSize + x;
        const double value = (*image.channel("G"))[i], v = (*image.channel("Variance.G"))[i];
        sum[to] += value;
        squares[to] += value * value;
        stated += v / (kSeeds * kSize * kSize);
        blocks[y / kBlock * kBlocks + x / kBlock] += value / (kBlock * kBlock);
        statedOfBlocks +=
            v / film.filterNoise() / (kBlock * kBlock) / (kSeeds * double{kSize * kSize});
      }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      blockSum[b] += blocks[b];
      blockSquares[b] += blocks[b] * blocks[b];
    }
  }
  const auto meanVariance = [](const auto& s, const auto& sq) {
    double mean = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
      mean += (sq[i] - s[i] * s[i] / kSeeds) / (kSeeds - 1) / static_cast<double>(s.size());
    return mean;
  };
  // The relative standard deviation of a variance from n - 1 degrees of freedom is sqrt(2 / (n -
  // 1)): 0.6 % for independent pixels, three times that where a filter joins ten, 4.6 % for blocks.
  EXPECT_NEAR(stated / meanVariance(sum, squares), 1, 0.08);
  // A block's sum also loses samples to its surroundings and gains others from there, which makes
  // its mean a little less noisy.
  EXPECT_NEAR(statedOfBlocks / meanVariance(blockSum, blockSquares), 1.05, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Filters, Variance,
                         testing::Values("\"box\"", "\"gaussian\"", "\"mitchell\"",
                                         "\"triangle\" \"float xwidth\" 1.5 \"float ywidth\" 3"));

// Beside a noisy area, the filter carries noise into pixels whose own samples are all alike.
TEST(Aov, VarianceKnowsOfNoiseFromBeyondThePixel) {
  const auto gaussian = test::make<Filter>("gaussian");
  const Film empty({16, 16}, {{0, 0}, {16, 16}}, *gaussian, {.aovs = kVariance});
  Rng rng(3);
  constexpr int kRenders = 2000, kSamples = 8;
  constexpr int kFlat = 8 * 16 + 8;  // a pixel whose left neighbours are noisy
  double sum = 0, squares = 0, stated = 0;
  for (int render = 0; render < kRenders; ++render) {
    Film film = empty;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        for (int s = 0; s < kSamples; ++s) {
          const Point2 at(float(x) + rng.uniform(), float(y) + rng.uniform());
          film.add(0, at, Spectrum(x < 8 ? 2 * rng.uniform() : 1), 1);
        }
    const Image image = film.image();
    const double value = (*image.channel("G"))[kFlat];
    sum += value;
    squares += value * value;
    stated += (*image.channel("Variance.G"))[kFlat] / kRenders;
  }
  const double shown = (squares - sum * sum / kRenders) / (kRenders - 1);
  EXPECT_GT(shown, 1e-5);
  EXPECT_NEAR(stated / shown, 1, 0.15);  // 3.2 % is one standard deviation of `shown`
}

TEST(Aov, SameBitsForAnyThreadsAndPasses) {
  std::string text = kNoisy;
  text.replace(text.find("%FILTER%"), 8, "");
  const Image whole = test::renderText(text, 1, storing(kEveryAov));
  EXPECT_EQ(whole.channels, test::renderText(text, 3, storing(kEveryAov)).channels);
  const auto split = test::buildText(text, storing(kEveryAov));
  test::renderScene(*split, 2, 0, 3);
  EXPECT_EQ(whole.channels, test::renderScene(*split, 2, 3, 8).channels);
}

}  // namespace
}  // namespace pbrt
