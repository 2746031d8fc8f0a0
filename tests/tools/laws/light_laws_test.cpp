// The laws of lights find wrong lights, and nothing in a right one.

#include "core/base/warp.h"
#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum class Flaw {
  none,
  density,
  radiance,
  power,
  edge,
  intensity,
  box,
  cone,
  direction,
  nan,
  nanFar,
  unsafe,
  memory,
  twins,
  allocation,
  surface
};

Shared made;

// A glowing surface of radiance 1, with one flaw.
template <Flaw flaw>
class Glow final : public Light {
 public:
  Glow(Params&, const Setup& setup) : surface_(setup.surface), box_(setup.box) {
    if (!surface_ && flaw != Flaw::surface) throw Error("it needs a surface");
    if constexpr (flaw == Flaw::box) box_.hi.x = 1;
    if constexpr (flaw == Flaw::twins) L_ = 1 + made.next();
  }

  double power(double) const override {
    return std::numbers::pi * surface_->area() * (flaw == Flaw::power ? 2 : 1);
  }
  LightBounds bounds() const override {
    if (!surface_) return {};
    DirectionCone normals = surface_->normals();
    if constexpr (flaw == Flaw::cone) normals.axis = {0, 0, -1};
    return {box_, surface_->area() * (flaw == Flaw::intensity ? 0.1 : 1), normals, 0};
  }

  LightSample sample(const Point3& p, Point2 u) const override {
    LightSample s;
    if constexpr (flaw == Flaw::surface) {
      if (!surface_) return {.pdf = -1};
    }
    if constexpr (flaw == Flaw::unsafe) u.x = shared_.through(u.x);
    if constexpr (flaw == Flaw::memory) u.x = std::fmod(shared_.next() / 16, 1.F);
    if constexpr (flaw == Flaw::allocation) ::operator delete(::operator new(8));
    const AreaSample on = surface_->sample(DPoint3(p), u);
    if (!(on.pdf > 0)) return s;
    s.wi = glm::normalize(Vec3(on.p - DPoint3(p)));
    s.L = emitted(on.p, on.n, -s.wi);
    if (isBlack(s.L)) return s;
    s.p = on.p;
    s.n = on.n;
    s.pdf = on.pdf;
    if constexpr (flaw == Flaw::direction) s.wi *= 2;
    if constexpr (flaw == Flaw::radiance) s.L *= 1.5F;
    if (flaw == Flaw::nan && u.x > 0.99F) s.L.y = std::nanf("");
    if (flaw == Flaw::nanFar && lengthSquared(p) > 1e10F) s.pdf = kInfinity;
    return s;
  }
  bool isDelta() const override { return false; }

  Spectrum emitted(const Point3&, const Normal3& n, const Vec3& w) const override {
    return glm::dot(n, w) > 0 ? Spectrum(L_) : Spectrum(0);
  }
  float pdf(const Point3& p, const SurfaceInteraction& on) const override {
    return surface_->pdf(DPoint3(p), DPoint3(on.p), on.n) * (flaw == Flaw::density ? 2 : 1);
  }
  bool mayHit(const Point3& p, const Vec3& w) const override {
    const bool may = surface_->mayHit(DPoint3(p), DVec3(w));
    return may && (flaw != Flaw::edge || glm::length(Vec2(p - p.z / w.z * w)) < 1);
  }

 private:
  const AreaSampler* surface_;
  Bounds3 box_;
  float L_ = 1;
  Shared shared_;
};

template <Flaw flaw>
std::string found(std::string_view law) {
  return finding({&own<Light, Glow<flaw>>()}, law);
}

using testing::HasSubstr;

TEST(LightLaws, FindNothingInAGoodLight) {
  expectGood({&own<Light, Glow<Flaw::none>>()});
}

TEST(LightLaws, FindWrongSamples) {
  EXPECT_THAT(found<Flaw::direction>("samples-are-sound"), HasSubstr("of length 2, not 1"));
  EXPECT_THAT(found<Flaw::nan>("samples-are-sound"), HasSubstr("L is (1, nan, 1)"));
  EXPECT_THAT(found<Flaw::nanFar>("extremes-are-sound"), HasSubstr("pdf is inf"));
  EXPECT_THAT(found<Flaw::nanFar>("samples-are-sound"), "");
}

TEST(LightLaws, FindStrategiesThatDisagree) {
  EXPECT_THAT(found<Flaw::density>("strategies-agree"), HasSubstr("but pdf() says"));
  EXPECT_THAT(found<Flaw::density>("directions-follow-the-density"),
              HasSubstr("integrates to 1.99"));
  EXPECT_THAT(found<Flaw::radiance>("strategies-agree"), HasSubstr("but emitted() says (1, 1, 1)"));
  EXPECT_THAT(found<Flaw::radiance>("irradiance-is-that-of-the-radiance"),
              HasSubstr("by the radiance from all directions"));
  EXPECT_THAT(found<Flaw::edge>("strategies-agree"), HasSubstr("but mayHit() says"));
  EXPECT_THAT(found<Flaw::edge>("directions-follow-the-density"), HasSubstr("integrates to 0."));
}

