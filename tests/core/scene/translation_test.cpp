#include "core/scene/translation.h"

#include "tests/support.h"

namespace pbrt {
namespace {

ParamList translated(Dialect dialect, PluginKind kind, const std::string& name, ParamList params) {
  translateParameters(dialect, kind, name, params);
  return params;
}

TEST(Translation, EveryGenerationsMaxdepthBecomesOurs) {
  const auto depth = [](Dialect dialect, const std::string& integrator) {
    const ParamList params =
        translated(dialect, PluginKind::integrator, integrator, {test::integers("maxdepth", {5})});
    return std::get<std::vector<int>>(params.at(0).values).at(0);
  };
  EXPECT_EQ(depth(Dialect::v1, "whitted"), 6);
  EXPECT_EQ(depth(Dialect::v2, "whitted"), 5);
  EXPECT_EQ(depth(Dialect::v3, "whitted"), 5);
  EXPECT_EQ(depth(Dialect::v1, "path"), 6);
  EXPECT_EQ(depth(Dialect::v2, "path"), 6);
  EXPECT_EQ(depth(Dialect::v2, "photonmap"), 6);  // which is read as path
  EXPECT_EQ(depth(Dialect::v3, "path"), 5);
  EXPECT_EQ(depth(Dialect::v4, "volpath"), 5);
}

TEST(Translation, ParametersAreRenamedDroppedAndKept) {
  const ParamList diffuse = translated(
      Dialect::v4, PluginKind::material, "diffuse",
      {test::rgb("reflectance", 1, 0, 0), test::number("displacement", 1), test::number("x", 1)});
  ASSERT_EQ(diffuse.size(), 3U);
  EXPECT_EQ(diffuse[0].name, "Kd");
  EXPECT_EQ(diffuse[1].name, "bumpmap");
  EXPECT_EQ(diffuse[2].name, "x");
  const ParamList mlt = translated(
      Dialect::v3, PluginKind::integrator, "mlt",
      {test::integers("chains", {7}), test::integers("maxdepth", {3}), test::number("sigma", 1)});
  ASSERT_EQ(mlt.size(), 1U);
  EXPECT_EQ(mlt[0].name, "maxdepth");
}

TEST(Translation, AGaussianIsAsWideByItsSigmaAsByItsAlpha) {
  const ParamList params = translated(Dialect::v4, PluginKind::filter, "gaussian",
                                      {test::number("sigma", 0.5F), test::number("xradius", 3)});
  ASSERT_EQ(params.size(), 2U);
  EXPECT_EQ(params[0].name, "alpha");
  // exp(-alpha x^2) = exp(-x^2 / (2 sigma^2)) at x = 1
  const float alpha = std::get<std::vector<float>>(params[0].values).at(0);
  EXPECT_FLOAT_EQ(std::exp(-alpha), std::exp(-1 / (2 * 0.25F)));
  EXPECT_EQ(params[1].name, "xwidth");
}

TEST(Translation, ThePowerOfAScaledPictureIsAnEncoding) {
  const auto imagemap = [](const ParamList& params) {
    return translated(Dialect::v2, PluginKind::texture, "imagemap", params);
  };
  // (3 x)^2 = 9 x^2
  const ParamList params = imagemap({test::number("scale", 3), test::number("gamma", 2)});
  ASSERT_EQ(params.size(), 2U);
  EXPECT_EQ(std::get<std::vector<float>>(params[0].values).at(0), 9);
  EXPECT_EQ(params[1].name, "encoding");
  EXPECT_EQ(params[1].type, ParamType::string);
  EXPECT_EQ(std::get<std::vector<std::string>>(params[1].values).at(0), "gamma 2");
  // pbrt-v3's says whether there is a curve, and a number that is no power is left to the plug-in.
  EXPECT_EQ(imagemap({test::flag("gamma", false)}).at(0).name, "gamma");
  EXPECT_EQ(imagemap({test::number("gamma", -1)}).at(0).name, "gamma");
}

TEST(Translation, LightSamplersOfV4AreStrategiesOfV3) {
  const ParamList params =
      translated(Dialect::v4, PluginKind::integrator, "path", {test::text("lightsampler", "bvh")});
  ASSERT_EQ(params.size(), 1U);
  EXPECT_EQ(params[0].name, "lightsamplestrategy");
  EXPECT_EQ(std::get<std::vector<std::string>>(params[0].values).at(0), "spatial");
}

// What a row promises is there: its target is a plug-in of this build, and so is every new name a
// parameter that it reads.
TEST(Translation, EveryRowLeadsSomewhere) {
  for (const Translation& t : translations()) {
    EXPECT_EQ(findTranslation(t.kind, t.name), &t) << t.name << " has two rows";
    EXPECT_TRUE(t.target.empty() || test::loader().has(t.kind, std::string(t.target)))
        << t.name << ": " << t.target;
  }
}

}  // namespace
}  // namespace pbrt
