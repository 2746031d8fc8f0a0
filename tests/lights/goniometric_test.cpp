#include "tests/lights/pictures.h"
#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

float towards(const Light& light, const Vec3& w) {
  const LightSample s = light.sample(w, {0, 0});
  return s.pdf > 0 ? s.L.x * lengthSquared(w) : 0;
}

// The picture's top row is +y, its columns begin at +x and go on over +z.
TEST(Goniometric, FollowsThePicture) {
  const Folder folder;
  const std::string file = greyPicture(folder, "a.exr", 4, {1, 1, 1, 1, 2, 3, 4, 5, 6, 6, 6, 6});
  const auto light =
      make<Light>("goniometric", {text("mapname", file), rgb("I", 2, 2, 2), number("scale", 3)});
  EXPECT_FLOAT_EQ(towards(*light, {0, 2, 0}), 6);
  EXPECT_FLOAT_EQ(towards(*light, {0, -3, 0}), 36);
  EXPECT_FLOAT_EQ(towards(*light, {1, 0, 1}), 12);
  EXPECT_FLOAT_EQ(towards(*light, {-1, 0, 1}), 18);
  EXPECT_FLOAT_EQ(towards(*light, {1, 0, -1}), 30);
  const auto moved =
      make<Light>("goniometric", {text("mapname", file)},
                  {Transform::translate({0, 0, 9}) * Transform::rotate(90, {1, 0, 0})});
  EXPECT_FLOAT_EQ(moved->sample({0, 0, 11}, {0, 0}).L.x * 4, 1);  // +y became +z
  EXPECT_TRUE(moved->isDelta());
}

TEST(Goniometric, EqualArea) {
  const Folder folder;
  const std::string file = greyPicture(folder, "a.exr", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  const auto light = make<Light>("goniometric", {text("filename", file)});
  EXPECT_FLOAT_EQ(towards(*light, {0, 0, 1}), 5);
  EXPECT_NEAR(towards(*light, {1, 0, 0}), 6, 1e-4);
}

TEST(Goniometric, PowerIsTheFlux) {
  const Folder folder;
  for (const char* mapping : {"latlong", "equalarea"}) {
    std::vector<float> values;
    Rng rng(1);
    for (int i = 0; i < 32 * 32; ++i) values.push_back(rng.uniform());
    const auto light =
        make<Light>("goniometric", {text("mapname", greyPicture(folder, "a.exr", 32, values)),
                                    text("mapping", mapping), number("power", 7)});
    EXPECT_NEAR(flux(*light, 2), 7, 0.1) << mapping;
  }
  EXPECT_NEAR(flux(*make<Light>("goniometric", {number("power", 7)}), 2), 7, 0.01);
  EXPECT_NEAR(flux(*make<Light>("goniometric"), 2), 4 * std::numbers::pi, 0.01);
}

// No factor makes a flux of nothing.
TEST(Goniometric, BlackStaysBlackWhateverItsPower) {
  const Folder folder;
  for (const float grey : {0.F, 1e-40F}) {
    const std::string file = greyPicture(folder, "a.exr", 2, {grey, grey, 0, 0});
    const auto light = make<Light>("goniometric", {text("mapname", file), number("power", 7)});
    EXPECT_NEAR(light->power(1), 0, 1e-30);
    EXPECT_NEAR(towards(*light, {0, 2, 0}), 0, 1e-30);
    EXPECT_EQ(towards(*light, {0, -2, 0}), 0);
  }
}

}  // namespace
}  // namespace pbrt::test
