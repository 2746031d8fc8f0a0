// Light in closed form, and the ways of a scene: instances, orientation, precision far away.

#include "core/scene/scene.h"

#include <set>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

// A 1 x 1 picture that looks down on the origin from `height`, of a plane z = 0 unless the world
// says more.
std::string lookDown(const std::string& world, const std::string& integrator = "whitted",
                     int samples = 64) {
  return R"(LookAt 0 0 5  0 0 0  0 1 0
    Camera "perspective" "float fov" 0.001
    Film "image" "integer xresolution" 1 "integer yresolution" 1
    Sampler "random" "integer pixelsamples" )" +
         std::to_string(samples) + "\nIntegrator \"" + integrator + "\"\nWorldBegin\n" + world +
         "\nWorldEnd";
}

const std::string kPlane =
    "Material \"matte\" \"rgb Kd\" [0.5 0.5 0.5]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
    "\"point P\" [-9 -9 0  9 -9 0  9 9 0  -9 9 0]\n";

TEST(Scene, PointLightFallsOffWithTheSquareOfTheDistance) {
  // L = Kd / pi * I cos / d^2
  for (const float d : {1.F, 2.F, 10.F}) {
    const std::string light =
        "LightSource \"point\" \"rgb I\" [8 8 8] \"point from\" [0 0 " + std::to_string(d) + "]\n";
    EXPECT_NEAR(test::mean(test::renderText(lookDown(light + kPlane)), "G"),
                0.5 / kPi * 8 / (d * d), 1e-4);
  }
}

TEST(Scene, DiskLightMatchesItsFormFactor) {
  // A disk of radius r, parallel at height h: E = pi L r^2 / (r^2 + h^2) (Howell, factor B-3), and
  // the diffuse surface sends back Kd / pi of it.
  const std::string light =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 2 2] \"integer nsamples\" 4\n"
      "Translate 0 0 3\nRotate 180 1 0 0\nMaterial \"matte\" \"rgb Kd\" [0 0 0]\n"
      "Shape \"disk\" \"float radius\" 1.5\nAttributeEnd\n";
  const std::string camera = "LookAt 0 0 2  0 0 0  0 1 0\n";  // below the light
  for (const char* integrator : {"whitted", "directlighting"}) {
    std::string scene = lookDown(light + kPlane, integrator, 20000);
    scene.replace(0, scene.find('\n') + 1, camera);
    const double expected = 0.5 * 2 * 1.5 * 1.5 / (1.5 * 1.5 + 9);
    EXPECT_NEAR(test::mean(test::renderText(scene), "G"), expected, 0.004 * expected) << integrator;
  }
}

TEST(Scene, SphereLightMatchesItsFormFactor) {
  // A sphere of radius r at height h above: E = pi L (r / h)^2.
  const std::string light =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 2 2]\nTranslate 0 0 9\n"
      "Shape \"sphere\" \"float radius\" 2\nAttributeEnd\n";
  for (const char* integrator : {"whitted", "directlighting"}) {
    const double expected = 0.5 * 2 * 4 / 81.0;
    EXPECT_NEAR(test::mean(test::renderText(lookDown(light + kPlane, integrator, 20000)), "G"),
                expected, 0.004 * expected)
        << integrator;
  }
}

TEST(Scene, AStretchedSphereLightIsSampledRightly) {
  // By the mean over many directions the light of an ellipsoid can be had without its sampler: the
  // surface's own pdf must lead to the same.
  const std::string light =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 2 2]\nTranslate 1 0 4\n"
      "Scale 2 0.5 1\nShape \"sphere\"\nAttributeEnd\n";
  const auto scene = [&](const char* integrator) {
    std::string text = lookDown(light + kPlane, integrator, 40000);
    return text.replace(0, text.find('\n') + 1, "LookAt 0 0 2  0 0 0  0 1 0\n");
  };
  const auto built = test::buildText(scene("whitted"));
  double expected = 0;
  Rng rng(3);
  constexpr int kRays = 400000;
  for (int i = 0; i < kRays; ++i) {
    const Vec3 w = cosHemisphere({rng.uniform(), rng.uniform()});
    const RayDifferential ray(Ray{Point3(0, 0, -2 + 1e-3F), 0, w, kInfinity, 0});
    const Hit hit = built->intersect(ray);
    if (hit.found() && built->surface(ray, hit).light) expected += 2;
  }
  expected *= 0.5 / kRays;
  for (const char* integrator : {"whitted", "directlighting"})
    EXPECT_NEAR(test::mean(test::renderText(scene(integrator)), "G"), expected, 0.015 * expected)
        << integrator;
}