TEST(LightLaws, FindWrongPowerAndBounds) {
  EXPECT_THAT(found<Flaw::power>("power-is-the-integral-of-emission"), HasSubstr("is 44.41"));
  EXPECT_THAT(found<Flaw::intensity>("bounds-hold"), HasSubstr("has the intensity 0.7"));
  EXPECT_THAT(found<Flaw::box>("bounds-hold"), HasSubstr("outside of the box"));
  EXPECT_THAT(found<Flaw::cone>("bounds-hold"), HasSubstr("from the axis (0, 0, -1)"));
  EXPECT_THAT(found<Flaw::surface>("missing-surface-is-said"), HasSubstr("pdf is below 0"));
}

TEST(LightLaws, FindAnswersThatDepend) {
  EXPECT_THAT(found<Flaw::unsafe>("thread-safe"), HasSubstr("while other threads ask as well"));
  EXPECT_THAT(found<Flaw::unsafe>("repeatable"), "");
  EXPECT_THAT(found<Flaw::memory>("repeatable"), HasSubstr("when asked again"));
  EXPECT_THAT(found<Flaw::twins>("twins"), HasSubstr("sample(p, u).L.x = "));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_THAT(found<Flaw::allocation>("allocates-nothing"), HasSubstr("memory was asked for 1"));
#endif
}

// A beam so narrow that only the bounds lead to it.
enum class Beam { good, tooWide, met, strong };
template <Beam kind>
class Torch final : public Light {
 public:
  Torch(Params&, const Setup& setup)
      : position_(setup.toRender.point(DPoint3(0))),
        axis_(glm::normalize(setup.toRender.vector(DVec3(0, 0, 1)))) {}

  double power(double) const override { return 2 * std::numbers::pi * kHeight; }
  LightBounds bounds() const override {
    return {{position_, position_}, 1, {axis_, 1 - (kind == Beam::tooWide ? 0.5F : 1) * kHeight}};
  }
  LightSample sample(const Point3& p, Point2) const override {
    LightSample s;
    const Vec3 w = position_ - p;
    const float d2 = lengthSquared(w);
    if (!(d2 > 0) || -glm::dot(w, axis_) / std::sqrt(d2) < 1 - kHeight) return s;
    s.L = Spectrum(1) / (kind == Beam::strong ? std::sqrt(d2) : d2);
    s.wi = w / std::sqrt(d2);
    s.p = position_;
    s.pdf = 1;
    return s;
  }
  bool mayHit(const Point3&, const Vec3&) const override { return kind == Beam::met; }

 private:
  static constexpr float kHeight = 1e-4F;
  Point3 position_;
  Vec3 axis_;
};

TEST(LightLaws, JudgeANarrowBeam) {
  expectGood({&own<Light, Torch<Beam::good>>()});
  EXPECT_THAT(finding({&own<Light, Torch<Beam::tooWide>>()}, "bounds-hold"),
              HasSubstr("is lit along"));
  EXPECT_THAT(finding({&own<Light, Torch<Beam::met>>()}, "delta-lights-are-not-found"),
              HasSubstr("is true"));
  EXPECT_THAT(finding({&own<Light, Torch<Beam::strong>>()}, "power-is-the-integral-of-emission"),
              HasSubstr("but its samples carry"));
}

// Lights without a surface that forget toRender, one flaw each.
enum class Stays { no, point, sun, sky };
template <Stays kind, Stays flaw>
class Placed final : public Light {
 public:
  Placed(Params&, const Setup& setup) {
    const Transform place = kind == flaw ? Transform() : setup.toRender;
    position_ = place.point(DPoint3(0, 0, 1));
    up_ = glm::normalize(place.vector(DVec3(0, 0, 1)));
  }
  double power(double) const override { return 4 * std::numbers::pi; }
  LightBounds bounds() const override {
    LightBounds b;
    if (kind == Stays::point) b.box = {position_, position_};
    b.intensity = 1;
    return b;
  }
  LightSample sample(const Point3& p, Point2) const override {
    LightSample s;
    s.p = position_, s.wi = up_, s.L = Spectrum(1), s.pdf = 1;
    s.finite = kind == Stays::point;
    if (s.finite) s.wi = glm::normalize(position_ - p), s.L /= lengthSquared(position_ - p);
    return s;
  }
  bool isDelta() const override { return kind != Stays::sky; }
  bool isInfinite() const override { return kind == Stays::sky; }
  Spectrum escaped(const Vec3& w) const override {
    return kind == Stays::sky ? Spectrum(1 + glm::dot(w, up_)) : Spectrum(0);
  }

 private:
  Point3 position_{};
  Vec3 up_{};
};

template <Stays kind>
void expectToMove(std::string_view says) {
  EXPECT_EQ((finding({&own<Light, Placed<kind, Stays::no>>()}, "moves-with-its-space")), "");
  EXPECT_THAT((finding({&own<Light, Placed<kind, kind>>()}, "moves-with-its-space")),
              HasSubstr(std::string(says)));
}

TEST(LightLaws, FindLightsThatStayWhereTheyAre) {
  expectToMove<Stays::point>("toRender takes the sample");
  expectToMove<Stays::sun>("toRender takes the sample");
  expectToMove<Stays::sky>("turned by toRender");
  EXPECT_THAT(judged({&own<Light, Glow<Flaw::none>>()}, "moves-with-its-space").skipped(),
              HasSubstr("a surface"));
}

}  // namespace
}  // namespace pbrt::test
