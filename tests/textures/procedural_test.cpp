// Textures that are computed.

#include "core/base/noise.h"
#include "core/base/rng.h"
#include "tests/textures/library.h"

namespace pbrt::test {
namespace {

SurfaceInteraction uvAt(float u, float v) {
  SurfaceInteraction s;
  s.uv = {u, v};
  return s;
}
SurfaceInteraction pointAt(const Point3& p) {
  SurfaceInteraction s;
  s.p = p;
  return s;
}

TEST(Mix, IsBetween) {
  const auto half = make<Texture<float>>("mix");
  EXPECT_EQ(half->evaluate(uvAt(0, 0)), 0.5F);
  const auto mix = make<Texture<Spectrum>>(
      "mix", {rgb("tex1", 1, 2, 3), rgb("tex2", 5, 6, 7), number("amount", 0.25F)});
  EXPECT_EQ(mix->evaluate(uvAt(0, 0)), Spectrum(2, 3, 4));
  // The ramp is u.
  EXPECT_EQ(makeOver<float>("mix", {ramp("amount"), number("tex1", 2), number("tex2", 4)})
                ->evaluate(uvAt(0.75F, 0)),
            3.5F);
  EXPECT_EQ(makeOver<float>("mix", {ramp("tex2"), number("amount", 1)})->evaluate(uvAt(0.3F, 0)),
            0.3F);
  for (const char* name : {"tex1", "tex2", "amount"})
    EXPECT_TRUE(makeOver<float>("mix", {ramp(name)})->filters());
  EXPECT_FALSE(half->filters());
}

TEST(DirectionMix, GoesByTheNormal) {
  const auto mix = make<Texture<float>>("directionmix", {number("tex1", 2), number("tex2", 10)},
                                        {Transform::rotate(90, {1, 0, 0})});  // +y is +z
  const auto value = [&](const Normal3& n) {
    SurfaceInteraction s;
    s.n = n;
    return mix->evaluate(s);
  };
  EXPECT_NEAR(value({0, 0, 1}), 2, 1e-5);
  EXPECT_NEAR(value({0, 0, -1}), 2, 1e-5);
  EXPECT_NEAR(value({0, 1, 0}), 10, 1e-5);
  EXPECT_NEAR(value({0.8F, 0, 0.6F}), 10 - 0.6F * 8, 1e-5);
  EXPECT_THROW(make<Texture<float>>("directionmix",
                                    {pbrt::test::value(ParamType::vector3, "dir", {0, 0, 0})}),
               Error);
}

TEST(Bilerp, ReachesItsCorners) {
  const auto t = make<Texture<float>>(
      "bilerp", {number("v00", 1), number("v01", 2), number("v10", 3), number("v11", 7)});
  EXPECT_EQ(t->evaluate(uvAt(0, 0)), 1);
  EXPECT_EQ(t->evaluate(uvAt(0, 1)), 2);
  EXPECT_EQ(t->evaluate(uvAt(1, 0)), 3);
  EXPECT_EQ(t->evaluate(uvAt(1, 1)), 7);
  EXPECT_EQ(t->evaluate(uvAt(0.5F, 0.5F)), 3.25F);
  EXPECT_EQ(make<Texture<Spectrum>>("bilerp", {rgb("v00", 1, 2, 3)})->evaluate(uvAt(0, 0)),
            Spectrum(1, 2, 3));
  EXPECT_EQ(make<Texture<float>>("bilerp", {number("vscale", 0.5F)})->evaluate(uvAt(0, 1)), 0.5F);
}

TEST(Uv, ShowsTheFraction) {
  const auto t = make<Texture<Spectrum>>("uv", {number("uscale", 2), number("vdelta", -1)});
  EXPECT_EQ(t->evaluate(uvAt(1.125F, 0.75F)), Spectrum(0.25F, 0.75F, 0));
  EXPECT_THROW(make<Texture<float>>("uv"), Error);
}

// A dot takes pi 0.35^2 of its cell, and the cells in whose middle noise is above zero have one.
TEST(Dots, CoverAShare) {
  const auto dots = make<Texture<float>>("dots");
  Rng rng(1);
  int inside = 0;
  std::array<bool, 2> empty{true, true};
  for (int i = 0; i < 200000; ++i)
    inside += dots->evaluate(uvAt(256 * rng.uniform(), 256 * rng.uniform())) == 1;
  int cells = 0;
  for (int x = 0; x < 256; ++x)
    for (int y = 0; y < 256; ++y) cells += noise({x + 0.5, y + 0.5, 0.5}) > 0;
  EXPECT_NEAR(inside / 200000.0, cells / 65536.0 * std::numbers::pi * 0.35 * 0.35, 0.004);
  // One dot a cell at most, as wide as that, and none reaches out of its cell.
  for (int cell = 0; cell < 100; ++cell) {
    int found = 0;
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 40; ++j) {
        const float s = (i + 0.5F) / 40 - 0.5F, t = (j + 0.5F) / 40 - 0.5F;
        const bool in = dots->evaluate(uvAt(static_cast<float>(cell) + s, 3 + t)) == 1;
        found += in;
        if (std::max(std::abs(s), std::abs(t)) > 0.499F) {
          EXPECT_FALSE(in);
        }
      }
    empty[found == 0] = false;
    if (found > 0) {
      EXPECT_NEAR(found / 1600.0, std::numbers::pi * 0.35 * 0.35, 0.02);
    }
  }
  EXPECT_FALSE(empty[0] || empty[1]);
  EXPECT_TRUE(makeOver<float>("dots", {ramp("inside")})->filters());
}

TEST(Solid, IsNoiseInItsOwnSpace) {
  const Transform placement = Transform::translate({1, 2, 3}) * Transform::scale(DVec3(2));
  const DPoint3 p(0.3, -1.7, 4.4);
  const SurfaceInteraction at = pointAt(placement.point(p));
  const auto near = [](float a, double b) { EXPECT_NEAR(a, b, 1e-4); };
  const DVec3 none(0);
  near(make<Texture<float>>("fbm", {integers("octaves", {3}), number("roughness", 0.7F)},
                            {placement})
           ->evaluate(at),
       fbm(p, none, none, 0.7F, 3));
  near(make<Texture<float>>("fbm", {}, {placement})->evaluate(at), fbm(p, none, none, 0.5F, 8));
  near(make<Texture<Spectrum>>("wrinkled", {}, {placement})->evaluate(at).y,
       turbulence(p, none, none, 0.5F, 8));
  near(make<Texture<float>>("windy", {}, {placement})->evaluate(at),
       std::abs(fbm(0.1 * p, none, none, 0.5F, 3)) * fbm(p, none, none, 0.5F, 6));
  EXPECT_EQ(make<Texture<float>>("windy", {number("scale", 0.1F)}, {placement})->evaluate(at),
            make<Texture<float>>("windy", {}, {placement})->evaluate(at));
  for (const char* name : {"fbm", "wrinkled", "windy"}) {
    EXPECT_TRUE(make<Texture<float>>(name)->filters());
    // A footprint as wide as a wave: nothing but the mean is left.
    SurfaceInteraction wide = at;
    wide.dpdx = {20, 0, 0};
    const bool wrinkled = name == std::string("wrinkled");
    EXPECT_NEAR(
        make<Texture<float>>(name, {}, {placement})->evaluate(wide),
        wrinkled ? 0.2 * (1 + 1 + 0.5 + 0.25 + 0.125 + 0.0625 + 0.03125 + 0.015625 + 1.0 / 128) : 0,
        1e-6)
        << name;
  }
}

// Without noise the layers are a function of y alone: flat where the curve ends, between the
// colours of its control points times 1.5 everywhere.
TEST(Marble, IsLayered) {
  const auto t = make<Texture<Spectrum>>("marble", {number("variation", 0), number("scale", 2)});
  for (float y = -4; y < 4; y += 0.01F) {
    const Spectrum c = t->evaluate(pointAt({3, y, 5}));
    EXPECT_EQ(c, t->evaluate(pointAt({-1, y, 9})));
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(c[i] >= 0.3F - 1e-5F && c[i] <= 0.9F + 1e-5F);
  }
  // sin = -1: the curve's first point.
  EXPECT_LT(glm::length(t->evaluate(pointAt({0, -kPi / 4, 0})) - Spectrum(0.87F, 0.87F, 0.9F)),
            1e-4F);
  EXPECT_THROW(make<Texture<float>>("marble"), Error);
}

TEST(Scale, OfPbrt4) {
  EXPECT_EQ(make<Texture<Spectrum>>("scale", {rgb("tex", 1, 2, 3), number("scale", 2)})
                ->evaluate(uvAt(0, 0)),
            Spectrum(2, 4, 6));
  EXPECT_EQ(makeOver<float>("scale", {ramp("scale"), number("tex", 2)})->evaluate(uvAt(0.25F, 0)),
            0.5F);
  EXPECT_TRUE(makeOver<Spectrum>("scale", {ramp("scale")})->filters());
}

}  // namespace
}  // namespace pbrt::test
