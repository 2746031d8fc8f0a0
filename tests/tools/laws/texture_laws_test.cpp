// The laws of textures find wrong textures, and nothing in a right one.

#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum class Flaw {
  none,
  infinite,
  overflow,
  footprint,
  silent,
  unsafe,
  memory,
  twins,
  allocation,
  noKind
};

Shared made;

// u times an inner texture, with one flaw.
template <Flaw flaw>
struct Of {
  template <class T>
  class Ramp final : public Texture<T> {
   public:
    explicit Ramp(Params& p) : inside_(p.texture<T>("inside", 1, "is multiplied by u")) {
      if constexpr (flaw == Flaw::noKind) throw Error("there is no such texture");
      if constexpr (flaw == Flaw::twins) shift_ = made.next();
    }
    T evaluate(const SurfaceInteraction& at) const override {
      float u = glm::clamp(at.uv.x, -10.F, 10.F) + shift_;
      if constexpr (flaw == Flaw::infinite) u = 1 / at.uv.x;
      if constexpr (flaw == Flaw::overflow) u = std::sin(lengthSquared(at.p));
      if constexpr (flaw == Flaw::footprint) u += at.dudx;
      if constexpr (flaw == Flaw::unsafe) u = shared_.through(u);
      if constexpr (flaw == Flaw::memory) u += shared_.next();
      if constexpr (flaw == Flaw::allocation) ::operator delete(::operator new(8));
      return u * inside_(at);
    }
    bool filters() const override { return flaw != Flaw::silent && inside_.filters(); }

   private:
    Textured<T> inside_;
    float shift_ = 0;
    Shared shared_;
  };
};

template <Flaw flaw>
const PluginInfo& ramp() {
  return own<Texture<float>, typename Of<flaw>::template Ramp<float>,
             typename Of<flaw>::template Ramp<Spectrum>>();
}

template <Flaw flaw>
std::string found(std::string_view law) {
  return finding({&ramp<flaw>()}, law);
}

using testing::HasSubstr;

TEST(TextureLaws, FindNothingInAGoodTexture) {
  expectGood({&ramp<Flaw::none>()});
}

// Squares overflow in most formulas; those who promise more are held to it.
TEST(TextureLaws, GoToNoSizeWhoseSquareOverflows) {
  const PluginInfo& rings = ramp<Flaw::overflow>();
  EXPECT_EQ(judged({&rings}, "finite-everywhere").failures(), 0U);
  EXPECT_GT(judged({&rings, {}, {.finiteAtAnySize = true}}, "finite-everywhere").failures(), 0U);
}

TEST(TextureLaws, FindWrongTextures) {
  EXPECT_THAT(found<Flaw::infinite>("finite-everywhere"),
              HasSubstr("spectrum texture has the value (-inf, -inf, -inf) at uv (-0, -0)"));
  EXPECT_THAT(found<Flaw::footprint>("only-filters-read-the-footprint"),
              HasSubstr("but filters() is false"));
  EXPECT_THAT(found<Flaw::silent>("filtering-is-said"), HasSubstr("its texture \"inside\""));
  EXPECT_THROW(found<Flaw::noKind>("finite-everywhere"), Error);
}

TEST(TextureLaws, FindAnswersThatDepend) {
  EXPECT_THAT(found<Flaw::unsafe>("thread-safe"), HasSubstr("while other threads ask as well"));
  EXPECT_THAT(found<Flaw::unsafe>("repeatable"), "");
  EXPECT_THAT(found<Flaw::memory>("repeatable"), HasSubstr("when asked again"));
  EXPECT_THAT(found<Flaw::twins>("twins"), HasSubstr("the float texture = "));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_THAT(found<Flaw::allocation>("allocates-nothing"), HasSubstr("memory was asked for 2"));
#endif
}

}  // namespace
}  // namespace pbrt::test
