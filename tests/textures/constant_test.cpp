#include "tests/support.h"

namespace pbrt::test {
namespace {

TEST(Constant, IsItsValue) {
  SurfaceInteraction at;
  EXPECT_EQ(make<Texture<float>>("constant", {number("value", 0.25F)})->evaluate(at), 0.25F);
  EXPECT_EQ(make<Texture<Spectrum>>("constant", {rgb("value", 1, 2, 3)})->evaluate(at),
            Spectrum(1, 2, 3));
  EXPECT_EQ(make<Texture<float>>("constant")->evaluate(at), 1);
  EXPECT_FALSE(make<Texture<float>>("constant")->filters());
}

TEST(Constant, RefusesTheOtherKind) {
  EXPECT_THROW(make<Texture<float>>("constant", {rgb("value", 1, 2, 3)}), Error);
}

}  // namespace
}  // namespace pbrt::test
