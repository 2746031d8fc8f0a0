#include "core/base/sphere_map.h"
#include "tests/chi_square.h"
#include "tests/lights/pictures.h"
#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

class Infinite : public testing::Test {
 protected:
  // Few bright pixels among dim ones and black ones.
  std::string picture(int w, int h) const {
    Rng rng(3);
    std::vector<float> values;
    for (int i = 0; i < w * h; ++i) {
      const float u = rng.uniform();
      values.push_back(u < 0.3F ? 0 : u < 0.9F ? u : 30 * u);
    }
    return greyPicture(folder, "p.exr", w, values);
  }
  Folder folder;
};

// E = pi L on every surface, whichever way it is turned.
TEST_F(Infinite, OneColour) {
  const auto light = make<Light>("infinite", {rgb("L", 1, 2, 3), number("scale", 2)});
  EXPECT_TRUE(light->isInfinite());
  EXPECT_FALSE(light->isDelta());
  for (const Normal3 n : {Normal3(0, 0, 1), Normal3(0.6F, 0, -0.8F)}) {
    const Spectrum E = irradiance(*light, {1, 2, 3}, n, 400000);
    EXPECT_NEAR(E.x, 2 * kPi, 0.03);
    EXPECT_NEAR(E.z, 6 * kPi, 0.09);
  }
  const Vec3 w = glm::normalize(Vec3(1, -2, 3));
  EXPECT_EQ(light->escaped(w), Spectrum(2, 4, 6));
  EXPECT_FLOAT_EQ(light->pdfEscaped(w), 1 / (4 * kPi));
}

