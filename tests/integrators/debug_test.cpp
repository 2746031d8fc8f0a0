// Every quantity of the debug integrator on a surface that says what it must be.

#include <fmt/format.h>

#include "tests/scenes.h"

namespace pbrt {
namespace {

// A rectangle at z = 0, 4 by 2 units, of which u and v run along the sides; seen from z = 5,
// turned by `turn` about its middle. One ray through its point (1, 0.5).
double shown(const std::string& quantity, const std::string& more = "", double turn = 0) {
  const Image image = test::renderText(fmt::format(
      "LookAt 1 0.5 5  1 0.5 0  0 1 0 Camera \"orthographic\" \"float screenwindow\" [-1e-4 1e-4 "
      "-1e-4 1e-4]\n"
      "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1 PixelFilter \"box\" "
      "Sampler \"random\" \"integer pixelsamples\" 1\n"
      "SurfaceIntegrator \"debug\" \"string red\" \"{}\" \"string green\" \"one\" WorldBegin {}\n"
      "Translate 1 0.5 0 Rotate {} 0 1 0 Translate -1 -0.5 0\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
      "\"point P\" [0 0 0  4 0 0  4 2 0  0 2 0] \"float uv\" [0 0 1 0 1 1 0 1]\n"
      "\"normal N\" [0.6 0 0.8  0.6 0 0.8  0.6 0 0.8  0.6 0 0.8] WorldEnd",
      quantity, more, turn));
  EXPECT_EQ(test::mean(image, "G"), 1);
  EXPECT_EQ(test::mean(image, "B"), 0);
  return test::mean(image, "R");
}

TEST(Debug, ShowsWhatASurfaceIs) {
  EXPECT_NEAR(shown("u"), 0.25, 1e-4);
  EXPECT_NEAR(shown("v"), 0.25, 1e-4);
  EXPECT_NEAR(shown("nz"), 1, 1e-6);
  EXPECT_NEAR(shown("nx"), 0, 1e-6);
  EXPECT_NEAR(shown("snx"), 0.6, 1e-6);
  EXPECT_NEAR(shown("snz"), 0.8, 1e-6);
  EXPECT_NEAR(shown("sny"), 0, 1e-6);
  EXPECT_EQ(shown("hit"), 1);
  EXPECT_EQ(shown("one"), 1);
  EXPECT_EQ(shown("zero"), 0);
  EXPECT_NEAR(shown("depth"), 5, 1e-5);
  EXPECT_NEAR(shown("dpdu"), 4, 1e-5);
  EXPECT_NEAR(shown("dpdv"), 2, 1e-5);
  EXPECT_EQ(shown("front"), 1);
  EXPECT_EQ(shown("shape"), 1);
  EXPECT_EQ(shown("primitive"), 0);
}

TEST(Debug, TurnsWithTheSurface) {
  EXPECT_NEAR(shown("nx", "", 30), 0.5, 1e-6);
  EXPECT_NEAR(shown("nz", "", 30), std::sqrt(0.75), 1e-6);
  EXPECT_NEAR(shown("ny", "", 30), 0, 1e-6);
  EXPECT_EQ(shown("front", "", 180), 0);
  EXPECT_EQ(shown("front", "ReverseOrientation", 180), 1);
  const std::string behind = "Translate 0 0 -9 Shape \"disk\" Translate 0 0 9 ";
  EXPECT_EQ(shown("shape", behind), 2);
}

TEST(Debug, WhereNothingIsHitAllIsZeroButOne) {
  for (const std::string quantity : {"u", "nz", "hit", "depth", "shape"})
    EXPECT_EQ(shown(quantity, "Translate 0 50 0"), 0) << quantity;
}

TEST(Debug, UnknownQuantitiesAreErrors) {
  EXPECT_THROW(test::make<Integrator>("debug", {test::text("red", "w")}), Error);
  EXPECT_NO_THROW(test::make<Integrator>("debug", {test::text("blue", "depth")}));
}

}  // namespace
}  // namespace pbrt
