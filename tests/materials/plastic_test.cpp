#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

// Torrance and Sparrow's model as the textbooks print it, with angles, in double.
struct Geometry {
  double cosO, cosI, cosH, oh;  // to the normal; and between wo and the half vector
};

Geometry geometry(const Vec3& wo, const Vec3& wi) {
  const DVec3 o = glm::normalize(DVec3(wo)), i = glm::normalize(DVec3(wi));
  const DVec3 h = glm::normalize(o + i);
  return {o.z, i.z, h.z, glm::dot(o, h)};
}

// From a medium of index ni into one of nt.
double fresnel(double cosI, double ni, double nt) {
  const double sinT = ni / nt * std::sqrt(1 - cosI * cosI);
  if (sinT >= 1) return 1;
  const double cosT = std::sqrt(1 - sinT * sinT);
  const double rs = (ni * cosI - nt * cosT) / (ni * cosI + nt * cosT);
  const double rp = (nt * cosI - ni * cosT) / (nt * cosI + ni * cosT);
  return (rs * rs + rp * rp) / 2;
}

double blinn(const Geometry& g, double roughness) {
  const double e = 1 / roughness;  // pbrt-v1 and v2 have the plastic on the outside
  const double D = (e + 2) / (2 * std::numbers::pi) * std::pow(g.cosH, e);
  const double G = std::min({1.0, 2 * g.cosH * g.cosO / g.oh, 2 * g.cosH * g.cosI / g.oh});
  return D * G * fresnel(g.oh, 1.5, 1) / (4 * g.cosO * g.cosI);
}

double trowbridgeReitz(const Geometry& g, double alpha) {
  const auto lambda = [&](double cosine) {
    const double tan2 = 1 / (cosine * cosine) - 1;
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
  };
  const double tan2H = 1 / (g.cosH * g.cosH) - 1;
  const double D = 1 / (std::numbers::pi * alpha * alpha * std::pow(g.cosH, 4) *
                        std::pow(1 + tan2H / (alpha * alpha), 2));
  const double G = 1 / (1 + lambda(g.cosO) + lambda(g.cosI));
  return D * G * fresnel(g.oh, 1, 1.5) / (4 * g.cosO * g.cosI);
}

void compare(const ParamList& set, double (*model)(const Geometry&, double), double width) {
  const Scattering plastic("plastic", set);
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 wo = direction(87 * rng.uniform(), 6 * rng.uniform());
    const Vec3 wi = direction(87 * rng.uniform(), 6 * rng.uniform());
    const double f = 0.2 / std::numbers::pi + 0.6 * model(geometry(wo, wi), width);
    ASSERT_NEAR(plastic->f(wo, wi).x, f, 1e-6 + 2e-4 * f);
  }
}

const Param kKd = rgb("Kd", 0.2F, 0.2F, 0.2F), kKs = rgb("Ks", 0.6F, 0.6F, 0.6F);

TEST(Plastic, BlinnIsTheBooks) {
  for (const float r : {1.F, 0.1F, 0.01F})
    compare({kKd, kKs, text("distribution", "blinn"), number("roughness", r)}, blinn, r);
}

TEST(Plastic, TrowbridgeReitzIsTheBooks) {
  for (const float r : {1.F, 0.3F, 0.05F})
    compare({kKd, kKs, flag("remaproughness", false), number("roughness", r)}, trowbridgeReitz, r);
}

TEST(Plastic, RoughnessIsRemappedByDefault) {
  const double x = std::log(0.1);
  const double alpha =
      1.62142 + 0.819955 * x + 0.1734 * x * x + 0.0171201 * x * x * x + 0.000640711 * x * x * x * x;
  compare({kKd, kKs}, trowbridgeReitz, alpha);
}

TEST(Plastic, BlackPartsAreLeftOut) {
  EXPECT_EQ(Scattering("plastic")->lobes(kAllLobes), 2);
  EXPECT_FALSE(Scattering("plastic", {rgb("Kd", 0, 0, 0)})->has(kDiffuse));
  EXPECT_FALSE(Scattering("plastic", {rgb("Ks", 0, 0, 0)})->has(kGlossy));
}

TEST(Plastic, RefusesUnknownDistributions) {
  EXPECT_THROW(make<Material>("plastic", {text("distribution", "gauss")}), Error);
}

}  // namespace
}  // namespace pbrt::test