// Row and column of the picture that a direction of light space sees.
TEST_F(Infinite, WhereThePictureIs) {
  // Three rows about +z, the horizon and -z; four columns from +x over +y.
  const std::string file = greyPicture(folder, "a.exr", 4, {1, 1, 1, 1, 2, 3, 4, 5, 6, 6, 6, 6});
  const auto light = make<Light>("infinite", {text("mapname", file)});
  const auto seen = [&](Vec3 w) { return light->escaped(glm::normalize(w)).x; };
  EXPECT_FLOAT_EQ(seen({0, 0, 1}), 1);
  EXPECT_FLOAT_EQ(seen({0, 0, -1}), 6);
  EXPECT_FLOAT_EQ(seen({1, 1, 0}), 2);
  EXPECT_FLOAT_EQ(seen({-1, 1, 0}), 3);
  EXPECT_FLOAT_EQ(seen({-1, -1, 0}), 4);
  EXPECT_FLOAT_EQ(seen({1, -1, 0}), 5);
  EXPECT_NEAR(seen({1, 0, 0}), 3.5F, 1e-5);  // over the seam

  // pbrt-v4's: +z in the middle, -z at the corners.
  const std::string square = greyPicture(folder, "b.exr", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  const auto equalArea = make<Light>("infinite", {text("filename", square)});
  EXPECT_FLOAT_EQ(equalArea->escaped({0, 0, 1}).x, 5);
  EXPECT_NEAR(equalArea->escaped({1, 0, 0}).x, 6, 1e-4);   // the middle of the right edge
  EXPECT_NEAR(equalArea->escaped({0, -1, 0}).x, 2, 1e-4);  // of the upper edge
  EXPECT_NEAR(equalArea->escaped({0, 0, -1}).x, 5,
              1e-4);  // where the four corners meet: their mean
  // The same picture under the other name is a latlong one, unless it says so.
  EXPECT_FLOAT_EQ(make<Light>("infinite", {text("mapname", square)})->escaped({0, 0, 1}).x,
                  lerp(0.5F, 1, 3));
  EXPECT_FLOAT_EQ(make<Light>("infinite", {text("mapname", square), text("mapping", "equalarea")})
                      ->escaped({0, 0, 1})
                      .x,
                  5);
}

Transform turned() {
  return Transform::rotate(40, {1, 2, 3}) * Transform::scale({-1, 1, 1});
}
Transform stretched() {
  return Transform::rotate(30, {2, 0, 1}) * Transform::scale({1, 2, 0.7}) *
         Transform::rotate(60, {0, 1, 1});
}

// Pearson's test over boxes of equal solid angle: the samples follow the density that it states.
TEST_F(Infinite, SamplesFollowTheDensity) {
  for (const char* mapping : {"latlong", "equalarea"})
    for (const Transform& map : {turned(), stretched()}) {
      const auto light = make<Light>(
          "infinite", {text("mapname", picture(8, 8)), text("mapping", mapping)}, {map});
      constexpr int n = 24, fine = 24, samples = 200000;
      std::vector<double> expected(n * n), counts(n * n);
      double total = 0;
      for (int i = 0; i < n * fine; ++i)
        for (int j = 0; j < n * fine; ++j) {
          const Vec3 w = uniformSphere({(i + 0.5F) / (n * fine), (j + 0.5F) / (n * fine)});
          const double share = light->pdfEscaped(w) * 4 * std::numbers::pi / (n * fine * n * fine);
          total += share;
          expected[i / fine * n + j / fine] += share * samples;
        }
      EXPECT_NEAR(total, 1, 2e-3) << mapping;
      Rng rng(4);
      for (int k = 0; k < samples; ++k) {
        const LightSample s = light->sample(Point3(0), {rng.uniform(), rng.uniform()});
        ASSERT_GT(s.pdf, 0);
        const double phi = std::atan2(s.wi.y, s.wi.x) / (2 * std::numbers::pi);
        const int i = std::clamp(static_cast<int>((1 - s.wi.z) / 2 * n), 0, n - 1);
        const int j = std::clamp(static_cast<int>((phi < 0 ? phi + 1 : phi) * n), 0, n - 1);
        ++counts[i * n + j];
      }
      std::vector<double> seen, wanted;
      for (int c = 0; c < n * n; ++c)
        if (expected[c] > 10) {
          seen.push_back(counts[c]);
          wanted.push_back(expected[c]);
        }
      // The integral of the density over a box is itself not exact to more than about 1 %.
      EXPECT_LT(chiSquareDeviation(seen, wanted), 5) << mapping;
    }
}

TEST_F(Infinite, BothStrategiesAgree) {
  for (const char* mapping : {"latlong", "equalarea"}) {
    const auto light = make<Light>(
        "infinite", {text("mapname", picture(16, 16)), text("mapping", mapping)}, {stretched()});
    Rng rng(5);
    int borders = 0;
    for (int i = 0; i < 5000; ++i) {
      const LightSample s = light->sample(Point3(1), {rng.uniform(), rng.uniform()});
      ASSERT_NEAR(glm::length(s.wi), 1, 1e-6);
      ASSERT_NEAR(light->escaped(s.wi).x, s.L.x, 1e-3F + 1e-3F * s.L.x);
      borders += std::abs(light->pdfEscaped(s.wi) - s.pdf) > 1e-4F * s.pdf;
    }
    EXPECT_LT(borders, 5);  // where rounding takes the direction to the next cell
    // Light is sampled wherever there is any.
    for (int i = 0; i < 5000; ++i) {
      const Vec3 w = uniformSphere({rng.uniform(), rng.uniform()});
      if (light->escaped(w).x > 0) {
        ASSERT_GT(light->pdfEscaped(w), 0);
      }
    }
  }
}

// By samples of the light and by counting pixels.
TEST_F(Infinite, IrradianceIsThatOfThePicture) {
  for (const char* mapping : {"latlong", "equalarea"}) {
    const auto light =
        make<Light>("infinite", {text("mapname", picture(16, 16)), text("mapping", mapping)});
    constexpr int n = 700;
    double expected = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Vec3 w = cosHemisphere({(i + 0.5F) / n, (j + 0.5F) / n});
        expected += light->escaped(w).x * std::numbers::pi / (n * n);
      }
    EXPECT_NEAR(irradiance(*light, Point3(0), {0, 0, 1}, 200000).x, expected, 0.01 * expected);
  }
}

TEST_F(Infinite, Illuminance) {
  const auto plain = make<Light>("infinite", {number("illuminance", 5)});
  EXPECT_NEAR(irradiance(*plain, Point3(0), {0, 0, 1}, 200000).x, 5, 0.05);
  for (const char* mapping : {"latlong", "equalarea"}) {
    const auto light = make<Light>(
        "infinite",
        {text("mapname", picture(32, 32)), text("mapping", mapping), number("illuminance", 5)});
    EXPECT_NEAR(irradiance(*light, Point3(0), {0, 0, 1}, 200000).x, 5, 0.1) << mapping;
  }
  EXPECT_EQ(make<Light>("infinite", {number("illuminance", -1)})->escaped({0, 0, 1}), Spectrum(1));
}

