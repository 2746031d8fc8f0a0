// What the statements of a scene file mean.

#include "core/scene/builder.h"

#include "tests/scenes.h"

namespace pbrt {
namespace {

std::string world(const std::string& statements, const std::string& options = "") {
  return "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 0.001\n"
         "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
         "Sampler \"random\" \"integer pixelsamples\" 1\nIntegrator \"whitted\"\n" +
         options +
         "\nWorldBegin\nLightSource \"distant\" \"point from\" [0 0 1] \"point to\" [0 0 0]\n" +
         statements + "\nWorldEnd\n";
}

// The colour of the pixel that looks at the origin, over that of a white surface.
Spectrum seen(const std::string& statements, const std::string& options = "") {
  const Image image = test::renderText(world(statements, options));
  return Spectrum(image.channels[0][0], image.channels[1][0], image.channels[2][0]) * kPi;
}

std::string failure(const std::string& text) {
  try {
    test::buildText(text);
  } catch (const Error& error) {
    return format(error.diagnostics().at(0));
  }
  return "";
}

std::vector<std::string> warnings(const std::string& text) {
  std::vector<std::string> found;
  BuildOptions options;
  options.report = [&](const Diagnostic& d) { found.push_back(d.message); };
  test::buildText(text, options);
  return found;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string kRed = "Material \"matte\" \"rgb Kd\" [1 0 0]\n";
const std::string kBlue = "Material \"matte\" \"rgb Kd\" [0 0 1]\n";
const std::string kDisk = "Shape \"disk\"\n";

void expectColour(const Spectrum& got, const Spectrum& wanted) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-4);
}

std::string constant(const std::string& name, const std::string& colour) {
  return "Texture \"" + name + "\" \"color\" \"constant\" \"rgb value\" [" + colour + "]\n";
}

TEST(Builder, AttributeEndRestoresMaterialTransformAndOrientation) {
  expectColour(seen(kRed + "AttributeBegin Translate 0 0 99 ReverseOrientation\n" + kBlue +
                    "AttributeEnd\n" + kDisk),
               {1, 0, 0});
  expectColour(seen(kRed + "TransformBegin Translate 99 0 0\n" + kBlue + "TransformEnd\n" + kDisk),
               {0, 0, 1});
}

TEST(Builder, TexturesAndNamedMaterialsAreScoped) {
  const std::string use = "Material \"matte\" \"texture Kd\" \"t\"\n" + kDisk;
  expectColour(seen(constant("t", "1 0 0") + "AttributeBegin\n" + constant("t", "0 0 1") +
                    "AttributeEnd\n" + use),
               {1, 0, 0});
  EXPECT_TRUE(
      contains(failure(world("AttributeBegin\n" + constant("t", "0 0 1") + "AttributeEnd\n" + use)),
               "there is no color texture \"t\""));
  EXPECT_TRUE(contains(
      failure(world("AttributeBegin MakeNamedMaterial \"m\" \"string type\" \"matte\" AttributeEnd "
                    "NamedMaterial \"m\"")),
      "there is no named material \"m\""));
}

TEST(Builder, AMaterialFindsItsTexturesAtTheShapeANamedOneAtItsStatement) {
  const std::string red = constant("t", "1 0 0"), blue = constant("t", "0 0 1");
  expectColour(seen(red + "Material \"matte\" \"texture Kd\" \"t\"\n" + blue + kDisk), {0, 0, 1});
  expectColour(
      seen(red + "MakeNamedMaterial \"m\" \"string type\" \"matte\" \"texture Kd\" \"t\"\n" + blue +
           "NamedMaterial \"m\"\n" + kDisk),
      {1, 0, 0});
}

TEST(Builder, ATextureMayNameAnEarlierOneOfItsOwnName) {
  expectColour(seen(constant("t", "0.5 0.25 1") +
                    "Texture \"t\" \"color\" \"scale\" \"texture tex1\" \"t\" \"float tex2\" 0.5\n"
                    "Material \"matte\" \"texture Kd\" \"t\"\n" +
                    kDisk),
               {0.25F, 0.125F, 0.5F});
}

TEST(Builder, WhatNothingUsesMayBeWrong) {
  expectColour(seen("Texture \"t\" \"color\" \"nowhere\"\n"
                    "MakeNamedMaterial \"m\" \"string type\" \"nothing\"\n"
                    "Material \"nothing\"\nObjectBegin \"o\" Shape \"nothing\" ObjectEnd\n" +
                    kRed + kDisk),
               {1, 0, 0});
}

TEST(Builder, BlocksMustNest) {
  EXPECT_TRUE(contains(failure(world("ObjectBegin \"o\" AttributeBegin ObjectEnd AttributeEnd")),
                       "ObjectEnd without ObjectBegin: what is open is AttributeBegin"));
  EXPECT_TRUE(contains(failure(world("ObjectBegin \"o\" AttributeEnd ObjectEnd")),
                       "AttributeEnd without AttributeBegin: what is open is ObjectBegin"));
  EXPECT_TRUE(contains(failure(world("TransformBegin AttributeEnd")), "is TransformBegin"));
  EXPECT_TRUE(contains(failure(world("ObjectEnd")), "ObjectEnd without ObjectBegin"));
  EXPECT_TRUE(contains(failure(world("ObjectBegin \"a\" ObjectBegin \"b\"")), "inside an object"));
  EXPECT_TRUE(
      contains(failure(world("ObjectBegin \"a\" ObjectInstance \"a\"")), "inside an object"));
  EXPECT_TRUE(contains(failure(world("AttributeEnd", "AttributeBegin")),
                       "WorldBegin inside AttributeBegin"));
}

TEST(Builder, ObjectsKeepTheAttributesOfTheirStatements) {
  expectColour(seen(kRed + "ObjectBegin \"o\" Translate 0 0 -1\n" + kDisk + "ObjectEnd\n" + kBlue +
                    "Translate 0 0 1 ObjectInstance \"o\""),
               {1, 0, 0});
}

TEST(Builder, RedefiningAnObjectLeavesItsInstances) {
  expectColour(seen(kRed + "ObjectBegin \"o\"\n" + kDisk + "ObjectEnd ObjectInstance \"o\"\n" +
                    "ObjectBegin \"o\" ObjectEnd ObjectInstance \"o\""),
               {1, 0, 0});
}

TEST(Builder, CoordinateSystemsFromBeforeTheWorldKeepTheirPlace) {
  // The current transform before WorldBegin maps the world to the camera, whose origin is at z = 5.
  expectColour(
      seen(kRed + "CoordSysTransform \"camera\" Translate 0 0 5 Rotate 180 0 1 0\n" + kDisk),
      {1, 0, 0});
  expectColour(seen(kRed + "Translate 9 9 9 CoordSysTransform \"world\"\n" + kDisk), {1, 0, 0});
  const std::string made = "TransformBegin Identity CoordinateSystem \"mine\" TransformEnd";
  expectColour(seen(kRed + "Translate 9 9 9 CoordSysTransform \"mine\"\n" + kDisk, made),
               {1, 0, 0});
}

TEST(Builder, OnlyAreaLightsShineFromShapes) {
  EXPECT_TRUE(contains(failure(world("AreaLightSource \"point\"\n" + kDisk)), "needs LightSource"));
  EXPECT_TRUE(
      contains(failure(world("AreaLightSource \"distant\"\n" + kDisk)), "needs LightSource"));
  EXPECT_TRUE(contains(failure(world("LightSource \"diffuse\"")), "AreaLightSource"));
}

TEST(Builder, RoundingInTheLastRowOfATransformIsNoProjection) {
  expectColour(
      seen(kRed + "ConcatTransform [1 0 0 6.9e-18 0 1 0 0 0 0 1 -1e-12 0 0 0 0.9999999]\n" + kDisk),
      {1, 0, 0});
}

TEST(Builder, MetropolisRendererIsReadAsPath) {
  const auto said =
      warnings(world(kDisk, "Renderer \"metropolis\" \"integer bootstrapsamples\" 9"));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(contains(said[0], "\"path\" takes its place")) << said[0];
}

TEST(Builder, ProjectionsAreNoTransformsOfTheWorld) {
  for (const char* name : {"Transform", "ConcatTransform"}) {
    const std::string keyword(name);
    EXPECT_TRUE(
        contains(failure(world(keyword + " [1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1]")), keyword));
    EXPECT_TRUE(contains(failure(world(keyword + " [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2]")), keyword));
    EXPECT_TRUE(contains(failure(world(keyword + " [1 0 0 0 0 0 0 0 0 0 1 0 0 0 0 1]")), "undone"));
  }
}

TEST(Builder, WhatIsTooLargeForTheRayTracerIsAnError) {
  // Both before Embree leaves it out (1e18) and after (1.8e18); the message names the shape.
  for (const std::string scale : {"1.2e18", "1e30"}) {
    const std::string shape = "Shape \"sphere\" \"float radius\" " + scale;
    for (const std::string& text :
         {shape, "ObjectBegin \"o\" " + shape + " ObjectEnd ObjectInstance \"o\""}) {
      EXPECT_TRUE(contains(failure(world(text)), "too far")) << scale;
      EXPECT_TRUE(contains(failure(world(text)), "~~~")) << scale;
    }
  }
  EXPECT_EQ(failure(world("Shape \"sphere\" \"float radius\" 9e17")), "");
  EXPECT_TRUE(contains(failure(world("Shape \"trianglemesh\" \"point P\" [0 0 0 1e25 0 0 0 1 0]")),
                       "too far"));
}

TEST(Builder, FiltersHaveASensibleReach) {
  for (const char* width : {"1e-38", "1e30"})
    EXPECT_TRUE(contains(
        failure(world(kDisk, "PixelFilter \"box\" \"float xwidth\" " + std::string(width))),
        "the filter reaches"))
        << width;
}

TEST(Builder, TexturesBelongInTheWorld) {
  EXPECT_TRUE(contains(failure(world("", constant("t", "1 1 1"))), "Texture belongs after"));
}

TEST(Builder, StandInsWarnOnceAliasesDoNot) {
  EXPECT_TRUE(warnings(world(kDisk, "Sampler \"02sequence\"")).empty());
  const auto said = warnings(world(kDisk, "Sampler \"maxmindist\""));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(contains(said[0], "\"lowdiscrepancy\" takes its place")) << said[0];
}

TEST(Builder, DarkScenesAreToldOfUnlessTheIntegratorNeedsNoLight) {
  const auto said = [](const std::string& integrator) {
    return warnings(integrator + " Camera \"perspective\" WorldBegin Shape \"disk\" WorldEnd");
  };
  ASSERT_EQ(said("Integrator \"path\"").size(), 1U) << said("Integrator \"path\"").back();
  EXPECT_TRUE(contains(said("Integrator \"path\"")[0], "no lights"));
  EXPECT_TRUE(said("Integrator \"ambientocclusion\"").empty());
  EXPECT_TRUE(said("SurfaceIntegrator \"debug\"").empty());
}

TEST(Builder, DefaultsFollowTheDialect) {
  for (const auto& [dialect, resolution, samples, kd] :
       {std::tuple{Dialect::v1, Point2i(640, 480), 4, 1.F},
        std::tuple{Dialect::v2, Point2i(640, 480), 4, 0.5F},
        std::tuple{Dialect::v3, Point2i(1280, 720), 16, 0.5F}}) {
    BuildOptions options;
    options.dialect = dialect;
    // Of v3's own integrator there is no plug-in yet.
    const auto scene = test::buildText(
        "SurfaceIntegrator \"whitted\" LookAt 0 0 5 0 0 0 0 1 0\nCamera "
        "\"perspective\"\nWorldBegin Shape \"disk\" WorldEnd",
        options);
    EXPECT_EQ(scene->film().resolution(), resolution);
    EXPECT_EQ(scene->sampler().samplesPerPixel(), samples);
    const Ray ray{Point3(0), 0, Vec3(0, 0, -1), kInfinity, 0};
    const Hit hit = scene->intersect(ray);
    ASSERT_TRUE(hit.found());
    SurfaceInteraction at = scene->surface(RayDifferential(ray), hit);
    Scratch scratch;
    EXPECT_NEAR(scene->bsdf(at, scratch).f(at.wo, at.wo).x, kd / kPi, 1e-6);
  }
}

TEST(Builder, TheCropWindowIsRoundedUpAtBothEnds) {
  const auto crop = [](const std::string& film, const BuildOptions& options) {
    return test::buildText("Film \"image\" \"integer xresolution\" 10 \"integer yresolution\" 7 " +
                               film + " SurfaceIntegrator \"whitted\" WorldBegin WorldEnd",
                           options)
        ->film()
        .crop();
  };
  EXPECT_EQ(crop("", {}), (Bounds2i{{0, 0}, {10, 7}}));
  EXPECT_EQ(crop("\"float cropwindow\" [0.21 0.75 0 0.5]", {}), (Bounds2i{{3, 0}, {8, 4}}));
  EXPECT_EQ(crop("\"float cropwindow\" [0.75 0.21 0.5 0]", {}), (Bounds2i{{3, 0}, {8, 4}}));
  BuildOptions options;
  options.cropWindow = {{-1, 0.5F, 0.5F, 2}};
  EXPECT_EQ(crop("\"float cropwindow\" [0 0.1 0 0.1]", options), (Bounds2i{{0, 4}, {5, 7}}));
  options.pixelBounds = {{-3, 4, 2, 100}};
  EXPECT_EQ(crop("", options), (Bounds2i{{0, 2}, {4, 7}})) << "pixels go before the window";
  // Windows side by side share no pixel and leave none out.
  int pixels = 0;
  for (int i = 0; i < 3; ++i) {
    BuildOptions part;
    part.cropWindow = {{static_cast<float>(i) / 3, static_cast<float>(i + 1) / 3, 0, 1}};
    pixels += crop("", part).width();
  }
  EXPECT_EQ(pixels, 10);
}

}  // namespace
}  // namespace pbrt
