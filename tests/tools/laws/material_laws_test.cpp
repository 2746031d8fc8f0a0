// The laws of materials find wrong materials, and nothing in a right one.

#include "core/base/warp.h"
#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum class Flaw {
  none,
  density,
  samples,
  value,
  oneWay,
  energy,
  nan,
  texture,
  silent,
  leak,
  parts,
  lobes,
  unsafe,
  memory,
  twins,
  allocation
};

Shared made;

// Equal radiance into all directions, with one flaw.
template <Flaw flaw>
class Dull final : public Bxdf {
 public:
  Dull(float reflectance, std::uint8_t flags) : Bxdf(flags), f_(reflectance * kInvPi) {}

  Spectrum f(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return Spectrum(0);
    if (flaw == Flaw::nan && wo.x < -0.9F) return Spectrum(std::nanf(""));
    return f_ * Spectrum(flaw == Flaw::oneWay ? absCosTheta(wo) : 1);
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    return Bxdf::pdf(wo, wi) * (flaw == Flaw::density ? 1.5F : 1);
  }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    if (flaw == Flaw::samples) u.x = sqr(u.x);
    auto s = Bxdf::sample(wo, u);
    if (s && flaw == Flaw::value) s->f *= 2;
    return s;
  }
  float weight(const Vec3&) const override { return matches(kReflection | kGlossy) ? 0 : 1; }

 private:
  Spectrum f_;
};

template <Flaw flaw>
class Wall final : public Material {
 public:
  explicit Wall(Params& p) : kd_(p.floatTexture("Kd", 0.5F, "reflectance")) {
    if constexpr (flaw == Flaw::twins) twin_ = made.next();
  }
  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    float kd = kd_(at);
    if constexpr (flaw != Flaw::texture) kd = glm::clamp(kd, 0.F, 1.F);
    if constexpr (flaw == Flaw::energy) kd *= 2.1F;
    if constexpr (flaw == Flaw::unsafe) kd = shared_.through(at.uv.x);
    if constexpr (flaw == Flaw::memory) kd = std::fmod(shared_.next() / 16, 1.F);
    if constexpr (flaw == Flaw::twins) kd /= 2 + twin_;
    if constexpr (flaw == Flaw::allocation) ::operator delete(::operator new(8));
    const auto add = [&](float reflectance, std::uint8_t flags) {
      bsdf.add(place<Dull<flaw>>(scratch, reflectance, flags));
    };
    add(kd, (flaw == Flaw::leak ? kTransmission : kReflection) | kDiffuse);
    if constexpr (flaw == Flaw::lobes)
      for (int i = 1; i < 7; ++i) add(0.01F, kReflection | kDiffuse);
    if constexpr (flaw == Flaw::parts) add(0.2F, kReflection | kGlossy);
  }
  bool filters() const override { return flaw != Flaw::silent && kd_.filters(); }

 private:
  Textured<float> kd_;
  float twin_ = 0;
  Shared shared_;
};

template <Flaw flaw>
std::string found(std::string_view law) {
  return finding({&own<Material, Wall<flaw>>()}, law);
}

using testing::HasSubstr;

TEST(MaterialLaws, FindNothingInAGoodMaterial) {
  expectGood({&own<Material, Wall<Flaw::none>>()});
}

TEST(MaterialLaws, FindWrongValues) {
  EXPECT_THAT(found<Flaw::oneWay>("reflection-is-reciprocal"), HasSubstr("the other way round"));
  EXPECT_THAT(found<Flaw::energy>("no-energy-is-made"), HasSubstr("it scatters 1.05"));
  EXPECT_EQ(judged({&own<Material, Wall<Flaw::energy>>(), {}, {.albedo = 2}}, "no-energy-is-made")
                .failures(),
            0U);
  EXPECT_THAT(found<Flaw::nan>("extremes-are-finite"), HasSubstr("is (nan, nan, nan)"));
  EXPECT_THAT(found<Flaw::texture>("textures-may-have-any-value"),
              HasSubstr("with a texture \"Kd\" of -1 "));
  EXPECT_THAT(found<Flaw::silent>("filtering-is-said"), HasSubstr("the texture \"Kd\""));
  EXPECT_THAT(found<Flaw::lobes>("lobes-are-few"), HasSubstr("it adds 7 lobes"));
}

TEST(MaterialLaws, FindWrongSamples) {
  EXPECT_THAT(found<Flaw::density>("samples-follow-their-density"), HasSubstr("integrates to 1.5"));
  EXPECT_THAT(found<Flaw::samples>("samples-follow-their-density"), HasSubstr("chi-square"));
  EXPECT_THAT(found<Flaw::value>("samples-agree-with-values"), HasSubstr("but f() says"));
  EXPECT_THAT(found<Flaw::value>("bent-normals-are-handled"), HasSubstr("bent by 10 degrees"));
  EXPECT_THAT(found<Flaw::leak>("transmission-is-reciprocal"), HasSubstr("the same side"));
  EXPECT_THAT(found<Flaw::parts>("parts-add-up"), HasSubstr("one by one, 0.5"));
}

TEST(MaterialLaws, FindAnswersThatDepend) {
  EXPECT_THAT(found<Flaw::unsafe>("thread-safe"), HasSubstr("while other threads ask as well"));
  EXPECT_THAT(found<Flaw::unsafe>("repeatable"), "");
  EXPECT_THAT(found<Flaw::memory>("repeatable"), HasSubstr("when asked again"));
  EXPECT_THAT(found<Flaw::twins>("twins"), HasSubstr("f(wo, wi).x = "));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_THAT(found<Flaw::allocation>("allocates-nothing"), HasSubstr("memory was asked for 1"));
#endif
}

}  // namespace
}  // namespace pbrt::test
