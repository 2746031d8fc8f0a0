// Statements about media: what they mean, and what is said about those that are wrong.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/cie_tables.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

using testing::HasSubstr;

struct Built {
  std::unique_ptr<Scene> scene;
  std::string said;  // warnings
};

Built build(const std::string& text, bool permissive = false) {
  Built built;
  BuildOptions options;
  options.permissive = permissive;
  options.report = [&](const Diagnostic& d) { built.said += d.message + '\n'; };
  built.scene = test::buildText(text, options);
  return built;
}

std::string failure(const std::string& text) {
  try {
    build(text);
  } catch (const Error& error) {
    std::string all;
    for (const Diagnostic& d : error.diagnostics()) {
      EXPECT_GT(d.line, 0U) << d.message;
      all += d.message + '\n';
    }
    return all;
  }
  return "";
}

std::string volpath(const std::string& world,
                    const std::string& before = "Camera \"perspective\" ") {
  return before + "Integrator \"volpath\" WorldBegin " + world +
         " LightSource \"point\" Shape \"sphere\" WorldEnd";
}
std::string regions(const std::string& world, const std::string& volume = "") {
  return "Camera \"perspective\" SurfaceIntegrator \"whitted\" " + volume + " WorldBegin " + world +
         " LightSource \"point\" Shape \"sphere\" WorldEnd";
}
std::string medium(const std::string& rest) {
  return "MakeNamedMedium \"fog\" \"string type\" " + rest + " MediumInterface \"fog\" \"\" ";
}

TEST(Media, BordersAreBuiltForThoseWhoLook) {
  const std::string world = medium("\"homogeneous\"") +
                            "AttributeBegin Material \"\" "
                            "Shape \"sphere\" AttributeEnd";
  const Built seen = build(volpath(world));
  EXPECT_EQ(seen.said, "");
  EXPECT_EQ(seen.scene->shapes(), 2U);
  EXPECT_TRUE(seen.scene->bordersMedia());
  EXPECT_EQ(seen.scene->cameraMedium(), nullptr);

  std::string text = volpath(world);
  text.replace(text.find("volpath"), 7, "path");
  const Built unseen = build(text);
  EXPECT_THAT(unseen.said, HasSubstr("sees no participating media"));
  EXPECT_EQ(unseen.said.find("sees no"), unseen.said.rfind("sees no"));
  EXPECT_EQ(unseen.scene->shapes(), 1U);
  EXPECT_FALSE(unseen.scene->bordersMedia());
}

// The same on both sides is no border.
TEST(Media, NoBorderWithoutDifference) {
  const Built same =
      build(volpath("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" "
                    "MediumInterface \"fog\" Material \"none\" Shape \"cone\" "
                    "Material \"matte\""));
  EXPECT_EQ(same.scene->shapes(), 1U);
  EXPECT_FALSE(same.scene->bordersMedia());
}

// Before the world a medium lies in the coordinates of that place; what is defined later is found.
TEST(Media, CameraIsInItsMedium) {
  const Built built = build(volpath(
      "MakeNamedMedium \"fog\" \"string type\" \"uniformgrid\" \"float density\" 1 \"point p0\" "
      "[-1 -1 -1]",
      "MakeNamedMedium \"haze\" \"string type\" \"homogeneous\" \"float scale\" 2\n"
      "Translate 0 0 5 MediumInterface \"\" \"fog\" Camera \"perspective\" Identity "));
  const Medium* fog = built.scene->cameraMedium();
  ASSERT_TRUE(fog);
  EXPECT_TRUE(fog->bounded());
  // The camera is at z = -5, and render space about it.
  EXPECT_GT(fog->at({0, 0, 5}).scattering.x, 0);
  EXPECT_EQ(fog->at({0, 0, 0}).scattering.x, 0);
}