TEST(Scene, AMeshLightEqualsADiskLightOfItsOutline) {
  std::string points, indices;
  constexpr int kCorners = 200;
  for (int i = 0; i < kCorners; ++i) {
    const double phi = 2 * kPi * i / kCorners;
    points +=
        std::to_string(1.5 * std::cos(phi)) + " " + std::to_string(1.5 * std::sin(phi)) + " 3 ";
    if (i > 1) indices += "0 " + std::to_string(i) + " " + std::to_string(i - 1) + " ";
  }
  const std::string light =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 2 2]\n"
      "Shape \"trianglemesh\" \"integer indices\" [" +
      indices + "] \"point P\" [" + points + "]\nAttributeEnd\n";
  std::string scene = lookDown(light + kPlane, "directlighting", 20000);
  scene.replace(0, scene.find('\n') + 1, "LookAt 0 0 2  0 0 0  0 1 0\n");
  const double expected = 0.5 * 2 * 1.5 * 1.5 / (1.5 * 1.5 + 9);
  EXPECT_NEAR(test::mean(test::renderText(scene), "G"), expected, 0.004 * expected);
}

TEST(Scene, AnInstanceEqualsTheShapeItself) {
  const std::string lights = "LightSource \"point\" \"rgb I\" [50 50 50] \"point from\" [3 4 5]\n";
  const std::string place = "Translate 0.3 -0.2 0.1 Rotate 33 1 2 3 Scale 1.5 0.6 -0.9\n";
  const std::string shapes =
      "Shape \"sphere\" \"float radius\" 0.7\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-1 -1 0  1 -1 0  0 1 1]\n";
  const auto picture = [&](const std::string& world) {
    return test::renderText(
        "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 40\n"
        "Film \"image\" \"integer xresolution\" 60 \"integer yresolution\" 60\n"
        "Sampler \"halton\" \"integer pixelsamples\" 4 Integrator \"whitted\" WorldBegin\n" +
        lights + world + "WorldEnd");
  };
  const Image direct = picture(place + shapes);
  const Image instanced =
      picture("ObjectBegin \"o\"\n" + shapes + "ObjectEnd\n" + place + "ObjectInstance \"o\"\n");
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < direct.channels[1].size(); ++i) {
    worst = std::max<double>(worst, std::abs(direct.channels[1][i] - instanced.channels[1][i]));
    sum += direct.channels[1][i];
  }
  EXPECT_GT(sum, 10);
  EXPECT_LT(worst, 0.02 * 50 / 9.0);  // a sample on an edge may fall to the other side
}

TEST(Scene, ReverseOrientationTurnsTheLight) {
  const auto lit = [](const std::string& reverse) {
    return test::mean(test::renderText(lookDown("AttributeBegin\nAreaLightSource \"diffuse\"\n" +
                                                reverse + "Shape \"disk\"\nAttributeEnd\n")),
                      "G");
  };
  // The disk's normal is +z, towards the camera.
  EXPECT_EQ(lit(""), 1);
  EXPECT_EQ(lit("ReverseOrientation\n"), 0);
  EXPECT_EQ(lit("Scale -1 1 1\n"), 1) << "a mirror does not turn a surface inside out";
}

TEST(Scene, AMirrorImageOfV1) {
  const auto picture = [](const std::string& dialect) {
    BuildOptions options;
    options.dialect = dialectByName(dialect);
    return test::renderText(
        "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\"\n"
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "PixelFilter \"box\" Sampler \"random\" SurfaceIntegrator \"whitted\" WorldBegin\n"
        "LightSource \"point\" \"point from\" [0 0 5]\nTranslate 3 0 0 Shape \"sphere\" WorldEnd",
        0, options);
  };
  const auto half = [](const Image& image, bool right) {
    double sum = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 4; ++x) sum += image.channels[1][y * 8 + x + (right ? 4 : 0)];
    return sum;
  };
  // Space is left-handed: who looks along -z with +y up has +x on the left. v1 mirrors it.
  EXPECT_GT(half(picture("v2"), false), 0);
  EXPECT_EQ(half(picture("v2"), true), 0);
  EXPECT_EQ(half(picture("v1"), false), 0);
  EXPECT_GT(half(picture("v1"), true), 0);
}

// Rays that leave a surface never meet it again: every pixel of a lit plane is lit the same,
// wherever the world is. Shadow acne would be speckle.
class Acne : public testing::TestWithParam<std::string> {};