// Where the half about +z is black, no factor gives it its illuminance.
TEST_F(Infinite, DarkHalvesStayDark) {
  const std::string file = greyPicture(folder, "h.exr", 2, {0, 0, 0, 0, 0, 0, 1, 1});
  const auto plain = make<Light>("infinite", {text("mapname", file)});
  const auto light = make<Light>("infinite", {text("mapname", file), number("illuminance", 5)});
  EXPECT_EQ(light->power(1), plain->power(1));
  EXPECT_EQ(light->escaped({0, 0, 1}), Spectrum(0));
  EXPECT_EQ(light->escaped({0, 0, -1}), Spectrum(1));
}

TEST_F(Infinite, BlackPicturesGiveNoSamples) {
  const auto light =
      make<Light>("infinite", {text("mapname", greyPicture(folder, "b.exr", 2, {0, 0, 0, 0}))});
  EXPECT_EQ(light->sample(Point3(0), {0.5F, 0.5F}).pdf, 0);
  EXPECT_EQ(light->pdfEscaped({0, 0, 1}), 0);
}

// One texel of 4096 x 2048 burns. Between texels the light is interpolated: the four about it and
// those beside them share it, and its integral over the picture is that of the texel.
TEST_F(Infinite, OneBurningTexel) {
  constexpr int w = 4096, h = 2048, column = 3000, row = 700;
  const auto lightOf = [&](float sky, float sun) {
    std::vector<float> values(w * h, sky);  // rows from the bottom
    values[(h - 1 - row) * w + column] = sun;
    std::string pfm = "Pf 4096 2048 -1\n";
    pfm.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    folder.write("sun.pfm", pfm);
    return make<Light>("infinite", {text("mapname", (folder.path() / "sun.pfm").string())});
  };
  const double pi = std::numbers::pi, theta = pi * (row + 0.5) / h;
  const double phi = 2 * pi * (column + 0.5) / w, angle = pi / h * 2 * pi / w * std::sin(theta);
  const Vec3 sun(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  for (const float sky : {0.F, 1e-3F}) {
    const auto light = lightOf(sky, 1e6F);
    double sum = 0, squares = 0;
    Rng rng(8);
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const LightSample s = light->sample(Point3(0), {rng.uniform(), rng.uniform()});
      ASSERT_GT(s.pdf, 0);
      if (sky == 0) {
        ASSERT_LT(glm::length(s.wi - sun), 2.2 * pi / h);
      }
      const double E = double{s.L.y} * std::max(0.F, s.wi.z) / s.pdf;
      sum += E;
      squares += E * E;
    }
    const double expected = 1e6 * angle * std::cos(theta) + sky * pi, mean = sum / n;
    const double error = std::sqrt((squares / n - mean * mean) / n);
    EXPECT_NEAR(mean, expected, 4.5 * error + 1e-4 * expected);
    EXPECT_LT(error, 1.5 / std::sqrt(n) * expected);
    EXPECT_NEAR(light->power(1) / pi, 1e6 * angle + sky * 4 * pi, 1e-5 * expected);
  }
}

TEST_F(Infinite, PortalsChangeNothing) {
  const auto bare = make<Light>("infinite", {rgb("L", 1, 2, 3)});
  const auto light = make<Light>(
      "infinite", {rgb("L", 1, 2, 3), points("portal", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})});
  EXPECT_EQ(light->escaped({0, 0, 1}), bare->escaped({0, 0, 1}));
}

TEST_F(Infinite, RefusesWhatItCannot) {
  EXPECT_THROW(
      make<Light>("infinite", {text("mapname", picture(4, 2)), text("mapping", "equalarea")}),
      Error);
  EXPECT_THROW(
      make<Light>("infinite", {text("mapname", picture(4, 2)), text("filename", picture(4, 2))}),
      Error);
  EXPECT_THROW(make<Light>("infinite", {text("mapname", "absent.exr")}), Error);
  EXPECT_THROW(make<Light>("infinite", {text("mapname", greyPicture(folder, "n.exr", 1, {NAN}))}),
               Error);
  EXPECT_EQ(make<Light>("infinite", {integers("nsamples", {8})})->samples(), 8);
}

}  // namespace
}  // namespace pbrt::test
