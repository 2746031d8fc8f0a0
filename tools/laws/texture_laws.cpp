// The laws of every texture, as one of floats and as one of colours.

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "laws.h"
#include "probe.h"
#include "show.h"
#include "steady.h"

namespace pbrt::laws {
namespace {

// Up to that size everything that a texture may read.
SurfaceInteraction somewhere(Rng& rng, float size) {
  const auto x = [&] { return size * (2 * rng.uniform() - 1); };
  SurfaceInteraction at;
  at.p = {x(), x(), x()};
  at.objectP = at.p;
  at.uv = {x(), x()};
  at.dpdu = {x(), x(), x()};
  at.dpdv = {x(), x(), x()};
  at.dpdx = {x(), x(), x()};
  at.dpdy = {x(), x(), x()};
  at.dudx = x();
  at.dvdx = x();
  at.dudy = x();
  at.dvdy = x();
  at.n = at.ns = uniformSphere({rng.uniform(), rng.uniform()});
  at.wo = uniformSphere({rng.uniform(), rng.uniform()});
  return at;
}

std::string show(float v) {
  return fmt::format("{}", v);
}
bool isFinite(float v) {
  return std::isfinite(v);
}
using laws::show;
using pbrt::isFinite;

std::string place(const SurfaceInteraction& at) {
  return fmt::format("uv {}, p {}", show(at.uv), show(at.p));
}

template <class T>
constexpr std::string_view kKind = std::is_same_v<T, float> ? "float" : "spectrum";

// As textures of the kind are asked for; null: there are none of that kind.
template <class T>
std::unique_ptr<Texture<T>> made(const Subject& subject) {
  try {
    return subject.make<Texture<T>>();
  } catch (const Error&) {
    return nullptr;
  }
}

// check.operator()<T>(texture, judge) for each kind that can be made; Error if none can.
template <class Check>
void forBothKinds(const Subject& subject, Check check) {
  const auto colour = made<Spectrum>(subject);
  if (colour) check(*colour);
  if (const auto number = made<float>(subject))
    check(*number);
  else if (!colour)
    subject.make<Texture<float>>();  // says why not
}

void finiteEverywhere(const Subject& subject, Judge& judge) {
  forBothKinds(subject, [&]<class T>(const Texture<T>& texture) {
    Rng rng(1);
    for (const float size : {0.F, 1e-20F, 1.F, 1e4F, 1e9F, 1e18F, 1e30F, 1e38F}) {
      if (size > 1e18F && !subject.traits.finiteAtAnySize) break;
      for (int i = 0; i < 200; ++i) {
        const SurfaceInteraction at = somewhere(rng, size);
        const T value = texture.evaluate(at);
        judge.expect(isFinite(value), "the {} texture has the value {} at {}", kKind<T>,
                     show(value), place(at));
      }
    }
  });
}

// Who says that it does not filter must not read the footprint: rays may carry none.
void onlyFiltersReadTheFootprint(const Subject& subject, Judge& judge) {
  bool any = false;
  forBothKinds(subject, [&]<class T>(const Texture<T>& texture) {
    if (texture.filters()) return;
    any = true;
    Rng rng(2);
    for (int i = 0; i < 500; ++i) {
      SurfaceInteraction wide = somewhere(rng, 3), narrow = wide;
      narrow.dpdx = narrow.dpdy = Vec3(0);
      narrow.dudx = narrow.dvdx = narrow.dudy = narrow.dvdy = 0;
      const T with = texture.evaluate(wide), without = texture.evaluate(narrow);
      judge.expect(with == without,
                   "the {} texture is {} with a footprint and {} without at {}, but filters() is "
                   "false: rays have no footprint then",
                   kKind<T>, show(with), show(without), place(wide));
    }
  });
  if (!any) judge.skip("it filters");
}

template <class T>
void expectFilteringIsSaid(const Subject& subject, bool& any, Judge& judge) {
  if (!made<T>(subject)) return;
  forEveryTextureIn<Texture<T>>(
      subject, 0.5F, [&](const std::string& name, const Texture<T>& texture, const Probes& probes) {
        any = true;
        Rng rng(3);
        for (int i = 0; i < 500; ++i) {
          const T value = texture.evaluate(somewhere(rng, 3));
          judge.expect(isFinite(value), "with a texture \"{}\" of 0.5 the {} texture is {}", name,
                       kKind<T>, show(value));
        }
        judge.expect(!probes.asked() || texture.filters(),
                     "the {} texture looks into its texture \"{}\", which filters, but its "
                     "filters() is false: rays have no footprint then",
                     kKind<T>, name);
      });
}

void filteringIsSaid(const Subject& subject, Judge& judge) {
  bool any = false;
  expectFilteringIsSaid<Spectrum>(subject, any, judge);
  expectFilteringIsSaid<float>(subject, any, judge);
  if (!any) judge.skip("no parameter may be a texture");
}

// Each question is a place, the answer the values there of both kinds.
struct TextureQuestions {
  explicit TextureQuestions(const Subject& subject)
      : number(made<float>(subject)), colour(made<Spectrum>(subject)) {
    if (!number && !colour) subject.make<Texture<float>>();  // says why not
    Rng rng(4);
    for (int i = 0; i < count; ++i) asked.push_back(somewhere(rng, 3));
  }

  static constexpr std::array<std::string_view, 4> names = {
      "the float texture", "the spectrum texture's red", "its green", "its blue"};
  std::array<float, 4> ask(int i) const {
    const Spectrum c = colour ? colour->evaluate(asked[i]) : Spectrum(0);
    return {number ? number->evaluate(asked[i]) : 0, c.x, c.y, c.z};
  }
  std::string about(int i) const { return fmt::format("at {}", place(asked[i])); }

  std::unique_ptr<Texture<float>> number;
  std::unique_ptr<Texture<Spectrum>> colour;
  std::vector<SurfaceInteraction> asked;
  static constexpr int count = 1000;
};

}  // namespace

std::span<const Law> textureLaws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> laws = {
        {"finite-everywhere", "values are finite wherever a surface is", finiteEverywhere},
        {"only-filters-read-the-footprint", "only a texture that filters reads the footprint",
         onlyFiltersReadTheFootprint},
        {"filtering-is-said", "filters() tells if a texture within it filters", filteringIsSaid},
    };
    laws.insert(laws.end(), Steady<TextureQuestions>::laws.begin(),
                Steady<TextureQuestions>::laws.end());
    return laws;
  }();
  return all;
}

}  // namespace pbrt::laws
