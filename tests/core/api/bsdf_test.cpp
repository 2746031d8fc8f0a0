#include "core/api/bsdf.h"

#include <gtest/gtest.h>

#include "core/api/lobes.h"
#include "core/base/rng.h"

namespace pbrt {
namespace {

// Remembers what it was asked.
class Probe final : public Bxdf {
 public:
  Probe(std::uint8_t flags, float value, float weight = 1)
      : Bxdf(flags), value_(value), weight_(weight) {}
  Spectrum f(const Vec3&, const Vec3&) const override {
    ++calls;
    return Spectrum(value_);
  }
  float pdf(const Vec3&, const Vec3&) const override { return value_; }
  std::optional<BsdfSample> sample(const Vec3&, Point2 u) const override {
    last = u;
    return BsdfSample{Spectrum(value_), {0.6F, 0, 0.8F}, value_};
  }
  float weight(const Vec3&) const override { return weight_; }

  mutable int calls = 0;
  mutable Point2 last{-1};

 private:
  float value_, weight_;
};

SurfaceInteraction tilted() {
  SurfaceInteraction at;
  at.n = {0, 0, 1};
  at.ns = glm::normalize(Vec3(1, 0, 1));
  at.tangent = {1, 0, 0};
  return at;
}

SurfaceInteraction flat() {
  SurfaceInteraction at;
  at.n = at.ns = {0, 0, 1};
  at.tangent = {1, 0, 0};
  return at;
}

TEST(Bsdf, CountsLobes) {
  const Probe diffuse(kReflection | kDiffuse, 1), mirror(kReflection | kSpecular, 1);
  Bsdf bsdf(flat());
  EXPECT_EQ(bsdf.lobes(kAllLobes), 0);
  EXPECT_FALSE(bsdf.sample({0, 0, 1}, {0, 0}));
  bsdf.add(&diffuse);
  bsdf.add(&mirror);
  EXPECT_EQ(bsdf.lobes(kAllLobes), 2);
  EXPECT_EQ(bsdf.lobes(kReflection | kSpecular), 1);
  EXPECT_EQ(bsdf.lobes(kTransmission | kSpecular), 0);
  EXPECT_TRUE(bsdf.has(kDiffuse | kGlossy));
  EXPECT_FALSE(bsdf.has(kGlossy));
}

TEST(Bsdf, GeometryTellsReflectionFromTransmission) {
  const Probe reflection(kReflection | kDiffuse, 1), transmission(kTransmission | kDiffuse, 2);
  Bsdf bsdf(tilted());
  bsdf.add(&reflection);
  bsdf.add(&transmission);
  // Above the surface but below the shading one, and the other way round.
  const Vec3 wo{0, 0, 1}, above = glm::normalize(Vec3(-1, 0, 0.1F)), below(0.9F, 0, -0.1F);
  EXPECT_EQ(bsdf.f(wo, above).x, 1);
  EXPECT_EQ(bsdf.f(wo, below).x, 2);
  EXPECT_EQ(bsdf.f(wo, above, kTransmission | kDiffuse).x, 0);
  EXPECT_EQ(bsdf.f(-wo, below).x, 1);
}

TEST(Bsdf, AsksOnlyLobesThatMatch) {
  const Probe diffuse(kReflection | kDiffuse, 1), glossy(kReflection | kGlossy, 1),
      through(kTransmission | kDiffuse, 1), mirror(kReflection | kSpecular, 0);
  Bsdf bsdf(flat());
  for (const Probe* p : {&diffuse, &glossy, &through, &mirror}) bsdf.add(p);
  bsdf.f({0, 0, 1}, {0, 0.6F, 0.8F}, kAllLobes & ~kGlossy);
  EXPECT_EQ(diffuse.calls, 1);
  EXPECT_EQ(glossy.calls, 0);
  EXPECT_EQ(through.calls, 0);
  EXPECT_EQ(mirror.calls, 0);
}

TEST(Bsdf, ChoosesByWeightAndUsesTheRestOfU) {
  const Probe a(kReflection | kDiffuse, 1, 0.5F), skipped(kTransmission | kDiffuse, 9),
      b(kReflection | kGlossy, 3, 1.5F);
  Bsdf bsdf(flat());
  for (const Probe* p : {&a, &skipped, &b}) bsdf.add(p);
  constexpr std::uint8_t wanted = kReflection | kDiffuse | kGlossy;
  auto s = bsdf.sample({0, 0, 1}, {0.125F, 0.125F}, wanted);
  ASSERT_TRUE(s);
  EXPECT_EQ(a.last, Point2(0.5F, 0.125F));
  EXPECT_EQ(b.last.x, -1);
  // Value and density are those of the whole.
  EXPECT_EQ(s->f.x, 4);
  EXPECT_EQ(s->pdf, 0.25F * 1 + 0.75F * 3);
  EXPECT_EQ(bsdf.pdf({0, 0, 1}, {0, 0, 1}, wanted), s->pdf);
  EXPECT_EQ(s->flags, kReflection | kDiffuse);

  s = bsdf.sample({0, 0, 1}, {0.625F, 0.25F}, wanted);
  ASSERT_TRUE(s);
  EXPECT_EQ(b.last, Point2(0.5F, 0.25F));
  EXPECT_EQ(s->flags, kReflection | kGlossy);
  bsdf.sample({0, 0, 1}, {kOneMinusEpsilon, 0}, wanted);
  EXPECT_LT(b.last.x, 1);
  EXPECT_GT(b.last.x, 0.999F);
}

TEST(Bsdf, LobesWithoutWeightAreNotChosenButSeen) {
  const Probe a(kReflection | kDiffuse, 1), nothing(kReflection | kGlossy, 3, 0);
  Bsdf bsdf(flat());
  bsdf.add(&a);
  bsdf.add(&nothing);
  for (const float u : {0.F, 0.5F, kOneMinusEpsilon}) {
    const auto s = bsdf.sample({0, 0, 1}, {u, 0.5F});
    ASSERT_TRUE(s);
    EXPECT_EQ(s->pdf, 1);
    EXPECT_EQ(s->f.x, 4);
  }
  EXPECT_EQ(nothing.last.x, -1);
  // Alone it still is.
  Bsdf alone(flat());
  alone.add(&nothing);
  EXPECT_TRUE(alone.sample({0, 0, 1}, {0.5F, 0.5F}));
  EXPECT_FALSE(alone.sample({0, 0, 1}, {0.5F, 0.5F}, kReflection | kDiffuse));
}

TEST(Bsdf, SpecularSamplesStandAlone) {
  const Probe diffuse(kReflection | kDiffuse, 5);
  const SpecularReflection<NoFresnel> mirror(Spectrum(0.5F), {});
  Bsdf bsdf(flat());
  bsdf.add(&diffuse);
  bsdf.add(&mirror);
  const auto s = bsdf.sample({0.6F, 0, 0.8F}, {0.75F, 0});
  ASSERT_TRUE(s);
  EXPECT_FLOAT_EQ(s->f.x * 0.8F, 0.5F);
  EXPECT_FLOAT_EQ(s->pdf, 1 / 3.F);
  EXPECT_EQ(s->wi, Vec3(-0.6F, 0, 0.8F));
  // The density of the others is lessened by the chance that the mirror was chosen.
  EXPECT_FLOAT_EQ(bsdf.pdf({0, 0, 1}, {0, 0, 1}), 5 * 2 / 3.F);
}

// A direction that the shading frame sends below the surface carries no reflection.
TEST(Bsdf, NoLightLeaksThroughBentNormals) {
  const Lambertian lobe(Spectrum(1));
  Bsdf bsdf(tilted());
  bsdf.add(&lobe);
  Rng rng(1);
  int below = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto s = bsdf.sample({0, 0, 1}, {rng.uniform(), rng.uniform()});
    if (!s) continue;
    EXPECT_EQ(isBlack(s->f), s->wi.z <= 0);
    EXPECT_EQ(s->f, bsdf.f({0, 0, 1}, s->wi));
    EXPECT_NEAR(s->pdf, bsdf.pdf({0, 0, 1}, s->wi), 1e-6);
    below += s->wi.z <= 0;
  }
  EXPECT_GT(below, 50);
}

}  // namespace
}  // namespace pbrt
