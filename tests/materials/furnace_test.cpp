// Materials in evenly bright surroundings.

#include "tests/integrators/estimate.h"
#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

std::string number(const std::string& name, float v) {
  return fmt::format("\"float {}\" {} ", name, v);
}

struct White {
  std::string name;
  ParamList set;
  double least;  // what facets mask is lost
};

void PrintTo(const White& w, std::ostream* out) {
  *out << w.name;
}

class WhiteFurnace : public testing::TestWithParam<White> {};

// A material that absorbs nothing sends back all light, from any angle.
TEST_P(WhiteFurnace, NothingIsLostOrMade) {
  const auto& [name, set, least] = GetParam();
  const Scattering bsdf(name, set);
  double lowest = 2;
  for (const double angle : {0., 30., 60., 80., 88., 120., 160.}) {
    Mean m;
    Rng rng(1);
    for (int i = 0; i < 20000; ++i) {
      const auto s = bsdf->sample(direction(angle), {rng.uniform(), rng.uniform()});
      m.add(s ? s->f.y * std::abs(s->wi.z) * sqr(s->eta) / s->pdf : 0);
    }
    EXPECT_LE(m.mean(), 1 + 4 * m.error() + 2e-5) << angle;
    EXPECT_GE(m.mean(), least - 4 * m.error() - 2e-5) << angle;
    lowest = std::min(lowest, m.mean());
  }
  RecordProperty("lowest", fmt::format("{:.4f}", lowest));
}

const Param kWhiteKd = rgb("Kd", 1, 1, 1), kAlpha = flag("remaproughness", false);
const Param kNoKs = rgb("Ks", 0, 0, 0);

INSTANTIATE_TEST_SUITE_P(
    Materials, WhiteFurnace,
    testing::Values(
        White{"matte", {kWhiteKd}, 1}, White{"plastic", {kWhiteKd, kNoKs}, 1},
        White{"uber", {kWhiteKd, kNoKs}, 1}, White{"uber", {rgb("opacity", 0, 0, 0)}, 1},
        White{"uber", {kWhiteKd, kNoKs, rgb("opacity", 0.3F, 0.3F, 0.3F)}, 1},
        White{"uber", {rgb("Kd", 0, 0, 0), kNoKs, rgb("Kr", 1, 1, 1), rgb("Kt", 1, 1, 1)}, 1},
        White{
            "translucent",
            {kWhiteKd, kNoKs, rgb("reflect", 0.7F, 0.7F, 0.7F), rgb("transmit", 0.3F, 0.3F, 0.3F)},
            1},
        White{"diffusetransmission",
              {rgb("reflectance", 0.9F, 0.9F, 0.9F), rgb("transmittance", 0.1F, 0.1F, 0.1F)},
              1},
        White{"mirror", {rgb("Kr", 1, 1, 1)}, 1}, White{"glass", {}, 1},
        White{"glass", {test::number("index", 1000)}, 1},
        White{"glass", {test::number("index", 1.0000001F)}, 1},
        White{"glass", {test::number("roughness", 0.2F), kAlpha}, 0.8},
        White{"glass",
              {test::number("roughness", 0.2F), kAlpha, text("distribution", "beckmann")},
              0.8},
        White{"thindielectric", {}, 1},
        White{"coateddiffuse", {rgb("reflectance", 1, 1, 1)}, 0.995},
        White{"metal", {rgb("reflectance", 1, 1, 1), test::number("roughness", 0)}, 0.998},
        White{
            "metal", {rgb("reflectance", 1, 1, 1), test::number("roughness", 0.1F), kAlpha}, 0.85},
        White{"metal",
              {rgb("reflectance", 1, 1, 1), test::number("roughness", 0.1F), kAlpha,
               text("distribution", "beckmann")},
              0.85},
        White{"coatedconductor",
              {rgb("reflectance", 1, 1, 1), test::number("conductor.roughness", 0)},
              0.99}),
    [](const auto& test) { return fmt::format("{}{}", test.param.name, test.index); });

// The share of light from wo that f() says is scattered: by midpoints, even over the sphere. The
// specular lobes add theirs.
double integral(const Bsdf& bsdf, const Vec3& wo) {
  constexpr int n = 1200, m = 600;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double z = -1 + (i + 0.5) * 2 / n, r = std::sqrt(1 - z * z);
    for (int j = 0; j < m; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / m;
      sum += bsdf.f(wo, {r * std::cos(phi), r * std::sin(phi), z}).y * std::abs(z);
    }
  }
  sum *= 4 * std::numbers::pi / (static_cast<double>(n) * m);
  for (const std::uint8_t side : {kReflection, kTransmission}) {
    const std::uint8_t wanted = side | kSpecular;
    Rng rng(1);
    constexpr int samples = 20000;
    double specular = 0;
    for (int i = 0; i < samples; ++i)
      if (const auto s = bsdf.sample(wo, {rng.uniform(), rng.uniform()}, wanted))
        specular += s->f.y * std::abs(s->wi.z) / s->pdf;
    sum += specular / samples;
  }
  return sum;
}

// A disk of every material, seen at an angle where everything shines with radiance 1, has its
// albedo; the light that it refracts is thinned by the square of the index.
TEST(Furnace, PathsRenderTheAlbedoOfEveryMaterial) {
  for (const std::string& name : loader().available(PluginKind::material)) {
    if (name == "mix") continue;
    SCOPED_TRACE(name);
    const bool metal = name == "metal" || name == "coatedconductor";
    const std::string rough =
        metal ? name == "metal" ? number("roughness", 0.2F) : number("conductor.roughness", 0.2F)
              : "";
    ParamList set;
    if (metal)
      set.push_back(test::number(name == "metal" ? "roughness" : "conductor.roughness", 0.2F));
    const Scattering bsdf(name, set);
    for (const double angle : {20., 65.}) {
      const Vec3 wo = direction(angle, 0);
      const std::string view = fmt::format("{} 0 {}  0 0 0  0 1 0", 3 * wo.x, 3 * wo.z);
      const std::string world = fmt::format(
          "LightSource \"infinite\" \"rgb L\" [1 1 1] Material \"{}\" {} Shape \"disk\"", name,
          rough);
      const Estimate e = estimate(view, path(1), world);
      const double expected = integral(*bsdf.operator->(), wo);
      EXPECT_NEAR(e.mean, expected, kSigmas * e.error() + 3e-3 * expected) << angle;
    }
  }
}

}  // namespace
}  // namespace pbrt::test
