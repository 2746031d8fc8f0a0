#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

std::unique_ptr<Light> glowing(const AreaSampler& surface, const ParamList& list = {}) {
  return make<Light>("diffuse", list, {Transform(), &surface});
}

// On the axis of a disk of radius R at distance h: E = pi L R^2 / (R^2 + h^2).
TEST(Diffuse, IrradianceOfADisk) {
  const DiskSampler disk(2);
  const auto light = glowing(disk, {rgb("L", 3, 2, 1), rgb("scale", 2, 2, 2)});
  for (const float h : {0.5F, 2.F, 20.F}) {
    const Spectrum E = irradiance(*light, {0, 0, h}, {0, 0, -1}, 400000);
    const double share = std::numbers::pi * 4 / (4 + h * h);
    EXPECT_NEAR(E.x, 6 * share, 0.02 * 6 * share);
    EXPECT_NEAR(E.z, 2 * share, 0.02 * 2 * share);
  }
}

TEST(Diffuse, ShinesFromTheSideOfTheNormal) {
  const DiskSampler disk(1);
  const auto one = glowing(disk), two = glowing(disk, {flag("twosided", true)});
  const Normal3 n{0, 0, 1};
  EXPECT_EQ(one->emitted(Point3(0), n, {0, 0.6F, 0.8F}), Spectrum(1));
  EXPECT_EQ(one->emitted(Point3(0), n, {0, 0.6F, -0.8F}), Spectrum(0));
  EXPECT_EQ(two->emitted(Point3(0), n, {0, 0.6F, -0.8F}), Spectrum(1));
  EXPECT_EQ(one->sample({0, 0, -1}, {0.3F, 0.3F}).pdf, 0);
  EXPECT_GT(two->sample({0, 0, -1}, {0.3F, 0.3F}).pdf, 0);
  EXPECT_EQ(one->sample({0.5F, 0, 0}, {0.3F, 0.3F}).pdf, 0);  // edge-on
}

// Seen from p, the density integrates to one over the directions that meet the surface.
TEST(Diffuse, DensityIntegratesToOne) {
  const DiskSampler disk(2);
  const auto light = glowing(disk);
  const Point3 p(0.5F, -1, 1.5F);
  constexpr int n = 1000;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 w = uniformSphere({(i + 0.5F) / n, (j + 0.5F) / n});
      if (!light->mayHit(p, w)) continue;
      SurfaceInteraction on;
      on.p = p + (-p.z / w.z) * w;
      on.n = {0, 0, 1};
      sum += light->pdf(p, on);
    }
  EXPECT_NEAR(sum * 4 * std::numbers::pi / (n * n), 1, 2e-3);
}

TEST(Diffuse, SamplesLieOnTheSurface) {
  const DiskSampler disk(2);
  const auto light = glowing(disk);
  const Point3 p(0.5F, -1, 1.5F);
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const LightSample s = light->sample(p, {rng.uniform(), rng.uniform()});
    ASSERT_GT(s.pdf, 0);
    EXPECT_NEAR(s.p.z, 0, 1e-6);
    EXPECT_NEAR(glm::length(glm::normalize(s.p - p) - s.wi), 0, 1e-6);
    EXPECT_TRUE(s.finite);
    SurfaceInteraction on;
    on.p = s.p;
    on.n = s.n;
    EXPECT_NEAR(light->pdf(p, on), s.pdf, 1e-4F * s.pdf);
  }
  EXPECT_FALSE(light->isDelta());
}

TEST(Diffuse, NumberOfSamples) {
  const DiskSampler disk(1);
  EXPECT_EQ(glowing(disk)->samples(), 1);
  EXPECT_EQ(glowing(disk, {integers("nsamples", {8})})->samples(), 8);
  EXPECT_EQ(glowing(disk, {integers("samples", {4})})->samples(), 4);
  EXPECT_EQ(glowing(disk, {integers("nsamples", {8}), integers("samples", {4})})->samples(), 4);
  EXPECT_THROW(glowing(disk, {integers("nsamples", {0})}), Error);
}

TEST(Diffuse, NeedsASurface) {
  EXPECT_THROW(make<Light>("diffuse"), Error);
}

// A side of area A emits pi L A.
TEST(Diffuse, Power) {
  const DiskSampler disk(2);
  EXPECT_FLOAT_EQ(glowing(disk, {number("power", 6)})->emitted(Point3(0), {0, 0, 1}, {0, 0, 1}).x,
                  6 / (kPi * kPi * 4));
  EXPECT_FLOAT_EQ(glowing(disk, {number("power", 6), flag("twosided", true), number("scale", 3)})
                      ->emitted(Point3(0), {0, 0, 1}, {0, 0, -1})
                      .x,
                  18 / (2 * kPi * kPi * 4));
  EXPECT_THROW(glowing(disk, {text("filename", "a.png")}), Error);
}

}  // namespace
}  // namespace pbrt::test