TEST(Media, RegionsHaveTheEmissionIntegratorUnlessToldOtherwise) {
  const std::string box = "Volume \"homogeneous\" \"color sigma_a\" [1 1 1]";
  const Built built = build(regions(box));
  EXPECT_EQ(built.said, "");
  EXPECT_EQ(built.scene->regions().size(), 1U);
  EXPECT_TRUE(built.scene->volume());
  EXPECT_EQ(build(regions("")).scene->volume(), nullptr);
  EXPECT_EQ(build(regions("", "VolumeIntegrator \"single\"")).scene->volume(), nullptr);

  const Built traced = build(
      "SurfaceIntegrator \"volpath\" VolumeIntegrator \"single\" WorldBegin " + box + " WorldEnd");
  EXPECT_EQ(traced.scene->volume(), nullptr);
  EXPECT_EQ(traced.scene->regions().size(), 1U);
  EXPECT_THAT(traced.said,
              HasSubstr("without effect: the integrator traces light through volumes"));
}

TEST(Media, WhatIsWrongIsSaidWithItsPlace) {
  const auto expectFailure = [](const std::string& text, const char* message) {
    EXPECT_THAT(failure(text), HasSubstr(message)) << text;
  };
  expectFailure(volpath("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" "
                        "MediumInterface \"fogg\" \"\""),
                "there is no named medium \"fogg\"; did you mean \"fog\"?");
  expectFailure("MediumInterface \"\" \"fgo\" Camera \"perspective\" " +
                    volpath("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\""),
                "there is no named medium \"fgo\"; did you mean \"fog\"?");
  expectFailure(volpath("MakeNamedMedium \"fog\" \"float g\" 0"),
                "needs a parameter \"string type\"");
  expectFailure(volpath(medium("\"homogenous\"")), "did you mean \"homogeneous\"?");
  expectFailure(volpath(medium("\"nanovdb\"")), "not here yet");
  expectFailure(volpath(medium("\"homogeneous\" \"rgb sigma_a\" [1 -1 1]")),
                "\"sigma_a\" must not be negative, but is -1");
  expectFailure(volpath(medium("\"homogeneous\" \"float g\" 1")), "\"g\"");
  expectFailure(volpath(medium("\"homogeneous\" \"rgb Le\" [-1 0 0]")), "\"Le\"");
  expectFailure(volpath(medium("\"homogeneous\" \"string preset\" \"Whole milk\"")),
                "did you mean \"Wholemilk\"?");
  expectFailure(volpath(medium("\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 2 3]")),
                "needs 2 x 1 x 1 = 2 values, not 3");
  expectFailure(volpath(medium("\"uniformgrid\" \"float density\" [-1]")),
                "must not be negative, but is -1");
  expectFailure(volpath(medium("\"uniformgrid\"")), "needs 1 x 1 x 1 = 1 values, not 0");
  expectFailure(volpath(medium("\"uniformgrid\" \"float density\" 1 \"point p1\" [0 1 1]")),
                "makes the box flat");
  expectFailure(volpath(medium("\"uniformgrid\" \"float density\" 1 \"rgb sigma_a\" [1e30 1 1]")),
                "too dense to be traced");
  expectFailure(volpath(medium("\"homogeneous\" \"rgb sigma_a\" [1e38 1 1] \"float scale\" 100")),
                "denser than can be told");
  expectFailure(volpath(medium("\"rgbgrid\" \"rgb Le\" [1 1 1]")), "needs \"sigma_a\"");
  // Two stars: each is finite.
  expectFailure(volpath(medium("\"homogeneous\" \"blackbody Le\" [5000 3e38 5000 3e38]")),
                "must be finite");
  expectFailure(volpath(medium("\"rgbgrid\"")), "\"sigma_s\" is needed");
  expectFailure(volpath(medium("\"uniformgrid\" \"float density\" 1 \"float temperature\" 900 "
                               "\"rgb Le\" [1 1 1]")),
                "cannot be beside \"Le\"");
  expectFailure(volpath(medium("\"homogeneous\" \"float sgima\" 1")), "sgima");
  expectFailure(volpath("Material \"\" AreaLightSource \"diffuse\" "
                        "Shape \"disk\" \"float raduis\" 2"),
                "\"raduis\" is not a parameter of it");

  expectFailure(regions("Volume \"volumegrid\" \"integer ny\" 3 \"float density\" [1 2]"),
                "needs 1 x 3 x 1 = 3 values, not 2");
  expectFailure(regions("Volume \"exponential\" \"vector updir\" [0 0 0]"), "updir");
  expectFailure(regions("Volume \"homogeneous\"", "VolumeIntegrator \"path\""),
                "\"path\" is no volume integrator");
  expectFailure(regions("Volume \"homogeneous\"", "VolumeIntegrator \"singel\""),
                "did you mean \"single\"?");
  expectFailure("SurfaceIntegrator \"single\" WorldBegin Shape \"sphere\" WorldEnd",
                "it belongs to VolumeIntegrator");
  expectFailure("Volume \"homogeneous\" WorldBegin WorldEnd", "Volume belongs after WorldBegin");
}

