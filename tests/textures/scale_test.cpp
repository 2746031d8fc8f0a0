#include "tests/textures/library.h"

namespace pbrt::test {
namespace {

TEST(Scale, IsTheProduct) {
  SurfaceInteraction at;
  at.uv = {0.5F, 0};
  EXPECT_EQ(make<Texture<float>>("scale", {number("tex1", 3), number("tex2", 4)})->evaluate(at),
            12);
  EXPECT_EQ(make<Texture<float>>("scale")->evaluate(at), 1);
  EXPECT_EQ(
      make<Texture<Spectrum>>("scale", {rgb("tex1", 1, 2, 3), number("tex2", 2)})->evaluate(at),
      Spectrum(2, 4, 6));
  EXPECT_EQ(makeOver<float>("scale", {ramp("tex1"), number("tex2", 3)})->evaluate(at), 1.5F);
}

TEST(Scale, FiltersIfAFactorDoes) {
  EXPECT_FALSE(make<Texture<float>>("scale")->filters());
  EXPECT_TRUE(makeOver<float>("scale", {ramp("tex1")})->filters());
  EXPECT_TRUE(makeOver<Spectrum>("scale", {ramp("tex2")})->filters());
}

}  // namespace
}  // namespace pbrt::test
