#include "tests/lights/pictures.h"
#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

float on(const Light& light, const Point3& p) {
  const LightSample s = light.sample(p, {0, 0});
  return s.pdf > 0 ? s.L.x * lengthSquared(p) : 0;
}

// Four by two pixels at 90 degrees: on the plane z = 1 from -2 to 2 and from -1 to 1.
TEST(Projection, ThrowsThePictureAlongZ) {
  const Folder folder;
  const std::string file = greyPicture(folder, "a.exr", 4, {1, 2, 3, 4, 5, 6, 7, 8});
  const auto light =
      make<Light>("projection", {text("mapname", file), number("fov", 90), rgb("I", 2, 2, 2)});
  EXPECT_FLOAT_EQ(on(*light, {-1.5F, -0.5F, 1}), 2);
  EXPECT_FLOAT_EQ(on(*light, {1.5F, -0.5F, 1}), 8);
  EXPECT_FLOAT_EQ(on(*light, {-1.5F, 0.5F, 1}), 10);
  EXPECT_FLOAT_EQ(on(*light, {15, 5, 10}), 16);
  EXPECT_GT(on(*light, {1.99F, 0.99F, 1}), 0);
  EXPECT_EQ(on(*light, {2.01F, 0, 1}), 0);
  EXPECT_EQ(on(*light, {0, 1.01F, 1}), 0);
  EXPECT_EQ(on(*light, {0, 0, -1}), 0);
  EXPECT_EQ(on(*light, {0, 0, 0}), 0);
}

// A picture higher than wide has its angle along x.
TEST(Projection, AngleOfTheShorterSide) {
  const Folder folder;
  const auto light = make<Light>(
      "projection",
      {text("filename", greyPicture(folder, "a.exr", 1, {1, 1, 1})), number("fov", 90)});
  EXPECT_GT(on(*light, {0.99F, 2.9F, 1}), 0);
  EXPECT_EQ(on(*light, {1.01F, 0, 1}), 0);
}

TEST(Projection, PowerIsTheFlux) {
  const Folder folder;
  std::vector<float> values;
  Rng rng(1);
  for (int i = 0; i < 24 * 16; ++i) values.push_back(rng.uniform());
  const std::string file = greyPicture(folder, "a.exr", 24, values);
  for (const float fov : {40.F, 120.F}) {
    const auto light =
        make<Light>("projection", {text("mapname", file), number("fov", fov), number("power", 7)});
    EXPECT_NEAR(flux(*light, 2), 7, 0.1) << fov;
    EXPECT_NEAR(flux(*make<Light>("projection", {number("fov", fov), number("power", 7)}), 2), 7,
                0.1);
  }
}

TEST(Projection, RefusesFlatAngles) {
  EXPECT_THROW(make<Light>("projection", {number("fov", 0)}), Error);
  EXPECT_THROW(make<Light>("projection", {number("fov", 180)}), Error);
}

}  // namespace
}  // namespace pbrt::test