// A permissive scene goes on in clear air.
TEST(Media, PermissiveScenesGoOn) {
  const Built built = build(volpath("MediumInterface \"fog\" \"\" "), true);
  EXPECT_THAT(built.said, HasSubstr("there is no named medium"));
  const Built region = build(regions("Volume \"homogeneous\"", "VolumeIntegrator \"path\""), true);
  EXPECT_TRUE(region.scene->volume());
}

// pbrt-v1 has nothing where v3 has milk and v4 has 1.
TEST(Media, DefaultsGoByGeneration) {
  const Built v1 = build(regions("Volume \"homogeneous\""));
  EXPECT_EQ(v1.scene->regions()[0]->at({0.5, 0.5, 0.5}).extinction(), Spectrum(0));
  const auto camera = [](const char* more) {
    return build(volpath("",
                         "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface "
                         "\"m\" Film " +
                             std::string(more) + " Camera \"perspective\" "))
        .scene->cameraMedium()
        ->at(DPoint3(0));
  };
  EXPECT_EQ(camera("\"image\"").scattering, Spectrum(2.55F, 3.21F, 3.77F));
  EXPECT_EQ(camera("\"rgb\"").scattering, Spectrum(1));
}

// In v4 a temperature counts as often as the integral of the CIE's y in nm, as what grids of
// colours emit does.
TEST(Media, UnscaledRadianceIsThatOfItsGeneration) {
  const auto emitted = [](const char* film, const std::string& type) {
    return build(volpath("", "MakeNamedMedium \"m\" \"string type\" " + type +
                                 " MediumInterface \"m\" Film " + film +
                                 " Camera \"perspective\" "))
        .scene->cameraMedium()
        ->at({0.5, 0.5, 0.5})
        .emission;
  };
  double y = 0;
  for (const auto& row : kColourMatching) y += kVisibleStep * row[1];
  const std::string grid = "\"uniformgrid\" \"rgb sigma_a\" [1 1 1] \"float density\" 1 ";
  for (const std::string& type :
       {grid + "\"float temperature\" 3000",
        std::string("\"rgbgrid\" \"rgb sigma_a\" [1 1 1] \"rgb Le\" [3 2 1]")}) {
    const Spectrum v3 = emitted("\"image\"", type), v4 = emitted("\"rgb\"", type);
    ASSERT_GT(v3.x, 0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(v4[c], y * v3[c], 1e-4 * v4[c]) << type;
  }
  EXPECT_EQ(emitted("\"rgb\"", grid + "\"rgb Le\" [3 2 1]"), Spectrum(3, 2, 1));
}

// Milk by its name, a tenth of it; what is given beside the name goes before it in v3, not in v4.
TEST(Media, PresetsAreMeasuredMedia) {
  const auto expectCream = [](const char* film, const char* more, float absorption,
                              const char* warning) {
    const Built built = build(
        volpath("",
                "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string preset\" "
                "\"Cream\" \"float scale\" 0.1 " +
                    fmt::format("{} MediumInterface \"m\" Film \"{}\" Camera \"perspective\" ",
                                more, film)));
    const MediumPoint m = built.scene->cameraMedium()->at(DPoint3(0));
    EXPECT_NEAR(m.scattering.x, 0.738, 1e-6);
    EXPECT_NEAR(m.absorption.z, absorption, 1e-6) << film;
    EXPECT_THAT(built.said, HasSubstr(warning));
  };
  const char* given = "\"rgb sigma_a\" [1 2 3]";
  expectCream("image", "", 0.00163F, "");
  expectCream("image", given, 0.3F, "takes the place of \"preset\"");
  expectCream("rgb", given, 0.00163F, "without effect beside \"preset\"");
}

// A name may be given again: what was there before keeps what it had.
TEST(Media, NamesMeanWhatWasNamedBefore) {
  const auto fog = [](const char* density) {
    return fmt::format(
        "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"float scale\" {} ", density);
  };
  const std::string balls = "ObjectBegin \"o\" Material \"\" Shape \"sphere\" ObjectEnd ";
  const std::string inFog = "MediumInterface \"fog\" \"\" ";
  const auto through = [](const std::string& world) {
    const auto scene = test::buildText(
        "LookAt 0 0 -3 0 0 0 0 1 0 Camera \"perspective\" Integrator \"volpath\" Film \"rgb\" "
        "WorldBegin LightSource \"infinite\" " +
        world);
    const RayDifferential ray(Ray{Point3(0), 0, {0, 0, 1}});
    return scene->surface(ray, scene->intersect(ray)).media->inside->at({0, 0, 3}).scattering.x;
  };
  const std::string ball = "Material \"\" Shape \"sphere\" ";
  EXPECT_EQ(through(fog("2") + inFog + ball + fog("7")), 2);
  EXPECT_EQ(through(inFog + fog("2") + ball + fog("7")), 2);
  EXPECT_EQ(through(inFog + ball + fog("2") + fog("7")), 2);
  EXPECT_EQ(through(fog("2") + inFog + fog("7") + ball), 7);
  EXPECT_EQ(through(fog("2") + inFog + balls + fog("7") + "ObjectInstance \"o\""), 2);
  EXPECT_EQ(through(fog("7") + inFog + "AttributeBegin " + fog("2") + "AttributeEnd " + ball), 2);
}

// What nobody can see is neither in the alpha nor in what is stored of surfaces.
TEST(Media, BordersAreNotSeen) {
  const auto picture = [](const std::string& world) {
    BuildOptions options;
    options.aovs = kEveryAov & ~kVariance;
    return test::renderText(
        "LookAt 0 0 -3 0 0 0 0 1 0 Camera \"perspective\" Integrator \"volpath\" Sampler "
        "\"halton\" "
        "\"integer pixelsamples\" 1 Film \"image\" \"integer xresolution\" 8 \"integer "
        "yresolution\" "
        "8 WorldBegin LightSource \"point\" " +
            world + " WorldEnd",
        0, options);
  };
  const std::string border =
      "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" \"float scale\" 0 AttributeBegin "
      "MediumInterface \"a\" \"\" Material \"\" Shape \"sphere\" AttributeEnd ";
  const std::string disk = "Translate 0 0 2 Shape \"disk\" \"float radius\" 0.7 ";
  // The disk first: its number counts.
  for (const std::string& seen : {std::string(), disk}) {
    const Image with = picture("AttributeBegin " + seen + "AttributeEnd " + border);
    const Image without = picture("AttributeBegin " + seen + "AttributeEnd ");
    for (const char* name : {"A", "Z", "N.Z", "P.X", "Albedo.G", "shape", "u"}) {
      SCOPED_TRACE(name);
      const auto *a = with.channel(name), *b = without.channel(name);
      ASSERT_TRUE(a && b);
      for (std::size_t i = 0; i < a->size(); ++i) ASSERT_NEAR((*a)[i], (*b)[i], 1e-4F);
    }
    EXPECT_EQ(test::mean(with, "A") > 0, !seen.empty());
  }
}

}  // namespace
}  // namespace pbrt
