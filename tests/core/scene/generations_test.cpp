// What only one generation of the scene format has: read as that generation means it.

#include "tests/scenes.h"

namespace pbrt {
namespace {

// A disk before the camera, lit so that a matte one shows its reflectance.
std::string v4(const std::string& statements, const std::string& options = "",
               const std::string& film = "") {
  return "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 0.001\n"
         "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1 " +
         film + "\nSampler \"independent\" \"integer pixelsamples\" 1\nIntegrator \"volpath\"\n" +
         "PixelFilter \"box\"\n" + options +
         "\nWorldBegin\nLightSource \"distant\" \"point3 from\" [0 0 1] \"point3 to\" [0 0 0]\n" +
         statements;
}

Spectrum seen(const std::string& text) {
  const Image image = test::renderText(text);
  return Spectrum(image.channels[0][0], image.channels[1][0], image.channels[2][0]) * kPi;
}

void expectColour(const Spectrum& got, const Spectrum& wanted) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-4);
}

struct Said {
  std::vector<std::string> errors, warnings;
};
Said said(const std::string& text, bool permissive = true) {
  Said all;
  BuildOptions options;
  options.permissive = permissive;
  options.report = [&](const Diagnostic& d) {
    (d.severity == Severity::error ? all.errors : all.warnings).push_back(d.message);
  };
  test::buildText(text, options);
  return all;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string kRed = "Material \"diffuse\" \"rgb reflectance\" [1 0 0]\n";
const std::string kDisk = "Shape \"disk\"\n";

TEST(V4, ASceneNeedsNoWorldEndAndSaysNothing) {
  const Said all = said(v4(kRed + kDisk), false);
  EXPECT_TRUE(all.errors.empty());
  EXPECT_TRUE(all.warnings.empty()) << all.warnings.at(0);
  expectColour(seen(v4(kRed + kDisk)), {1, 0, 0});
}

TEST(V4, AttributeGivesDefaultsUntilItsBlockEnds) {
  const std::string use = "Material \"diffuse\"\n" + kDisk;
  const std::string green = "Attribute \"material\" \"rgb reflectance\" [0 1 0]\n";
  expectColour(seen(v4(green + use)), {0, 1, 0});
  expectColour(seen(v4("AttributeBegin\n" + green + "AttributeEnd\n" + use)), Spectrum(0.5F));
  expectColour(seen(v4(green + kRed + kDisk)), {1, 0, 0});
  // The disk is moved away, so that the camera looks into nothing.
  expectColour(seen(v4(kRed +
                       "Attribute \"shape\" \"float height\" -100 \"float innerradius\" "
                       "0.99\n" +
                       kDisk)),
               {0, 0, 0});
  EXPECT_TRUE(said(v4("Attribute \"shape\" \"float nothing\" 1\n" + kDisk)).errors.empty());
  EXPECT_TRUE(contains(said(v4("Attribute \"shapes\" \"float radius\" 1")).errors.at(0),
                       "did you mean \"shape\"?"));
}

TEST(V4, AttributeOfLightsAndTextures) {
  const std::string dim = "Attribute \"light\" \"float scale\" 0.5\n";
  const std::string lamp =
      "LightSource \"distant\" \"point3 from\" [0 0 1] \"point3 to\" [0 0 0]\n";
  std::string both = v4(kRed + kDisk + dim + lamp);
  both.replace(both.find("volpath"), 7, "whitted");  // which takes light from both
  expectColour(seen(both), {1.5F, 0, 0});
  expectColour(seen(v4("Attribute \"texture\" \"rgb value\" [0 0 1]\n"
                       "Texture \"t\" \"spectrum\" \"constant\"\n"
                       "Material \"diffuse\" \"texture reflectance\" \"t\"\n" +
                       kDisk)),
               {0, 0, 1});
}

TEST(V4, ALightGivenByASpectrumHasLuminanceOne) {
  const std::string lamp =
      "LightSource \"distant\" \"spectrum L\" [300 7 800 7] \"float scale\" 2 "
      "\"point3 from\" [0 0 1] \"point3 to\" [0 0 0]\n";
  std::string text = v4("Material \"diffuse\" \"rgb reflectance\" [1 1 1]\n" + kDisk);
  const std::size_t at = text.find("LightSource"), end = text.find('\n', at) + 1;
  text.replace(at, end - at, lamp);
  EXPECT_NEAR(luminance(seen(text)), 2, 1e-3);
  BuildOptions v3;
  v3.dialect = Dialect::v3;
  const Image image = test::renderText(text, 0, v3);
  EXPECT_NEAR(luminance({image.channels[0][0], image.channels[1][0], image.channels[2][0]}) * kPi,
              14, 1e-2);
}

TEST(V4, NamesAreGlobal) {
  expectColour(seen(v4("AttributeBegin MakeNamedMaterial \"m\" \"string type\" \"diffuse\" "
                       "\"rgb reflectance\" [1 0 0] AttributeEnd NamedMaterial \"m\"\n" +
                       kDisk)),
               {1, 0, 0});
}

TEST(V4, ColorSpaceHoldsUntilItsBlockEnds) {
  const std::string grey = "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n";
  // White is white in all of them; a colour that Rec. 2020 can show and Rec. 709 cannot is clipped.
  expectColour(seen(v4("ColorSpace \"rec2020\"\n" + grey + kDisk)), Spectrum(0.5F));
  const Spectrum wide = seen(v4("ColorSpace \"rec2020\"\n" + kRed + kDisk));
  EXPECT_GT(wide.x, 1.5F);
  EXPECT_EQ(wide.y, 0);
  EXPECT_EQ(wide.z, 0);
  expectColour(seen(v4("AttributeBegin ColorSpace \"rec2020\" AttributeEnd\n" + kRed + kDisk)),
               {1, 0, 0});
  EXPECT_TRUE(contains(said(v4("ColorSpace \"rec2021\"")).errors.at(0), "did you mean"));
}

TEST(V4, TheFilmIsExposedByIsoAndShutter) {
  expectColour(seen(v4(kRed + kDisk, "", "\"float iso\" 200")), {2, 0, 0});
  std::string half = v4(kRed + kDisk);
  half.insert(half.find("\"float fov\""), "\"float shutterclose\" 0.5 ");
  expectColour(seen(half), {0.5F, 0, 0});
}

TEST(V4, OptionSetsTheSeedUnlessTheCommandLineDoes) {
  const std::string text = v4(kDisk, "Option \"integer seed\" 7\nOption \"bool wavefront\" true");
  EXPECT_EQ(test::buildText(text)->seed(), 7U);
  BuildOptions options;
  options.seed = 3;
  EXPECT_EQ(test::buildText(text, options)->seed(), 3U);
  EXPECT_TRUE(contains(said(v4("", "Option \"bool wavefrnt\" true")).errors.at(0),
                       "did you mean \"wavefront\"?"));
  EXPECT_TRUE(contains(said(v4(kDisk, "Option \"force-diffuse\" true")).warnings.at(0),
                       "\"forcediffuse\" has no effect"));
}

// Half way over the soft edge, by the cosine: 1/2, and by the fourth power 1/16.
TEST(V4, TheEdgeOfASpotIsSmoothstep) {
  const auto lamp = [](Dialect dialect) {
    const std::string statement =
        "LightSource \"spot\" \"float coneangle\" 90 \"float conedeltaangle\" 90";
    const bool v4 = dialect == Dialect::v4;
    const auto scene = test::buildText(v4 ? "Film \"rgb\" WorldBegin " + statement
                                          : "Film \"image\" Integrator \"path\" WorldBegin " +
                                                statement + " WorldEnd");
    const float x = std::sqrt(0.75F);
    return scene->lights()[0]->sample({x, 0, 0.5F}, {0, 0}).L.y /
           scene->lights()[0]->sample({0, 0, 1}, {0, 0}).L.y;
  };
  EXPECT_NEAR(lamp(Dialect::v4), 0.5, 1e-4);
  EXPECT_NEAR(lamp(Dialect::v3), 1 / 16.0, 1e-4);
}

TEST(V4, AnInterfaceGivesNoLight) {
  const std::string lamp = "AreaLightSource \"diffuse\" Material \"interface\" Translate 0 0 1\n";
  const Said all = said(v4(kRed + kDisk + lamp + kDisk), false);
  EXPECT_TRUE(contains(all.warnings.at(0), "a shape without a material gives no light"));
  expectColour(seen(v4(kRed + kDisk + lamp + kDisk)), {1, 0, 0});
}

TEST(V4, AnInterfaceIsNotSeen) {
  expectColour(seen(v4(kRed + kDisk + "Material \"interface\" Translate 0 0 1\n" + kDisk)),
               {1, 0, 0});
}

TEST(Generations, WhatAnotherHasIsRefusedByName) {
  const auto refused = [](const std::string& statement) {
    const Said all = said(v4(statement + "\n" + kDisk));
    return all.errors.empty() ? "" : all.errors[0];
  };
  EXPECT_EQ(refused("Material \"disney\""),
            "\"disney\" is a material of pbrt-v3 that is not here yet");
  EXPECT_EQ(refused("Material \"hair\""),
            "\"hair\" is a material of pbrt-v3 and v4 that is not here yet");
  EXPECT_TRUE(contains(refused("Material \"difuse\""), "did you mean \"diffuse\"?"));
}

// Depth of the texture that is asked for by the last of n.
std::string chain(int n) {
  std::string text = "Texture \"t0\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0]\n";
  for (int i = 1; i < n; ++i)
    text += "Texture \"t" + std::to_string(i) + "\" \"spectrum\" \"scale\" \"texture tex1\" \"t" +
            std::to_string(i - 1) + "\"\n";
  return text + "Material \"diffuse\" \"texture reflectance\" \"t" + std::to_string(n - 1) + "\"\n";
}

TEST(Permissive, TexturesNestOnlySoDeep) {
  EXPECT_TRUE(said(v4(chain(99) + kDisk)).errors.empty());
  const Said all = said(v4(chain(100000) + kDisk));
  ASSERT_EQ(all.errors.size(), 1U);
  EXPECT_TRUE(contains(all.errors[0], "more than 100 deep"));
}

TEST(Permissive, WhatCannotBeHadIsMagentaAndSaidOnce) {
  const Spectrum magenta(1, 0, 1);
  for (const std::string wrong : {"Material \"nothing\"\n",
                                  "Texture \"t\" \"spectrum\" \"nothing\"\nMaterial \"diffuse\" "
                                  "\"texture reflectance\" \"t\"\n",
                                  "Material \"diffuse\" \"texture reflectance\" \"nowhere\"\n",
                                  "Material \"diffuse\" \"float reflectance\" 1\n"}) {
    BuildOptions options;
    options.permissive = true;
    int errors = 0;
    options.report = [&](const Diagnostic& d) { errors += d.severity == Severity::error ? 1 : 0; };
    const Image image =
        test::renderText(v4(wrong + kDisk + "Translate 0 0 -1\n" + kDisk), 0, options);
    expectColour(Spectrum(image.channels[0][0], image.channels[1][0], image.channels[2][0]) * kPi,
                 magenta);
    EXPECT_EQ(errors, 1) << wrong;
  }
}

TEST(Permissive, AShapeWhoseLightIsWrongIsThereAndDark) {
  for (const std::string light : {"\"nothing\"", "\"point\"", "\"diffuse\" \"float nothing\" 1"}) {
    BuildOptions options;
    options.permissive = true;
    int errors = 0;
    options.report = [&](const Diagnostic& d) { errors += d.severity == Severity::error ? 1 : 0; };
    const Image image =
        test::renderText(v4("AreaLightSource " + light +
                            "\nMaterial \"diffuse\" \"rgb reflectance\" [0 0 0]\n" + kDisk),
                         0, options);
    EXPECT_EQ(test::mean(image, "A"), 1) << light;
    EXPECT_EQ(errors, 1) << light;
  }
}

TEST(Permissive, TheRestOfTheSceneIsBuilt) {
  const Said all = said(v4("Shape \"nothing\"\nLightSource \"nothing\"\nAttributeEnd\n" + kRed +
                               "Shape \"disk\" \"float nothing\" 1 \"float radios\" 1\n" + kDisk,
                           "Sampler \"nothing\"\nPixelFilter \"nothing\"\nIntegrator \"nothing\"\n"
                           "Camera \"nothing\""));
  EXPECT_EQ(all.errors.size(), 9U);
}

TEST(Permissive, WithoutItTheFirstErrorStops) {
  EXPECT_THROW(said(v4("Shape \"nothing\"\nLightSource \"nothing\"\n"), false), Error);
}

}  // namespace
}  // namespace pbrt
