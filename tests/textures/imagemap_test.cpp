// Pictures on surfaces: mapping, filters and edges.

#include "tests/textures/imagemap.h"

namespace pbrt::test {
namespace {

TEST_F(ImageMap, LowestRowIsAtTheOrigin) {
  const std::string file = grey("a.pfm", 2, {1, 2, 3, 4});
  const auto lower = texture(file), upper = texture(file, {text("origin", "upper")});
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.25F, 0.25F)), 3);
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.75F, 0.25F)), 4);
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.25F, 0.75F)), 1);
  EXPECT_FLOAT_EQ(upper->evaluate(at(0.25F, 0.25F)), 1);
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.5F, 0.5F)), 2.5F);
}

TEST_F(ImageMap, Wraps) {
  const std::string file =
      grey("a.pfm", 4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
  const auto value = [&](const char* wrap, float u, float v) {
    return texture(file, {text("wrap", wrap), text("origin", "upper")})->evaluate(at(u, v));
  };
  // Texels' centres, one row above and one column beside the picture; and far away.
  const float out = -0.125F, in = 0.375F;
  EXPECT_FLOAT_EQ(value("repeat", in, out), 14);
  EXPECT_FLOAT_EQ(value("repeat", 1.125F, in), 5);
  EXPECT_FLOAT_EQ(value("clamp", in, out), 2);
  EXPECT_FLOAT_EQ(value("clamp", 1.125F, in), 8);
  EXPECT_FLOAT_EQ(value("black", in, out), 0);
  EXPECT_FLOAT_EQ(value("octahedralsphere", in, out), 3);  // mirrored in the middle of the edge
  EXPECT_FLOAT_EQ(value("octahedralsphere", 1.125F, in), 12);
  EXPECT_FLOAT_EQ(value("repeat", 1000.375F, -999.625F), 6);
  EXPECT_FLOAT_EQ(value("clamp", 1e9F, -1e9F), 4);
  EXPECT_FLOAT_EQ(value("black", 1e9F, -1e9F), 0);
  EXPECT_FLOAT_EQ(value("black", 0, in), 2.5F);  // half way to the black beyond
}

// Whatever the size, every level has the mean of the picture; the last one is nothing else.
TEST_F(ImageMap, WideFootprintsSeeTheMean) {
  for (const Point2i size : {Point2i(8, 8), Point2i(7, 5), Point2i(1, 13), Point2i(30, 1)}) {
    const std::vector<float> values = noise(size.x * size.y);
    double mean = 0;
    for (const float v : values) mean += v / static_cast<double>(values.size());
    const std::string file = grey("m.pfm", size.x, values);
    for (const char* filter : {"point", "bilinear", "trilinear", "ewa"}) {
      const auto map = texture(file, {text("filter", filter)});
      EXPECT_NEAR(map->evaluate(at(0.3F, 0.2F, {50, 0}, {0, 50})), mean, 1e-6) << filter;
      EXPECT_NEAR(map->evaluate(at(0.3F, 0.2F, {1e9F, 3}, {-1e20F, 1e30F})), mean, 1e-6);
    }
  }
}

TEST_F(ImageMap, ConstantsStayConstant) {
  const auto map = texture(grey("c.pfm", 13, std::vector<float>(13 * 9, 0.3F)));
  Rng rng(3);
  const auto x = [&] {
    return std::exp(20 * rng.uniform() - 15) * (rng.uniform() < 0.5F ? -1 : 1);
  };
  for (int i = 0; i < 5000; ++i)
    ASSERT_NEAR(map->evaluate(at(x(), x(), {x(), x()}, {x(), x()})), 0.3F, 1e-6);
}

// The weighted mean over the ellipse by its definition, in double: texels of the finest level,
// whose pixel is two by one texels turned by 30 degrees.
TEST_F(ImageMap, EllipseIsTheGaussianMean) {
  constexpr int n = 16;
  const std::vector<float> values = noise(n * n);
  const auto map = texture(grey("e.pfm", n, values), {text("origin", "upper")});
  Rng rng(5);
  for (int k = 0; k < 50; ++k) {
    const double u = rng.uniform(), v = rng.uniform(), turn = 6 * rng.uniform();
    const double major = 0.5 + 3 * rng.uniform(),
                 minor = std::min(0.99, major) * (0.5 + 0.5 * rng.uniform());
    const glm::dvec2 p = major * glm::dvec2(std::cos(turn), std::sin(turn));
    const glm::dvec2 q = minor * glm::dvec2(-std::sin(turn), std::cos(turn));
    // The covariance of the pixel and of the texels' own filter.
    const glm::dmat2 m =
        glm::inverse(glm::outerProduct(p, p) + glm::outerProduct(q, q) + glm::dmat2(1));
    double sum = 0, weights = 0;
    for (int y = -n; y < 2 * n; ++y)
      for (int x = -n; x < 2 * n; ++x) {
        const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(u, v) * double(n);
        const double r2 = glm::dot(d, m * d);
        if (r2 >= 1) continue;
        const double w = std::exp(-2 * r2) - std::exp(-2);
        weights += w;
        sum += w * values[((y + n) % n) * n + (x + n) % n];
      }
    EXPECT_NEAR(map->evaluate(at(u, v, Vec2(p) / float(n), Vec2(q) / float(n))), sum / weights,
                5e-3);
  }
}

// A long ellipse across stripes sees grey, one along them the stripes: isotropic filters cannot.
TEST_F(ImageMap, EllipsesFollowTheFootprint) {
  std::vector<float> stripes(64 * 64);
  for (std::size_t i = 0; i < stripes.size(); ++i) stripes[i] = i % 2;
  const std::string file = grey("s.pfm", 64, stripes);
  const Vec2 along(0, 6 / 64.F), across(6 / 64.F, 0), thin(0.1F / 64, 0), low(0, 0.1F / 64);
  const float u = 33.5F / 64;  // in a bright one
  EXPECT_GT(texture(file)->evaluate(at(u, 0.5F, thin, along)), 0.7F);
  EXPECT_NEAR(texture(file)->evaluate(at(u, 0.5F, across, low)), 0.5F, 0.02F);
  EXPECT_NEAR(texture(file, {flag("trilinear", true)})->evaluate(at(u, 0.5F, thin, along)), 0.5F,
              0.02F);
  EXPECT_NEAR(texture(file, {number("maxanisotropy", 1)})->evaluate(at(u, 0.5F, thin, along)), 0.5F,
              0.02F);
  // A footprint without any width is as wide as maxanisotropy allows.
  EXPECT_GT(texture(file)->evaluate(at(u, 0.5F, Vec2(0), along)), 0.7F);
}

TEST_F(ImageMap, ScaleAndInvert) {
  const std::string file = grey("a.pfm", 1, {0.75F});
  EXPECT_FLOAT_EQ(texture(file, {number("scale", 2)})->evaluate(at(0, 0)), 1.5F);
  EXPECT_FLOAT_EQ(texture(file, {flag("invert", true)})->evaluate(at(0, 0)), 0.25F);
  EXPECT_EQ(texture<Spectrum>(file, {flag("invert", true), number("scale", 2)})->evaluate(at(0, 0)),
            Spectrum(0));
  EXPECT_FALSE(texture(file)->filters());  // one texel is the same under every footprint
  EXPECT_TRUE(texture(grey("b.pfm", 2, {1, 2}))->filters());
}

TEST_F(ImageMap, ThirtyThousandWide) {
  std::vector<float> ramp(30000 * 2);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<float>(i % 30000) / 29999;
  const auto map = texture(grey("w.pfm", 30000, ramp), {text("wrap", "clamp")});
  for (const float u : {0.1F, 0.5F, 0.77F}) {
    EXPECT_NEAR(map->evaluate(at(u, 0.5F)), u, 1e-4);
    EXPECT_NEAR(map->evaluate(at(u, 0.5F, {1e-3F, 0}, {0, 1e-3F})), u, 1e-3);
  }
}

TEST_F(ImageMap, FiniteEverywhere) {
  Rng rng(9);
  const std::string file = grey("f.pfm", 5, noise(35));
  const auto x = [&] {
    return std::exp(160 * rng.uniform() - 80) * (rng.uniform() < 0.5F ? -1 : 1);
  };
  for (const char* wrap : {"repeat", "black", "clamp", "octahedralsphere"})
    for (const char* filter : {"point", "bilinear", "trilinear", "ewa"}) {
      const auto map =
          texture(file, {text("wrap", wrap), text("filter", filter), number("maxanisotropy", 100)});
      for (int i = 0; i < 3000; ++i) {
        const float v = map->evaluate(at(x(), x(), {x(), x()}, {x(), x()}));
        ASSERT_TRUE(v >= 0 && v <= 1) << wrap << " " << filter << " " << v;
      }
      EXPECT_TRUE(
          std::isfinite(map->evaluate(at(kInfinity, -kInfinity, Vec2(kInfinity), Vec2(NAN)))));
    }
}

}  // namespace
}  // namespace pbrt::test
