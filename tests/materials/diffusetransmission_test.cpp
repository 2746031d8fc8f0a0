#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

TEST(DiffuseTransmission, SharesAreWhatIsScattered) {
  const Scattering paper("diffusetransmission",
                         {rgb("reflectance", 0.3F, 0, 0.6F), rgb("transmittance", 0.2F, 0.5F, 0.9F),
                          number("scale", 0.5F)});
  for (const double angle : {10.0, 80.0, 120.0}) {
    const Vec3 wo = direction(angle), back(0, 0, wo.z > 0 ? 1 : -1);
    EXPECT_NEAR(paper->f(wo, back).x, 0.15 / std::numbers::pi, 1e-6);
    EXPECT_NEAR(paper->f(wo, -back).x, 0.1 / std::numbers::pi, 1e-6);
    EXPECT_NEAR(paper->f(wo, -back).z, 0.45 / std::numbers::pi, 1e-6);
    EXPECT_NEAR(albedo(*paper.operator->(), wo, 20000), 0.25, 2e-3);
  }
}

TEST(DiffuseTransmission, ScaleCannotMakeLight) {
  const Scattering paper("diffusetransmission", {number("scale", 100)});
  EXPECT_NEAR(paper->f({0, 0, 1}, {0, 0, 1}).x, 1 / std::numbers::pi, 1e-6);
}

}  // namespace
}  // namespace pbrt::test
