// Scenes under statements that take the place of their own.

#include "tools/converge/variant.h"

#include <gtest/gtest.h>

#include "core/scene/render.h"
#include "tests/scenes.h"
#include "tests/tools/measured.h"

namespace pbrt {
namespace {

using namespace test;

TEST(ReadChange, TellsLabelsFromStatements) {
  struct Case {
    const char *text, *label, *statements;
  };
  for (const Case& c : {
           Case{"", "", ""},
           {"Sampler \"random\"", "Sampler random", "Sampler \"random\""},
           {"noise=Sampler \"random\"", "noise", "Sampler \"random\""},
           {"as it is=", "as it is", ""},
           {"=Sampler \"random\"", "", "Sampler \"random\""},
           {" Integrator \"path\"\n\t\"integer maxdepth\" [ 3 ]",
            "Integrator path integer maxdepth 3",
            " Integrator \"path\"\n\t\"integer maxdepth\" [ 3 ]"},
           // A string may hold an equals sign.
           {"Sampler \"a=b\"", "Sampler a=b", "Sampler \"a=b\""},
           {"x=Sampler \"a=b\"", "x", "Sampler \"a=b\""},
       }) {
    const Change change = readChange(c.text);
    EXPECT_EQ(change.label, c.label) << c.text;
    EXPECT_EQ(change.statements, c.statements) << c.text;
  }
}

TEST(Variant, TakesTheStatementsForTheScenesOwn) {
  const std::string scene = stripes(4);
  EXPECT_EQ(variantOfText(scene).scene->sampler().samplesPerPixel(), 16);
  const Variant v = variantOfText(scene, "x=Sampler \"random\" \"integer pixelsamples\" 3");
  EXPECT_EQ(v.scene->sampler().samplesPerPixel(), 3);
  EXPECT_EQ(v.name, "scene");
  EXPECT_EQ(v.statements, "Sampler \"random\" \"integer pixelsamples\" 3");
  EXPECT_GE(v.parseSeconds, 0);
  EXPECT_GT(v.buildSeconds, 0);
  // Of two of a kind the last counts, as in a file.
  const std::string two =
      "Sampler \"random\" \"integer pixelsamples\" 3 "
      "Sampler \"random\" \"integer pixelsamples\" 5";
  EXPECT_EQ(variantOfText(scene, two).scene->sampler().samplesPerPixel(), 5);
  // A box of three pixels reaches into one more on every side.
  EXPECT_EQ(variantOfText(scene).scene->film().sampledPixels().width(), 4);
  EXPECT_EQ(variantOfText(scene, "PixelFilter \"box\" \"float xwidth\" 1.5")
                .scene->film()
                .sampledPixels()
                .width(),
            6);
}

TEST(Variant, RefusesWhatWouldBeAnotherScene) {
  for (const char* statement :
       {"Film \"image\"", "Camera \"perspective\"", "Shape \"sphere\"", "WorldBegin", "Scale 2 2 2",
        "Sampler \"random\" LightSource \"point\"", "SearchPath \"x\""}) {
    try {
      variantOfText(stripes(4), statement);
      ADD_FAILURE() << "not refused: " << statement;
    } catch (const Error& error) {
      const Diagnostic& d = error.diagnostics()[0];
      EXPECT_NE(d.message.find("cannot be changed here"), std::string::npos) << d.message;
      EXPECT_EQ(d.file, "--with");
      EXPECT_EQ(d.line, 1U);
      EXPECT_EQ(d.column, std::string(statement).starts_with("Sampler") ? 18U : 1U);
    }
  }
  EXPECT_THROW(variantOfText(stripes(4), "Sampler \"rnadom\""), Error);
  EXPECT_THROW(variantOfText(stripes(4), "nonsense"), Error);
}

// The default picture tells the dialect: 640 pixels wide in v2, 1280 in v3.
TEST(Variant, KeepsTheDialectOfTheScene) {
  const std::string scene = "WorldBegin\nShape \"sphere\"\nWorldEnd\n";
  const auto width = [](const Variant& v) { return v.scene->film().resolution().x; };
  EXPECT_EQ(width(variantOfText(scene)), 640);
  EXPECT_EQ(width(variantOfText(scene, "Integrator \"whitted\"")), 640)
      << "in the file, this statement would make it v3";
  EXPECT_EQ(width(variantOfText("Integrator \"path\" " + scene, "SurfaceIntegrator \"whitted\"")),
            1280);
  const Folder folder;
  folder.write("scene.pbrt", scene);
  BuildOptions options;
  options.dialect = Dialect::v3;
  EXPECT_EQ(width(buildVariant(folder.path() / "scene.pbrt", {}, loader(), options)), 1280);
}

// A light seen in one mirror: pbrt-v1's maxdepth counts mirrors, v2's rays.
TEST(Variant, ReadsParametersAsTheDialectOfTheSceneHasThem) {
  const std::string scene = R"(Film "image" "integer xresolution" 4 "integer yresolution" 4
Sampler "random" "integer pixelsamples" 1
PixelFilter "box"
WorldBegin
AttributeBegin
AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" "true"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-99 -99 -1 99 -99 -1 99 99 -1 -99 99 -1]
AttributeEnd
Material "mirror" "rgb Kr" [1 1 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-99 -99 1 99 -99 1 99 99 1 -99 99 1]
WorldEnd
)";
  const auto brightness = [](const Variant& v) { return mean(renderScene(*v.scene), "G"); };
  const std::string change = "SurfaceIntegrator \"whitted\" \"integer maxdepth\" 1";
  EXPECT_EQ(brightness(variantOfText(scene, change)), 0);
  EXPECT_NEAR(brightness(variantOfText("SearchPath \".\"\n" + scene, change)), 1, 1e-6);
}

TEST(Variant, WithoutAWorldIsRefusedAsEver) {
  try {
    variantOfText("Camera \"perspective\"", "Sampler \"random\"");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("WorldBegin"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pbrt
