// Laws for every light that can be found. Area lights are a disk about the origin that faces +z.

#include "tests/chi_square.h"
#include "tests/lights/pictures.h"
#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

constexpr double kDisk = 1.5;  // the radius of the area lights

// Every light as it is by default, and in other ways that it may have.
template <class Check>
void forEveryLight(Check check) {
  const DiskSampler disk(kDisk);
  const Light::Setup setup{Transform::translate({0.1, 0.2, 0.3}) * Transform::rotate(50, {1, 2, 3}),
                           &disk,
                           {{-kDisk, -kDisk, 0}, {kDisk, kDisk, 0}}};
  const Folder folder;
  Rng rng(9);
  std::vector<float> values(24 * 12);
  for (float& v : values) v = rng.uniform() < 0.05F ? 30 : rng.uniform();
  const std::string file = greyPicture(folder, "a.exr", 24, values);
  int made = 0;
  for (const std::string& name : loader().available(PluginKind::light))
    for (const ParamList& list : {ParamList{},
                                  {flag("twosided", true)},
                                  {text("mapname", file)},
                                  {text("falloff", "smoothstep")}}) {
      SCOPED_TRACE(name + (list.empty() ? "" : " " + list[0].name));
      std::unique_ptr<Light> light;
      try {
        light = make<Light>(name, list, setup);
      } catch (const Error&) {
        continue;
      }
      ++made;
      check(*light);
    }
  EXPECT_GE(made, 12);
}

// Of the disk, where the ray from p along w meets it.
SurfaceInteraction onDisk(const Point3& p, const Vec3& w) {
  SurfaceInteraction on;
  on.p = p - (p.z / w.z) * w;
  on.n = {0, 0, 1};
  return on;
}

// Radiance and density of a light that has an extent, in direction w from p.
struct Seen {
  double radiance = 0, pdf = 0;
};
Seen seen(const Light& light, const Point3& p, const Vec3& w) {
  if (light.isInfinite()) return {light.escaped(w).y, light.pdfEscaped(w)};
  if (!light.mayHit(p, w)) return {};
  const SurfaceInteraction on = onDisk(p, w);
  return {light.emitted(on.p, on.n, -w).y, light.pdf(p, on)};
}

// A mean that is summed in double, and its standard error.
class Mean {
 public:
  void add(double x) {
    ++n_;
    sum_ += x;
    squares_ += x * x;
  }
  double value() const { return sum_ / n_; }
  double error() const {
    return std::sqrt(std::max(0.0, squares_ / n_ - value() * value()) / (n_ - 1));
  }

 private:
  double n_ = 0, sum_ = 0, squares_ = 0;
};

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

// Pearson's test over boxes of equal solid angle: samples go where the density says. Of an area
// light those that face away give no sample, which is a box of its own.
TEST(LightLaws, DirectionsFollowTheDensity) {
  forEveryLight([](const Light& light) {
    if (light.isDelta()) return;
    for (const Point3 p : {Point3(0.3F, -0.4F, 1), Point3(-4, 3, 2)}) {
      constexpr int n = 16, fine = 60, samples = 100000;
      std::vector<double> expected(n * n + 1), counts(n * n + 1);
      const auto box = [](const Vec3& w) {
        const double phi = std::atan2(w.y, w.x) / (2 * std::numbers::pi);
        const int i = std::clamp(static_cast<int>((1 - w.z) / 2 * n), 0, n - 1);
        const int j = std::clamp(static_cast<int>((phi < 0 ? phi + 1 : phi) * n), 0, n - 1);
        return i * n + j;
      };
      constexpr int side = n * fine;
      double total = 0;
      for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
          const Vec3 w = uniformSphere({(i + 0.5F) / side, (j + 0.5F) / side});
          const double share = seen(light, p, w).pdf * 4 * std::numbers::pi / (side * side);
          expected[box(w)] += share * samples;
          total += share;
        }
      EXPECT_NEAR(total, 1, 5e-3);
      Rng rng(3);
      for (int i = 0; i < samples; ++i) {
        const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
        ++counts[s.pdf > 0 ? box(s.wi) : n * n];
      }
      std::vector<double> drawn, wanted;
      for (int c = 0; c < n * n; ++c)
        if (expected[c] > 50) {
          drawn.push_back(counts[c]);
          wanted.push_back(expected[c]);
        }
      // The integral over a box is itself not exact to more than about 1 %.
      EXPECT_LT(chiSquareDeviation(drawn, wanted), 5);
    }
  });
}

// What arrives at a surface element: by samples of the light, and by directions all around.
TEST(LightLaws, IrradianceBySamplesIsThatByDirections) {
  forEveryLight([](const Light& light) {
    if (light.isDelta()) return;
    for (const Point3 p : {Point3(0.3F, -0.4F, 1), Point3(-1, 2, 3)}) {
      const Normal3 n = glm::normalize(Vec3(0.3F, 0.2F, 0) - p);
      constexpr int side = 700;
      double expected = 0;
      const Frame frame = Frame::fromZ(n);
      for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
          const Vec3 w = frame.fromLocal(cosHemisphere({(i + 0.5F) / side, (j + 0.5F) / side}));
          expected += seen(light, p, w).radiance * std::numbers::pi / (side * side);
        }
      Mean E;
      Rng rng(4);
      for (int i = 0; i < 50000; ++i) {
        const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
        E.add(s.pdf > 0 ? double{s.L.y} * std::max(0.F, glm::dot(s.wi, n)) / s.pdf : 0);
      }
      EXPECT_NEAR(E.value(), expected, 4.5 * E.error() + 3e-3 * expected);
    }
  });
}

// The flux of a finite light passes through any sphere about it; that of an infinite one into a
// ball is pi r^2 times the integral of its radiance.
TEST(LightLaws, PowerIsTheIntegralOfEmission) {
  forEveryLight([](const Light& light) {
    constexpr double radius = 6;
    const bool finite = !light.bounds().box.empty();
    Mean flux;
    Rng rng(5);
    for (int i = 0; i < 200000; ++i) {
      const Vec3 w = uniformSphere({rng.uniform(), rng.uniform()});
      const Point3 p = static_cast<float>(radius) * w;
      const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
      const double L = s.pdf > 0 ? double{luminance(s.L)} / s.pdf : 0;
      flux.add(finite ? L * std::abs(glm::dot(s.wi, w)) * 4 * std::numbers::pi * sqr(radius)
                      : L * std::numbers::pi * sqr(radius));
    }
    EXPECT_NEAR(flux.value(), light.power(radius), 4.5 * flux.error() + 5e-3 * flux.value());
  });
}

// Light comes from within the box, and only into directions that the bounds allow.
TEST(LightLaws, BoundsHoldWhatItDoes) {
  forEveryLight([](const Light& light) {
    const LightBounds b = light.bounds();
    if (b.box.empty()) return;
    Rng rng(6);
    const double reach = std::acos(b.normals.cosine) + std::acos(b.cosEmission) + 1e-3;
    for (int i = 0; i < 5000; ++i) {
      const LightSample s = light.sample(somewhere(rng), {rng.uniform(), rng.uniform()});
      if (!(s.pdf > 0) || isBlack(s.L)) continue;
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(s.p[k], b.box.lo[k] - 1e-5);
        EXPECT_LE(s.p[k], b.box.hi[k] + 1e-5);
      }
      float cosine = -glm::dot(s.wi, b.normals.axis);
      if (b.twoSided) cosine = std::abs(cosine);
      EXPECT_LE(std::acos(std::clamp(cosine, -1.F, 1.F)), reach);
    }
  });
}

}  // namespace
}  // namespace pbrt::test
