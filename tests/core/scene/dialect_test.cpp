#include "core/scene/dialect.h"

#include <gtest/gtest.h>

#include "core/parse/format.h"
#include "core/parse/parse.h"

namespace pbrt {
namespace {

DetectedDialect detect(const std::string& text) {
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.text("test", text);
  return detectDialect(directives);
}

Dialect detected(const std::string& text) {
  return detect(text).dialect;
}

TEST(Dialect, AStatementThatOnlyOneGenerationHasDecides) {
  EXPECT_EQ(detected("SearchPath \"x\""), Dialect::v1);
  EXPECT_EQ(detected("WorldBegin Material \"shinymetal\" WorldEnd"), Dialect::v1);
  EXPECT_EQ(detected("Renderer \"sampler\" Integrator \"path\""), Dialect::v2);
  EXPECT_EQ(detected("Sampler \"02sequence\" WorldBegin WorldEnd"), Dialect::v3);
  EXPECT_EQ(detected("Film \"rgb\" WorldBegin"), Dialect::v4);
  EXPECT_EQ(detected("WorldBegin Material \"dielectric\" WorldEnd"), Dialect::v4);
  EXPECT_EQ(detected("ColorSpace \"rec2020\" WorldBegin WorldEnd"), Dialect::v4);
  EXPECT_EQ(detected("Option \"bool disablepixeljitter\" true WorldBegin WorldEnd"), Dialect::v4);
  EXPECT_EQ(detected("MakeNamedMaterial \"a\" \"string type\" \"coateddiffuse\" WorldEnd"),
            Dialect::v4);
}

TEST(Dialect, StatementsThatTwoHaveDecideTogether) {
  EXPECT_EQ(detected("SurfaceIntegrator \"path\" WorldBegin NamedMaterial \"a\" WorldEnd"),
            Dialect::v2);
  EXPECT_EQ(detected("Integrator \"path\" Film \"image\" WorldBegin WorldEnd"), Dialect::v3);
  EXPECT_EQ(detected("Integrator \"path\" WorldBegin Material \"matte\" WorldEnd"), Dialect::v3);
  EXPECT_EQ(detected("Integrator \"path\" WorldBegin LightSource \"point\" \"color I\" [1 1 1]"),
            Dialect::v3);
  EXPECT_EQ(detected("Integrator \"volpath\" Film \"rgb\" WorldBegin"), Dialect::v4);
}

TEST(Dialect, PluginsThatNotAllHaveDecide) {
  const auto world = [](const std::string& statement) {
    return detected("WorldBegin Material \"matte\" " + statement + " WorldEnd");
  };
  EXPECT_EQ(world("Shape \"sphere\""), Dialect::v2);
  EXPECT_EQ(world("Shape \"plymesh\""), Dialect::v3);
  EXPECT_EQ(world("Shape \"curve\""), Dialect::v3);
  EXPECT_EQ(world("LightSource \"infinitesample\""), Dialect::v1);
  EXPECT_EQ(detected("WorldBegin Shape \"bilinearmesh\" WorldEnd"), Dialect::v4);
  EXPECT_EQ(detected("Camera \"realistic\" \"string lensfile\" \"a.dat\" WorldBegin WorldEnd"),
            Dialect::v3);
  EXPECT_EQ(detected("WorldBegin Shape \"nurbs\""), Dialect::v2);  // v4 has none
  EXPECT_EQ(detected("SurfaceIntegrator \"bidirectional\" WorldBegin WorldEnd"), Dialect::v1);
  EXPECT_NE(detect("SurfaceIntegrator \"glossyprt\"").reason.find("glossyprt\" tells"),
            std::string::npos);
  const DetectedDialect film = detect("Film \"image\" \"bool premultiplyalpha\" \"false\"");
  EXPECT_EQ(film.dialect, Dialect::v1);
  EXPECT_EQ(film.reason, "Film's \"premultiplyalpha\" tells");
}

TEST(Dialect, BooleansWithoutQuotesAreV4s) {
  EXPECT_EQ(detected("Integrator \"path\" \"bool regularize\" true WorldBegin WorldEnd"),
            Dialect::v4);
  EXPECT_EQ(detected("Integrator \"path\" \"bool regularize\" [true] WorldBegin WorldEnd"),
            Dialect::v4);
  EXPECT_EQ(detected("Integrator \"path\" \"bool regularize\" [\"true\"] WorldBegin WorldEnd"),
            Dialect::v3);
}

TEST(Dialect, WithoutWorldEndItIsV4IfItCanBe) {
  EXPECT_EQ(detected("Integrator \"path\" WorldBegin Shape \"sphere\""), Dialect::v4);
  EXPECT_EQ(detected("Integrator \"path\" WorldBegin Shape \"sphere\" WorldEnd"), Dialect::v3);
  EXPECT_EQ(detected("WorldBegin Shape \"sphere\""), Dialect::v4);
  EXPECT_EQ(detected("SurfaceIntegrator \"path\" WorldBegin Shape \"sphere\""), Dialect::v2);
}

TEST(Dialect, AmbiguousFilesCountAsV2) {
  EXPECT_EQ(detected("SurfaceIntegrator \"whitted\" WorldBegin Material \"matte\" WorldEnd"),
            Dialect::v2);
  EXPECT_EQ(detected(""), Dialect::v2);
  EXPECT_NE(detect("SurfaceIntegrator \"whitted\"").reason.find("nothing tells it from v1"),
            std::string::npos);
}

TEST(Dialect, WhatComesFirstDecidesWhereFilesMix) {
  EXPECT_EQ(detected("Film \"rgb\" WorldBegin Material \"shinymetal\" WorldEnd"), Dialect::v4);
  EXPECT_EQ(detected("SurfaceIntegrator \"path\" SearchPath \"x\" WorldBegin ColorSpace \"srgb\""),
            Dialect::v1);
}

TEST(Dialect, SaysWhichStatementTells) {
  DialectDetector detector;
  Parser parser([&](Directive&& d) { detector.look(d); });
  parser.text("test", "LookAt 0 0 1 0 0 0 0 1 0\nFilm \"rgb\"");
  EXPECT_TRUE(detector.decided());
  EXPECT_EQ(detector.result().reason, "Film \"rgb\" tells");
  EXPECT_EQ(diagnose(Severity::note, detector.result().where, "").line, 2U);
}

// "point" is any generation's, "point3" v3's or v4's; "color" is not v4's, "rgb" not v1's.
TEST(Dialect, IsThatOfThePrintedScene) {
  for (const char* text : {"WorldBegin Shape \"sphere\" \"color Kd\" [1 0 0]",
                           "WorldBegin LightSource \"point\" \"point from\" [1 2 3] WorldEnd",
                           "WorldBegin Shape \"sphere\" \"bool b\" true"}) {
    std::string printed;
    Formatter formatter;
    Parser parser([&](Directive&& d) { printed += formatter.print(d); });
    parser.text("test", text);
    EXPECT_EQ(detected(printed), detected(text)) << printed;
  }
}

TEST(Dialect, NamesRoundTrip) {
  for (const Dialect d : {Dialect::v1, Dialect::v2, Dialect::v3, Dialect::v4})
    EXPECT_EQ(dialectByName(dialectName(d)), d);
  EXPECT_FALSE(dialectByName("v9"));
}

}  // namespace
}  // namespace pbrt
