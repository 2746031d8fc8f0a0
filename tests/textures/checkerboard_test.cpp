#include "core/base/rng.h"
#include "tests/textures/library.h"

namespace pbrt::test {
namespace {

SurfaceInteraction at(float u, float v, float halfWidth = 0, float halfHeight = 0) {
  SurfaceInteraction s;
  s.uv = {u, v};
  s.dudx = halfWidth;
  s.dvdy = -halfHeight;
  return s;
}

double point(double s, double t) {
  return std::fmod(std::floor(s) + std::floor(t), 2) == 0 ? 1 : 0;
}

TEST(Checkerboard, Alternates) {
  for (const char* mode : {"none", "closedform", "supersample"}) {
    const auto board = make<Texture<float>>("checkerboard", {text("aamode", mode)});
    for (float s = -3.5F; s < 4; ++s)
      for (float t = -3.5F; t < 4; ++t) EXPECT_EQ(board->evaluate(at(s, t)), point(s, t));
  }
}

// The closed form is the mean over the footprint's box.
TEST(Checkerboard, ClosedFormIsTheBoxAverage) {
  const auto board = make<Texture<float>>("checkerboard");
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const float s = 10 * rng.uniform() - 5, t = 10 * rng.uniform() - 5;
    const float w = rng.uniform(), h = i % 3 ? rng.uniform() : 1e-6F;
    double sum = 0;
    constexpr int n = 300;
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        sum += point(s + w * (2 * (x + 0.5) / n - 1), t + h * (2 * (y + 0.5) / n - 1));
    EXPECT_NEAR(board->evaluate(at(s, t, w, h)), sum / (n * n), 0.015) << s << " " << t;
  }
}

TEST(Checkerboard, ClosedFormFarAway) {
  const auto board = make<Texture<float>>("checkerboard");
  for (const float u : {1e5F, 1e6F, -4e6F})
    EXPECT_NEAR(board->evaluate(at(u, 0.5F, 0.5F, 0.1F)), 0.5, 0.01) << u;
}

TEST(Checkerboard, WideFootprintsAreGrey) {
  const auto board =
      make<Texture<Spectrum>>("checkerboard", {rgb("tex1", 1, 0, 0), rgb("tex2", 0, 0, 1)});
  EXPECT_EQ(board->evaluate(at(0.3F, 0.2F, 1.5F, 0)), Spectrum(0.5F, 0, 0.5F));
  EXPECT_EQ(board->evaluate(at(0.3F, 0.2F, 0, 3)), Spectrum(0.5F, 0, 0.5F));
}

TEST(Checkerboard, FiltersOnlyIfItNeedsTo) {
  EXPECT_TRUE(make<Texture<float>>("checkerboard")->filters());
  EXPECT_FALSE(make<Texture<float>>("checkerboard", {text("aamode", "none")})->filters());
  EXPECT_FALSE(make<Texture<float>>("checkerboard", {integers("dimension", {3})})->filters());
  EXPECT_TRUE(makeOver<float>("checkerboard", {ramp("tex1"), text("aamode", "none")})->filters());
}

TEST(Checkerboard, MappingIsApplied) {
  const auto scaled = make<Texture<float>>(
      "checkerboard", {number("uscale", 8), number("vscale", 4), number("udelta", 1)});
  EXPECT_EQ(scaled->evaluate(at(0.05F, 0.05F)), 0);
  EXPECT_EQ(scaled->evaluate(at(0.15F, 0.05F)), 1);
  EXPECT_EQ(scaled->evaluate(at(0.15F, 0.3F)), 0);

  const auto planar = make<Texture<float>>(
      "checkerboard", {text("mapping", "planar"), value(ParamType::vector3, "v1", {0, 0, 2})},
      {Transform::translate({0, 0, 10})});
  SurfaceInteraction s;
  s.p = {0, 0.5F, 10.25F};
  EXPECT_EQ(planar->evaluate(s), 1);
  s.p.z = 10.75F;
  EXPECT_EQ(planar->evaluate(s), 0);
}

TEST(Checkerboard, CubesInTextureSpace) {
  const Transform placement = Transform::translate({1, 2, 3}) * Transform::rotate(30, {1, 1, 0}) *
                              Transform::scale({2, 2, 2});
  const auto board =
      make<Texture<float>>("checkerboard", {integers("dimension", {3})}, {placement});
  for (double x = -1.5; x < 2; ++x)
    for (double y = -1.5; y < 2; ++y)
      for (double z = -1.5; z < 2; ++z) {
        SurfaceInteraction s;
        s.p = placement.point({x, y, z});
        const bool even = std::fmod(std::floor(x) + std::floor(y) + std::floor(z), 2) == 0;
        EXPECT_EQ(board->evaluate(s), even ? 1 : 0);
      }
}

TEST(Checkerboard, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(make<Texture<float>>("checkerboard", {integers("dimension", {4})}), Error);
  EXPECT_THROW(make<Texture<float>>("checkerboard", {text("aamode", "magic")}), Error);
  EXPECT_THROW(make<Texture<float>>("checkerboard", {text("mapping", "conical")}), Error);
}

TEST(Checkerboard, DescribesAllMappings) {
  std::vector<Declaration> declared;
  Params p = Params::describing("textures/checkerboard", declared);
  create<Texture<float>>(loader().open(PluginKind::texture, "checkerboard"), p, {});
  for (const char* name : {"dimension", "tex1", "tex2", "mapping", "uscale", "vscale", "udelta",
                           "vdelta", "v1", "v2", "aamode"})
    EXPECT_EQ(std::count_if(declared.begin(), declared.end(),
                            [&](const Declaration& d) { return d.name == name; }),
              1)
        << name;
}

}  // namespace
}  // namespace pbrt::test
