// Path tracing against closed forms: form factors, mirror images, odd scenes.

#include "tests/integrators/estimate.h"

namespace pbrt {
namespace {

using namespace test;

const std::string kBlack = "Material \"matte\" \"rgb Kd\" [0 0 0]\n";

// -- one bounce: form factors

const std::string kFromAbove = "0 -0.2 0.2  0 0 0  0 0 1";
const std::string kFloor =
    "Material \"matte\" \"rgb Kd\" [0.8 0.8 0.8]\n"
    "Shape \"disk\" \"float radius\" 0.4\n";

// `shape` one unit above the floor shines down on it, with radiance 5.
std::string lamp(const std::string& shape) {
  return "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n" + kBlack + shape +
         " AttributeEnd\n";
}

struct FormFactor {
  const char* name;
  std::string shape;
  double factor;
};

// A sphere of radius r at distance h that is all above the horizon: (r / h)^2. A disk, facing: r^2
// / (r^2 + h^2). (Both follow from projecting onto the unit hemisphere, then down: Nusselt 1928.)
std::vector<FormFactor> formFactors() {
  const auto sphere = [](double r, double h) {
    return fmt::format("Translate 0 0 {} Shape \"sphere\" \"float radius\" {}", h, r);
  };
  const auto disk = [](double r) {
    return fmt::format("Translate 0 0 1 ReverseOrientation Shape \"disk\" \"float radius\" {}", r);
  };
  // A lone atom of the kernel wyvill is a ball: (1 - (r / h)^2)^3 = 1/2.
  const double atom = std::sqrt(1 - std::cbrt(0.5));
  return {{"SmallSphere", sphere(0.001, 1), 1e-6},
          {"LargeSphere", sphere(9.5, 10), sqr(0.95)},
          {"SmallDisk", disk(0.001), 1e-6 / (1 + 1e-6)},
          {"Disk", disk(1), 0.5},
          {"LargeDisk", disk(100), 1e4 / (1e4 + 1)},
          {"Metaballs",
           "Translate 0 0 1 Shape \"metaballs\" \"string kernel\" \"wyvill\"\n"
           "\"point P\" [0 0 0] \"float radius\" [1.5]",
           sqr(1.5 * atom)}};
}

class Lamp : public testing::TestWithParam<FormFactor> {};

TEST_P(Lamp, ShinesByItsFormFactorWhateverItsSize) {
  const double expected = 0.8 * 5 * GetParam().factor;
  const Estimate e = estimate(kFromAbove, path(1), lamp(GetParam().shape) + kFloor);
  expectMean(e, expected);
  EXPECT_LT(std::sqrt(e.variance), 1.5 * expected) << "one of the strategies should do well";
}

INSTANTIATE_TEST_SUITE_P(Shapes, Lamp, testing::ValuesIn(formFactors()),
                         [](const auto& test) { return test.param.name; });

// Lamps of radii 0.3 and 0.05, equally bright, and three that are out.
TEST(Path, ChoosesAmongLightsWithoutBias) {
  const auto sphere = [](double x, double r, int L) {
    return fmt::format(
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [{} {} {}]\n{} Translate {} 0 1\n"
        "Shape \"sphere\" \"float radius\" {} AttributeEnd\n",
        L, L, L, kBlack, x, r);
  };
  const std::string world = sphere(0, 0.3, 5) + sphere(1, 0.05, 5) + sphere(-1, 0.1, 0) +
                            sphere(-2, 0.1, 0) + sphere(-3, 0.1, 0) + kFloor;
  // At 45 degrees and distance sqrt(2).
  const double expected = 0.8 * 5 * (sqr(0.3) + sqr(0.05) / 2 * std::sqrt(0.5));
  const Estimate spatial = estimate(kFromAbove, path(1, kSpatial), world, 200);
  const Estimate uniform = estimate(kFromAbove, path(1, kUniform), world, 200);
  expectMean(spatial, expected);
  expectMean(uniform, expected);
  EXPECT_LT(4 * spatial.variance, uniform.variance);
}

// A small lamp of ten equal triangles of which only the last faces the floor, near one of a tenth
// of its area that all does. The BSDF's samples alone would rarely find either.
TEST(Path, ALightThatSendsLessThanItsBoundsSay) {
  std::string indices, points;
  for (int i = 0; i < 10; ++i) {
    const int a = 3 * i, b = i < 9 ? a + 1 : a + 2, c = i < 9 ? a + 2 : a + 1;
    indices += fmt::format("{} {} {} ", a, b, c);
    points += fmt::format("{0} 0 1 {1} 0 1 {0} 0.02 1 ", 0.02 * i, 0.02 * i + 0.02);
  }
  const std::string blind = lamp("Shape \"trianglemesh\" \"integer indices\" [" + indices +
                                 "] \"point P\" [" + points + "]");
  const std::string other = lamp("Translate 1 0 1 Shape \"sphere\" \"float radius\" 0.01");
  const std::string world = blind + other + kFloor;
  const Estimate spatial = estimate(kFromAbove, path(1, kSpatial), world, 200);
  const Estimate uniform = estimate(kFromAbove, path(1, kUniform), world, 200);
  EXPECT_NEAR(spatial.mean, uniform.mean, kSigmas * std::hypot(spatial.error(), uniform.error()));
  EXPECT_LT(spatial.variance, 2 * uniform.variance);
}

class SameAsDirect : public testing::TestWithParam<std::string> {};

// Nothing but the floor sends light on, and its mirror image of the lamps is the second ray.
TEST_P(SameAsDirect, WhereLightIsScatteredOnce) {
  const std::string world =
      lamp("Translate 0 0.9 1 Shape \"sphere\" \"float radius\" 0.5") +
      lamp("Translate 0 0 1 ReverseOrientation Shape \"disk\" \"float radius\" 0.7") +
      "LightSource \"point\" \"rgb I\" [2 2 2] \"point from\" [1 1 2]\n"
      "LightSource \"distant\" \"point from\" [0 1 1] \"point to\" [0 0 0]\nMaterial " +
      GetParam() + " Shape \"disk\" \"float radius\" 0.4\n";
  const Estimate direct = estimate(kFromAbove, "\"directlighting\" \"integer maxdepth\" 2", world);
  expectSame(estimate(kFromAbove, path(1, kUniform), world, 200), direct);
  expectSame(estimate(kFromAbove, path(1, kSpatial), world, 200), direct);
}

INSTANTIATE_TEST_SUITE_P(Materials, SameAsDirect,
                         testing::Values("\"matte\" \"float sigma\" 20",
                                         "\"plastic\" \"float roughness\" 0.3",
                                         "\"plastic\" \"float roughness\" 0.01",
                                         "\"shinymetal\" \"float roughness\" 0.3"),
                         [](const auto& test) {
                           return test.param.substr(1, test.param.find('"', 1) - 1) +
                                  std::to_string(test.index);
                         });

// -- mirrors and glass

const std::string kAlongZ = "0 0 0  0 0 1  0 1 0";

TEST(Path, AChainOfMirrorsEndsAtMaxdepth) {
  // Between two mirrors that face each other, one of which shines with radiance 1: it is seen after
  // 0, 2, 4, ... reflections.
  const std::string world =
      "Material \"mirror\" \"rgb Kr\" [0.5 0.5 0.5]\n"
      "TransformBegin Translate 0 0 -1 Shape \"disk\" TransformEnd\n"
      "AreaLightSource \"diffuse\" Translate 0 0 1 ReverseOrientation Shape \"disk\"\n";
  double expected = 0, weight = 1;
  for (int depth = 0; depth <= 9; ++depth, weight *= 0.5) {
    if (depth % 2 == 0) expected += weight;
    EXPECT_NEAR(estimate(kAlongZ, path(depth, "\"float rrthreshold\" 0"), world, 1).mean, expected,
                1e-5)
        << depth;
  }
}

TEST(Path, AGlassSlabSendsOnWhatTheSeriesSays) {
  // Frontal reflectance R = ((n - 1) / (n + 1))^2; all the inner reflections together let through
  // (1 - R)^2 / (1 - R^2) = (1 - R) / (1 + R).
  const std::string world = "AttributeBegin " + kBlack +
                            "AreaLightSource \"diffuse\" Translate 0 0 9 ReverseOrientation\n"
                            "Shape \"disk\" \"float radius\" 5 AttributeEnd\n"
                            "Material \"glass\" \"float index\" 1.5 Translate 0 0 1\n"
                            "ReverseOrientation Shape \"disk\" ReverseOrientation\n"
                            "Translate 0 0 1 Shape \"disk\"\n";
  const double R = sqr(0.5 / 2.5);
  expectMean(estimate(kAlongZ, path(20), world), (1 - R) / (1 + R));
}

TEST(Path, RouletteTakesRefractionForNoLoss) {
  // Three slabs without reflections. At the fifth surface, where roulette begins, the path enters
  // glass: it carries (1 - R)^5 of the light, 0.82, as radiance 2.25 times denser. If that were
  // taken for brightness, it would be ended too often (or its mean would be wrong).
  std::string world = "AttributeBegin " + kBlack +
                      "AreaLightSource \"diffuse\" Translate 0 0 9 ReverseOrientation\n"
                      "Shape \"disk\" \"float radius\" 5 AttributeEnd\n"
                      "Material \"glass\" \"rgb Kr\" [0 0 0] \"float index\" 1.5\n";
  for (int surface = 0; surface < 6; ++surface)
    world += "Translate 0 0 1 ReverseOrientation Shape \"disk\"\n";
  const double expected = std::pow(1 - sqr(0.5 / 2.5), 6);
  const Estimate e = estimate(kAlongZ, path(9), world);
  expectMean(e, expected);
  EXPECT_LT(e.variance, 0.5 * sqr(expected));
}

// A ring in the plane of the floor, facing up, and a mirror two units above: the floor is lit by
// the ring's image four units above, and by no light that could be sampled.
TEST(Path, AMirrorLightsTheFloor) {
  const std::string world = "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n" +
                            kBlack +
                            "Shape \"disk\" \"float radius\" 6 \"float innerradius\" 1\n"
                            "AttributeEnd AttributeBegin Translate 0 0 2\n"
                            "Material \"mirror\" \"rgb Kr\" [0.9 0.9 0.9]\n"
                            "Shape \"disk\" \"float radius\" 5 AttributeEnd\n" +
                            kFloor;
  const auto disk = [](double r) { return r * r / (r * r + 16); };
  EXPECT_EQ(estimate(kFromAbove, path(1), world).most, 0);
  expectMean(estimate(kFromAbove, path(2), world), 0.8 * 0.9 * 5 * (disk(6) - disk(1)));
}

// -- odd scenes

TEST(Path, WithoutLightThePictureIsBlack) {
  EXPECT_EQ(estimate(kFromAbove, path(5), kFloor, 20).most, 0);
  const std::string dark =
      "AreaLightSource \"diffuse\" \"rgb L\" [0 0 0] Translate 0 0 1 Shape \"sphere\" \"float "
      "radius\" 0.3\n";
  EXPECT_EQ(estimate(kFromAbove, path(5), kFloor + dark + dark, 20).most, 0);
}

TEST(Path, ABlackSurfaceSendsNothingOn) {
  const std::string lit = lamp("Translate 0 0 1 Shape \"sphere\" \"float radius\" 0.3");
  const std::string floor = " Shape \"disk\" \"float radius\" 0.4\n";
  EXPECT_EQ(estimate(kFromAbove, path(5), lit + kBlack + floor, 20).most, 0);
  // This one has no lobe at all.
  EXPECT_EQ(estimate(kFromAbove, path(5),
                     lit + "Material \"glass\" \"rgb Kr\" [0 0 0] \"rgb Kt\" [0 0 0]" + floor, 20)
                .most,
            0);
}

TEST(Path, SameBitsForAnyThreadsAndPasses) {
  const std::string file = PBRT_SOURCE_DIR "/scenes/metaballs-light.pbrt";
  const auto build = [&] {
    std::vector<Directive> directives;
    Parser parser([&](Directive&& d) {
      if (d.kind == DirectiveKind::Integrator) d.words[0] = "path";
      directives.push_back(std::move(d));
    });
    parser.file(file);
    BuildOptions options;
    options.samplesPerPixel = 4;
    options.quick = true;
    return buildScene(std::move(directives), test::loader(), options);
  };
  const Image one = test::renderScene(*build(), 1);
  EXPECT_GT(test::mean(one, "G"), 0.01);
  EXPECT_EQ(one.channels, test::renderScene(*build(), 4).channels);
  const auto twice = build();
  test::renderScene(*twice, 2, 0, 3);
  EXPECT_EQ(one.channels, test::renderScene(*twice, 3, 3, 4).channels);
}

TEST(Path, RefusesWhatItDoesNotDo) {
  EXPECT_THROW(test::make<Integrator>("path", {test::integers("pixelbounds", {0, 9, 0, 9})}),
               Error);
  EXPECT_THROW(test::make<Integrator>("path", {test::text("lightsamplestrategy", "all")}), Error);
  EXPECT_THROW(test::make<Integrator>("path", {test::number("rrthreshold", -1)}), Error);
  EXPECT_THROW(test::make<Integrator>("path", {test::integers("maxdepth", {-1})}), Error);
}

}  // namespace
}  // namespace pbrt
