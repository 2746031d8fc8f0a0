#include "tests/materials/scattering.h"
#include "tests/scenes.h"

namespace pbrt::test {
namespace {

// "red" is a matte, "gloss" has several lobes, "clear" is smooth glass; "two" mixes and "three"
// mixes a mix.
class Shelf final : public TextureLibrary {
 public:
  std::shared_ptr<const Texture<float>> floatTexture(const std::string& name) override {
    throw Error("no texture " + name);
  }
  std::shared_ptr<const Texture<Spectrum>> spectrumTexture(const std::string& name) override {
    throw Error("no texture " + name);
  }
  std::shared_ptr<const Material> material(const std::string& name) override {
    if (name == "red") return make<Material>("matte", {rgb("Kd", 0.8F, 0.1F, 0.1F)});
    if (name == "gloss") return make<Material>("uber", {rgb("Kr", 0.3F, 0.2F, 0.1F)});
    if (name == "clear") return make<Material>("glass");
    if (name == "two") return mix({named("red"), named("gloss", 2)});
    if (name == "three") return mix({named("two"), named("two", 2)});
    throw Error("no material " + name);
  }

  static Param named(const std::string& material, int which = 1) {
    return text("namedmaterial" + std::to_string(which), material);
  }
  std::shared_ptr<const Material> mix(const ParamList& list) {
    Params params("materials/mix", {}, {&list}, this);
    std::shared_ptr<const Material> material =
        create<Material>(loader().open(PluginKind::material, "mix"), params, {});
    params.refuseUnread();
    return material;
  }
};

Scattering of(const std::string& name) {
  return Scattering(*Shelf().material(name));
}

TEST(Mix, IsTheWeightedSumOfItsMaterials) {
  const Scattering red = of("red"), gloss = of("gloss");
  const Scattering mixed(
      *Shelf().mix({Shelf::named("red"), Shelf::named("gloss", 2), rgb("amount", 0.25F, 0.5F, 1)}));
  const Spectrum share(0.25F, 0.5F, 1);
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = uniformSphere({rng.uniform(), rng.uniform()});
    const Vec3 b = uniformSphere({rng.uniform(), rng.uniform()});
    const Spectrum wanted = share * red->f(a, b) + (1.F - share) * gloss->f(a, b);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(mixed->f(a, b)[c], wanted[c], 1e-5F);
  }
  // The mirror image of uber, which no f() sees, has its share as well.
  const double alone = albedo(*gloss.operator->(), direction(30), 100000, kReflection | kSpecular);
  const double share2 = albedo(*mixed.operator->(), direction(30), 100000, kReflection | kSpecular);
  EXPECT_GT(alone, 0.005);
  EXPECT_NEAR(share2, 0.5 * alone, 1e-3 * alone);
}

TEST(Mix, V4CountsTheShareOfTheSecond) {
  const Param both{
      ParamType::string, "materials", {}, {}, std::vector<std::string>{"red", "clear"}};
  const Scattering mixed(*Shelf().mix({both, number("amount", 0.9F)})), red = of("red");
  EXPECT_NEAR(mixed->f(direction(20), direction(40)).x,
              0.1F * red->f(direction(20), direction(40)).x, 1e-6F);
}

TEST(Mix, AMaterialWithoutAShareIsNotThere) {
  const Scattering mixed(
      *Shelf().mix({Shelf::named("red"), Shelf::named("clear", 2), number("amount", 1)}));
  EXPECT_FALSE(mixed->has(kSpecular));
  EXPECT_EQ(mixed->lobes(kAllLobes), 1);
}

TEST(Mix, NestsTwice) {
  const Scattering red = of("red"), gloss = of("gloss"), nested = of("three");
  const Vec3 a = direction(20), b = direction(50);
  EXPECT_NEAR(nested->f(a, b).x, 0.5F * (red->f(a, b).x + gloss->f(a, b).x), 1e-5F);
  EXPECT_THROW(Shelf().mix({Shelf::named("three"), Shelf::named("red", 2)}), Error);
}

TEST(Mix, NeedsTwoMaterialsByOneWayOfNamingThem) {
  EXPECT_THROW(Shelf().mix({}), Error);
  EXPECT_THROW(Shelf().mix({Shelf::named("red")}), Error);
  EXPECT_THROW(Shelf().mix({Shelf::named("nothing"), Shelf::named("red", 2)}), Error);
  const Param both{
      ParamType::string, "materials", {}, {}, std::vector<std::string>{"red", "clear"}};
  EXPECT_THROW(Shelf().mix({both, Shelf::named("red")}), Error);
}

// In a scene, materials of the block at the statement.
TEST(Mix, FindsNamedMaterialsOfTheScene) {
  const auto scene = [](const std::string& mix) {
    return "Sampler \"random\" \"integer pixelsamples\" 1 WorldBegin\n"
           "MakeNamedMaterial \"a\" \"string type\" \"matte\"\n"
           "MakeNamedMaterial \"b\" \"string type\" \"none\"\n" +
           mix + "\nShape \"disk\" WorldEnd";
  };
  EXPECT_NO_THROW(buildText(
      scene("Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"a\"")));
  try {
    buildText(
        scene("Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" "
              "\"b\""));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("\"b\" is no surface"), std::string::npos);
    EXPECT_EQ(error.diagnostics().at(0).line, 4U);
  }
}

}  // namespace
}  // namespace pbrt::test
