// Laws of scattering, for every material that can be found.

#include "tests/chi_square.h"
#include "tests/materials/every_material.h"

namespace pbrt::test {
namespace {

const double kAngles[] = {0, 30, 70, 88, 110, 150};

TEST(MaterialLaws, Reciprocity) {
  forEveryMaterial([](const std::string&, const ParamList&, const Bsdf& bsdf) {
    Rng rng(2);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = uniformSphere({rng.uniform(), rng.uniform()});
      Vec3 b = uniformSphere({rng.uniform(), rng.uniform()});
      if (a.z * b.z < 0) b.z = -b.z;
      const Spectrum f = bsdf.f(a, b), g = bsdf.f(b, a);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(f[c], g[c], 1e-3F * f[c] + 1e-9F) << a.z << " " << b.z;
    }
  });
}

// Radiance is denser by the square of the index in the denser medium.
TEST(MaterialLaws, TransmissionIsReciprocalButForTheDensityOfRadiance) {
  forEveryMaterial([](const std::string& name, const ParamList& set, const Bsdf& bsdf) {
    // Sharp highlights magnify the rounding of directions.
    const float tolerance = broad(name, set) ? 2e-3F : 0.03F;
    for (const std::uint8_t kind : {kDiffuse, kGlossy}) {
      const std::uint8_t lobe = kTransmission | kind;
      if (bsdf.lobes(lobe) == 0) continue;
      Rng rng(2);
      int lit = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 a = uniformSphere({rng.uniform(), rng.uniform()});
        const auto s = bsdf.sample(a, {rng.uniform(), rng.uniform()}, lobe);
        if (!s) continue;
        ASSERT_LT(a.z * s->wi.z, 0);
        const Spectrum f = bsdf.f(a, s->wi, lobe), g = bsdf.f(s->wi, a, lobe) / sqr(s->eta);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(f[c], g[c], tolerance * f[c] + 1e-9F) << a.z;
        ++lit;
      }
      EXPECT_GT(lit, 500);
    }
  });
}

TEST(MaterialLaws, NoEnergyIsMade) {
  forEveryMaterial([](const std::string& name, const ParamList&, const Bsdf& bsdf) {
    // As in pbrt, it is up to the user that the parts of these add up to no more than one.
    const double most = name == "shinymetal" || name == "uber" ? 2 : 1;
    for (const double angle : kAngles) {
      const double share = albedo(bsdf, direction(angle), 12000);
      EXPECT_LE(share, most * 1.02) << angle;
      EXPECT_GE(share, 0) << angle;
    }
  });
}

// The counts of sample()'s directions in cells of the sphere, and of no direction at all, are
// those that pdf() predicts.
TEST(MaterialLaws, SamplesFollowTheirDensity) {
  forEveryMaterial([](const std::string& name, const ParamList& set, const Bsdf& bsdf) {
    constexpr auto wanted = static_cast<std::uint8_t>(kAllLobes & ~kSpecular);
    if (bsdf.lobes(wanted) == 0 || !broad(name, set)) return;
    constexpr int rows = 16, columns = 16, fineRows = 64, fineColumns = 8, samples = 30000;
    for (const double angle : {0, 70, 88, 150}) {
      const Vec3 wo = direction(angle);
      std::vector<double> expected(rows * columns + 1), counts(rows * columns + 1);
      double total = 0;
      // Rows have equal heights; within one it is angles that step evenly, to be fine at the poles.
      const auto theta = [](double row) { return std::acos(1 - 2 * row / rows); };
      for (int i = 0; i < rows; ++i)
        for (int k = 0; k < fineRows; ++k) {
          const double step = (theta(i + 1) - theta(i)) / fineRows,
                       mid = theta(i) + (k + 0.5) * step;
          const double area = 2 * std::sin(mid) * std::sin(step / 2) * 2 * std::numbers::pi /
                              (columns * fineColumns);
          for (int j = 0; j < columns * fineColumns; ++j) {
            const double phi = 2 * std::numbers::pi * (j + 0.5) / (columns * fineColumns);
            const Vec3 wi(std::sin(mid) * std::cos(phi), std::sin(mid) * std::sin(phi),
                          std::cos(mid));
            const double share = bsdf.pdf(wo, wi, wanted) * area;
            total += share;
            expected[i * columns + j / fineColumns] += samples * share;
          }
        }
      EXPECT_LE(total, 1.005) << angle;
      expected.back() = samples * std::max(0.0, 1 - total);
      Rng rng(3);
      for (int i = 0; i < samples; ++i) {
        const Point2 u{rng.uniform(), rng.uniform()};
        const auto s = bsdf.sample(wo, u, wanted);
        if (!s) {
          ++counts.back();
          continue;
        }
        double phi = std::atan2(s->wi.y, s->wi.x) / (2 * std::numbers::pi);
        if (phi < 0) phi += 1;
        const int row = std::clamp(static_cast<int>((1 - s->wi.z) / 2 * rows), 0, rows - 1);
        const int column = std::clamp(static_cast<int>(phi * columns), 0, columns - 1);
        ++counts[row * columns + column];
      }
      // Cells with few expected counts are put together.
      std::vector<double> e{0}, c{0};
      for (std::size_t k = 0; k < expected.size(); ++k) {
        if (expected[k] < 10) {
          e[0] += expected[k];
          c[0] += counts[k];
        } else {
          e.push_back(expected[k]);
          c.push_back(counts[k]);
        }
      }
      if (e[0] < 10) {
        EXPECT_LE(c[0], 40) << angle;
        e.erase(e.begin());
        c.erase(c.begin());
      }
      EXPECT_LT(chiSquareDeviation(c, e), 4.5) << angle;
    }
  });
}