TEST_P(Acne, NoneFarFromTheOriginNorAtAnyScale) {
  struct Place {
    const char *there, *back;
  };
  for (const auto& [place, back] :
       {Place{"", ""}, Place{"Translate 1e6 -1e6 1e6\n", "Translate -1e6 1e6 -1e6\n"},
        Place{"Scale 1e-6 1e-6 1e-6\n", "Scale 1e6 1e6 1e6\n"},
        Place{"Scale 1e6 1e6 1e6\n", "Scale 1e-6 1e-6 1e-6\n"},
        Place{"Rotate 37 1 2 3\nTranslate 1e4 0 0\n", "Translate -1e4 0 0\nRotate -37 1 2 3\n"}}) {
    const std::string scene = R"(
      LookAt 0 3 5  0 0 0  0 1 0
      )" + std::string(back) + R"(
      Camera "perspective" "float fov" 40
      Film "image" "integer xresolution" 40 "integer yresolution" 40
      Sampler "stratified" Integrator "whitted"
      WorldBegin
      )" + place + R"(
      LightSource "distant" "point from" [0 1 0.01] "point to" [0 0 0]
      Material "matte" "rgb Kd" [1 1 1]
      )" + GetParam() + "\nWorldEnd";
    const Image image = test::renderText(scene);
    float lo = kInfinity, hi = 0;
    for (std::size_t i = 0; i < image.channels[1].size(); ++i)
      if (image.channels[3][i] == 1) {
        lo = std::min(lo, image.channels[1][i]);
        hi = std::max(hi, image.channels[1][i]);
      }
    EXPECT_GT(hi, 0.3F) << place;
    EXPECT_GT(lo, 0.999F * hi) << place;
  }
}

INSTANTIATE_TEST_SUITE_P(Planes, Acne,
                         testing::Values("Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
                                         "\"point P\" [-9 0 -9  -9 0 9  9 0 9  9 0 -9]",
                                         "Rotate -90 1 0 0 Shape \"disk\" \"float radius\" 9"),
                         [](const auto& test) { return test.index == 0 ? "Mesh" : "Disk"; });

TEST(Scene, RaysOutOfReachMeetNothing) {
  const auto scene = test::buildText("WorldBegin Shape \"sphere\" WorldEnd");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Ray good{{0, 0, -5}, 0, {0, 0, 1}};
  const std::array<Ray, 4> rays{{{{3e38F, 0, 0}, 0, {-1, 0, 0}},
                                 {{0, 0, -5}, 0, {0, 0, 3e38F}},
                                 {{0, 0, nan}, 0, {0, 0, 1}},
                                 good}};
  std::array<const Ray*, 4> pointers{};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    pointers[i] = &rays[i];
    EXPECT_EQ(scene->intersect(rays[i]).found(), i == 3);
    EXPECT_EQ(scene->occluded(rays[i]), i == 3);
  }
  std::array<Hit, 4> hits;
  scene->intersect(pointers, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(hits[i].found(), i == 3);
  EXPECT_EQ(scene->occluded(rays), 1U << 3);
}

TEST(Scene, AnInstanceTooSmallToTraceIsRefused) {
  const auto instance = [](const std::string& scale) {
    return test::buildText(
        "WorldBegin ObjectBegin \"o\" Shape \"sphere\" ObjectEnd Shape \"disk\"\n"
        "Scale " +
        scale + " ObjectInstance \"o\" WorldEnd");
  };
  EXPECT_NO_THROW(instance("1e-6 1e-6 1e-6"));
  EXPECT_THROW(instance("1e-25 1e-25 1e-25"), Error);
}

TEST(Scene, OpensExactlyThePluginsThatItNames) {
  PluginLoader plugins({PBRT_BUILD_DIR "/lib/pbrt"});
  test::buildText(
      "PixelFilter \"triangle\" Sampler \"halton\" Integrator \"whitted\" Camera \"orthographic\"\n"
      "WorldBegin\nLightSource \"spot\"\n"
      "Texture \"unused\" \"float\" \"checkerboard\"\nMakeNamedMaterial \"unused\" \"string type\" "
      "\"glass\"\nMaterial \"plastic\"\nObjectBegin \"unused\" Shape \"disk\" ObjectEnd\n"
      "Material \"mirror\" Shape \"sphere\"\nWorldEnd",
      {}, plugins);
  std::set<std::string> opened;
  for (const LoadedPlugin& plugin : plugins.opened()) opened.insert(plugin.info->name);
  EXPECT_EQ(opened, (std::set<std::string>{"triangle", "halton", "whitted", "orthographic", "spot",
                                           "mirror", "sphere"}));
}

TEST(Scene, AShapesParametersGoBeforeItsMaterials) {
  const std::string light = "LightSource \"point\" \"rgb I\" [8 8 8] \"point from\" [0 0 2]\n";
  const double red =
      test::mean(test::renderText(lookDown(light + "Material \"matte\" \"rgb Kd\" [0 0 1]\n"
                                                   "Shape \"disk\" \"rgb Kd\" [1 0 0]\n")),
                 "R");
  EXPECT_NEAR(red, 1 / kPi * 8 / 4, 1e-4);
}

}  // namespace
}  // namespace pbrt
