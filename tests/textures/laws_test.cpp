// Laws for every texture that can be found, of both kinds.

#include "core/base/rng.h"
#include "tests/textures/imagemap.h"

namespace pbrt::test {
namespace {

SurfaceInteraction somewhere(Rng& rng, float size) {
  const auto x = [&] { return size * (2 * rng.uniform() - 1); };
  SurfaceInteraction at;
  at.p = {x(), x(), x()};
  at.uv = {x(), x()};
  at.dpdx = {x(), x(), x()};
  at.dpdy = {x(), x(), x()};
  at.dudx = x();
  at.dvdx = x();
  at.dudy = x();
  at.dvdy = x();
  return at;
}

bool finite(float v) {
  return std::isfinite(v);
}
bool finite(const Spectrum& v) {
  return isFinite(v);
}

template <class T, class Check>
void forEveryTexture(Check check) {
  const Folder folder;
  folder.write("a.pfm", "Pf 3 2 -1\n" + std::string(24, '?'));  // 0.7471
  const std::string file = (folder.path() / "a.pfm").string();
  const ParamList sets[] = {{},
                            {text("filename", file)},
                            {text("filename", file), text("mapping", "spherical")},
                            {text("filename", file), text("mapping", "planar")},
                            {text("mapping", "spherical")},
                            {text("mapping", "cylindrical")},
                            {text("mapping", "planar")},
                            {integers("dimension", {3})}};
  int made = 0;
  for (const std::string& name : loader().available(PluginKind::texture))
    for (const ParamList& set : sets) {
      SCOPED_TRACE(name + (set.empty() ? "" : " " + set[0].name));
      std::unique_ptr<Texture<T>> texture;
      try {
        texture = make<Texture<T>>(name, set);
      } catch (const Error&) {
        continue;
      }
      ++made;
      check(*texture);
    }
  EXPECT_GE(made, 23);
}

template <class T>
class TextureLaws : public testing::Test {};
using Kinds = testing::Types<float, Spectrum>;
TYPED_TEST_SUITE(TextureLaws, Kinds);

TYPED_TEST(TextureLaws, FiniteEverywhere) {
  forEveryTexture<TypeParam>([](const Texture<TypeParam>& texture) {
    Rng rng(1);
    for (const float size : {0.F, 1e-20F, 1.F, 1e4F, 1e9F, 1e18F, 1e30F, 1e38F})
      for (int i = 0; i < 200; ++i)
        ASSERT_TRUE(finite(texture.evaluate(somewhere(rng, size)))) << size;
  });
}

// Who says that it does not filter must not read the footprint: rays may carry none.
TYPED_TEST(TextureLaws, OnlyFiltersReadTheFootprint) {
  forEveryTexture<TypeParam>([](const Texture<TypeParam>& texture) {
    if (texture.filters()) return;
    Rng rng(2);
    for (int i = 0; i < 500; ++i) {
      SurfaceInteraction wide = somewhere(rng, 3), narrow = wide;
      narrow.dpdx = narrow.dpdy = Vec3(0);
      narrow.dudx = narrow.dvdx = narrow.dudy = narrow.dvdy = 0;
      ASSERT_EQ(texture.evaluate(wide), texture.evaluate(narrow));
    }
  });
}

}  // namespace
}  // namespace pbrt::test