TEST(MaterialLaws, SamplesSayWhatValueAndDensitySay) {
  forEveryMaterial([](const std::string&, const ParamList&, const Bsdf& bsdf) {
    Rng rng(4);
    for (const double angle : kAngles)
      for (int i = 0; i < 500; ++i) {
        const Vec3 wo = direction(angle);
        const Point2 u{rng.uniform(), rng.uniform()};
        const auto s = bsdf.sample(wo, u);
        if (!s) continue;
        ASSERT_NEAR(glm::length(s->wi), 1, 1e-5F);
        ASSERT_TRUE(isFinite(s->f) && s->pdf > 0 && std::isfinite(s->pdf));
        if (s->flags & kSpecular) {
          ASSERT_LE(s->pdf, 1);
        } else {
          // Sharp highlights magnify the rounding of directions.
          ASSERT_NEAR(bsdf.pdf(wo, s->wi), s->pdf, 0.03F * s->pdf);
          const Spectrum f = bsdf.f(wo, s->wi);
          for (int c = 0; c < 3; ++c) ASSERT_NEAR(f[c], s->f[c], 0.03F * s->f[c]);
        }
      }
  });
}

// Whatever lobes are asked for, the others' chances go to them: what they scatter adds up.
TEST(MaterialLaws, PartsAddUpToTheWhole) {
  forEveryMaterial([](const std::string&, const ParamList&, const Bsdf& bsdf) {
    const auto estimate = [&](const Vec3& wo, std::uint8_t wanted) {
      Moments m;
      Rng rng(wanted);
      for (int i = 0; i < 4000; ++i) {
        const auto s = bsdf.sample(wo, {rng.uniform(), rng.uniform()}, wanted);
        m.add(s ? luminance(s->f) * std::abs(s->wi.z) / s->pdf : 0);
      }
      return m;
    };
    for (const double angle : {0, 75, 140}) {
      const Vec3 wo = direction(angle);
      const Moments whole = estimate(wo, kAllLobes);
      double sum = 0, variance = sqr(whole.error());
      for (const std::uint8_t side : {kReflection, kTransmission})
        for (const std::uint8_t kind : {kDiffuse, kGlossy, kSpecular}) {
          const std::uint8_t part = side | kind;
          if (bsdf.lobes(part) == 0) continue;
          const Moments m = estimate(wo, part);
          sum += m.mean;
          variance += sqr(m.error());
        }
      EXPECT_NEAR(whole.mean, sum, 5 * std::sqrt(variance) + 1e-3 * sum) << angle;
    }
  });
}

TEST(MaterialLaws, EverythingIsFiniteWhereDirectionsAreExtreme) {
  forEveryMaterial([](const std::string&, const ParamList&, const Bsdf& bsdf) {
    std::vector<Vec3> extremes = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
    for (const float z : {1e-3F, 1e-7F, 1e-20F, 1e-38F, 0.3F})
      for (const float x : {-1.F, 1.F}) extremes.push_back({x * std::sqrt(1 - z * z), 0, z});
    for (std::size_t i = 0, n = extremes.size(); i < n; ++i) extremes.push_back(-extremes[i]);
    Rng rng(5);
    for (const Vec3& wo : extremes) {
      for (const Vec3& wi : extremes) {
        const Spectrum f = bsdf.f(wo, wi);
        ASSERT_TRUE(isFinite(f)) << wo.x << " " << wo.z << " " << wi.x << " " << wi.z;
        ASSERT_TRUE(f.x >= 0 && f.y >= 0 && f.z >= 0);
        ASSERT_TRUE(std::isfinite(bsdf.pdf(wo, wi)) && bsdf.pdf(wo, wi) >= 0);
      }
      for (const Point2 u : {Point2(0), Point2(0, kOneMinusEpsilon), Point2(kOneMinusEpsilon, 0),
                             Point2(0.5F), Point2(kOneMinusEpsilon)})
        if (const auto s = bsdf.sample(wo, u)) {
          ASSERT_TRUE(isFinite(s->f) && std::isfinite(s->pdf) && s->pdf > 0) << wo.x << " " << wo.z;
          ASSERT_NEAR(glm::length(s->wi), 1, 1e-5F);
        }
    }
  });
}

}  // namespace
}  // namespace pbrt::test
