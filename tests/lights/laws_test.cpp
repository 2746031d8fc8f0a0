// Laws for every light that can be found. A light whose parameters have no defaults (a picture,
// say) is passed over.

#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

template <class Check>
void forEveryLight(Check check) {
  const DiskSampler disk(1.5);
  const Light::Setup setup{Transform::translate({0.1, 0.2, 0.3}), &disk};
  std::vector<std::string> made;
  for (const std::string& name : loader().available(PluginKind::light)) {
    SCOPED_TRACE(name);
    std::unique_ptr<Light> light;
    try {
      light = make<Light>(name, {}, setup);
    } catch (const Error&) {
      continue;
    }
    made.push_back(name);
    light->prepare({Point3(-10), Point3(10)});
    check(*light);
  }
  EXPECT_GE(made.size(), 7U);
}

Point3 somewhere(Rng& rng) {
  return 5.F * uniformSphere({rng.uniform(), rng.uniform()}) * rng.uniform();
}

TEST(LightLaws, SamplesAreWellFormed) {
  forEveryLight([](const Light& light) {
    Rng rng(1);
    int lit = 0;
    for (int i = 0; i < 2000; ++i) {
      const Point3 p = somewhere(rng);
      const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
      ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf >= 0);
      if (s.pdf == 0) continue;
      ++lit;
      if (light.isDelta()) {
        ASSERT_EQ(s.pdf, 1);
      }
      ASSERT_TRUE(isFinite(s.L) && s.L.x >= 0 && s.L.y >= 0 && s.L.z >= 0);
      ASSERT_NEAR(glm::length(s.wi), 1, 1e-5);
      if (s.finite) {
        ASSERT_NEAR(glm::length(glm::normalize(s.p - p) - s.wi), 0, 1e-5);
      }
    }
    EXPECT_GT(lit, 20);
  });
}

// Who finds the light by chance must agree with who samples it.
TEST(LightLaws, BothStrategiesAgreeOnDensityAndRadiance) {
  forEveryLight([](const Light& light) {
    Rng rng(2);
    for (int i = 0; i < 2000; ++i) {
      const Point3 p = somewhere(rng);
      const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
      if (s.pdf == 0 || light.isDelta()) continue;
      if (light.isInfinite()) {
        ASSERT_NEAR(light.pdfEscaped(s.wi), s.pdf, 0.01F * s.pdf);
        ASSERT_NEAR(light.escaped(s.wi).y, s.L.y, 0.01F * s.L.y);
      } else {
        SurfaceInteraction on;
        on.p = s.p;
        on.n = s.n;
        ASSERT_NEAR(light.pdf(p, on), s.pdf, 0.01F * s.pdf);
        ASSERT_EQ(light.emitted(s.p, s.n, -s.wi), s.L);
        // A hair inside the edge, which rounding may miss.
        ASSERT_TRUE(light.mayHit(p, glm::mix(s.p, Point3(0), 1e-4F) - p));
      }
    }
  });
}

TEST(LightLaws, DeltaLightsAreNotFoundByChance) {
  forEveryLight([](const Light& light) {
    if (!light.isDelta()) return;
    EXPECT_FALSE(light.mayHit(Point3(1), {0, 0, 1}));
    EXPECT_FALSE(light.isInfinite());
    EXPECT_EQ(light.escaped({0, 0, 1}), Spectrum(0));
  });
}

}  // namespace
}  // namespace pbrt::test
