// Materials at the edge of what a scene can say.

#include "core/api/lobes.h"
#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

const Param kAlpha = flag("remaproughness", false);

template <class Check>
void forEach(const std::vector<std::pair<std::string, ParamList>>& materials, Check check) {
  for (const auto& [name, set] : materials) {
    SCOPED_TRACE(name);
    const Scattering bsdf(name, set);
    check(*bsdf.operator->());
  }
}

// As the roughness goes to 0, the facets become the mirror: no step in brightness.
TEST(MaterialExtremes, RoughnessGoesToZeroWithoutAStep) {
  for (const char* name : {"glass", "metal"})
    for (const char* distribution : {"trowbridgereitz", "beckmann"})
      for (const double angle : {0., 45., 85., 125., 170.}) {
        const auto share = [&](float roughness) {
          const Scattering bsdf(
              name, {number("roughness", roughness), kAlpha, text("distribution", distribution)});
          return albedo(*bsdf.operator->(), direction(angle), 20000, kReflection | kSpecular) +
                 albedo(*bsdf.operator->(), direction(angle), 20000, kReflection | kGlossy);
        };
        const double mirror = share(0);
        EXPECT_NEAR(share(1e-6F), mirror, 1e-6) << name << angle;
        EXPECT_NEAR(share(1.1e-3F), mirror, 2e-3) << name << angle << distribution;
      }
}

// A groove of facets across, a mirror along: the share is between those of its two roughnesses.
TEST(MaterialExtremes, OneAxisSmoothTheOtherRough) {
  for (const char* name : {"metal", "glass", "uber", "substrate"}) {
    const Scattering bsdf(name, {number("uroughness", 1e-6F), number("vroughness", 1), kAlpha});
    for (const double angle : {0., 45., 85.}) {
      const double share = albedo(*bsdf.operator->(), direction(angle), 20000);
      EXPECT_GT(share, 0.1) << name << angle;
      EXPECT_LE(share, 1.01) << name << angle;
    }
  }
}

// At 1e-7 from the horizon facets scatter nothing, for want of digits; diffuse surfaces do.
TEST(MaterialExtremes, GrazingDirectionsAreFinite) {
  forEach({{"matte", {}},
           {"plastic", {}},
           {"metal", {}},
           {"glass", {number("roughness", 0.3F)}},
           {"substrate", {}},
           {"coateddiffuse", {number("roughness", 0.5F)}},
           {"brushedmetal", {}}},
          [](const Bsdf& bsdf) {
            for (const float z : {1e-7F, -1e-7F, 1e-5F, -1e-5F}) {
              const Vec3 wo(std::sqrt(1 - z * z), 0, z);
              Rng rng(1);
              for (int i = 0; i < 2000; ++i) {
                const auto s = bsdf.sample(wo, {rng.uniform(), rng.uniform()});
                if (!s) continue;
                const Spectrum carried = s->f * (std::abs(s->wi.z) / s->pdf);
                ASSERT_TRUE(isFinite(carried));
                ASSERT_LE(carried.y, 40);
              }
            }
          });
}

// A shading normal up to 89 degrees from the surface's: densities are still those of the samples,
// and nothing leaks.
TEST(MaterialExtremes, BentNormals) {
  for (const char* name :
       {"matte", "plastic", "glass", "metal", "translucent", "substrate", "skin"})
    for (const double bend : {10., 60., 89.}) {
      SurfaceInteraction at = flatSurface();
      at.ns = direction(bend, 0);
      const auto material = make<Material>(name);
      const Scattering bsdf(*material, at);
      Rng rng(1);
      for (int i = 0; i < 3000; ++i) {
        const Vec3 wo = uniformSphere({rng.uniform(), rng.uniform()});
        const auto s = bsdf->sample(wo, {rng.uniform(), rng.uniform()});
        if (!s) continue;
        ASSERT_TRUE(isFinite(s->f) && s->pdf > 0 && std::isfinite(s->pdf)) << name << bend;
        const bool reflected = wo.z * s->wi.z > 0;
        if (s->flags & kSpecular) continue;
        ASSERT_NEAR(bsdf->pdf(wo, s->wi), s->pdf, 0.03F * s->pdf) << name << bend;
        const Spectrum other =
            bsdf->f(wo, s->wi, reflected ? kAllLobes & ~kReflection : kAllLobes & ~kTransmission);
        ASSERT_TRUE(isBlack(other)) << name << bend;
      }
    }
}

TEST(MaterialExtremes, BlackSendsNothingBack) {
  const Param kd = rgb("Kd", 0, 0, 0), ks = rgb("Ks", 0, 0, 0), r = rgb("reflectance", 0, 0, 0);
  forEach({{"matte", {kd}},
           {"plastic", {kd, ks}},
           {"uber", {kd, ks}},
           {"translucent", {kd, ks}},
           {"substrate", {kd, ks}},
           {"mirror", {rgb("Kr", 0, 0, 0)}},
           {"glass", {rgb("Kr", 0, 0, 0), rgb("Kt", 0, 0, 0)}},
           {"diffusetransmission", {r, rgb("transmittance", 0, 0, 0)}}},
          [](const Bsdf& bsdf) {
            EXPECT_EQ(bsdf.count(), 0);
            EXPECT_FALSE(bsdf.sample(direction(30), {0.5F, 0.5F}));
            EXPECT_EQ(bsdf.pdf(direction(30), direction(40)), 0);
            EXPECT_EQ(bsdf.f(direction(30), direction(40)), Spectrum(0));
          });
}

// The coat is clear: its thickness changes nothing.
TEST(MaterialExtremes, ThicknessOfAClearCoat) {
  const auto share = [](float thickness) {
    const Scattering bsdf("coateddiffuse",
                          {number("thickness", thickness), number("roughness", 0.4F)});
    return albedo(*bsdf.operator->(), direction(50), 20000);
  };
  EXPECT_GT(share(0.01F), 0.1);
  EXPECT_EQ(share(0), share(0.01F));
  EXPECT_EQ(share(1e30F), share(0.01F));
}

// A bsdf as full as it can be, of lobes whose weights differ by 1e6: samples and densities agree,
// and its albedo is the sum of theirs.
TEST(MaterialExtremes, TwentyFourLobesOfAllWeights) {
  Scratch scratch;
  Bsdf bsdf(flatSurface());
  double sum = 0;
  for (int i = 0; i < Bsdf::kMaxLobes; ++i) {
    const auto r = static_cast<float>(std::pow(10, -6.0 * i / (Bsdf::kMaxLobes - 1)));
    bsdf.add(place<Lambertian>(scratch, Spectrum(0.1F * r)));
    sum += 0.1 * r;
  }
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const auto s = bsdf.sample(direction(30), {rng.uniform(), rng.uniform()});
    ASSERT_TRUE(s);
    ASSERT_NEAR(s->f.y * s->wi.z / s->pdf, sum, 1e-5);
    ASSERT_NEAR(bsdf.pdf(direction(30), s->wi), s->pdf, 1e-5);
  }
}

}  // namespace
}  // namespace pbrt::test
