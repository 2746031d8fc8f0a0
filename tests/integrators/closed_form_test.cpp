// Renders against radiance that is known in closed form.

#include "tests/command.h"
#include "tests/integrators/estimate.h"

namespace pbrt {
namespace {

using namespace test;

constexpr double kWhite = 0.8;  // reflectance of what is lit
const std::string kMatte = "Material \"matte\" \"rgb Kd\" [0.8 0.8 0.8]\n";
const std::string kBlack = "Material \"matte\" \"rgb Kd\" [0 0 0]\n";
const std::string kFromAbove = "0 -0.2 0.2  0 0 0  0 0 1";
const std::string kFloor = kMatte + "Shape \"disk\" \"float radius\" 0.4\n";
constexpr double kPiD = std::numbers::pi;

std::vector<std::string> integrators() {
  return {path(1), "\"directlighting\"", "\"whitted\""};
}

// Light from the side, the phase angle a: a Lambertian ball of radius 1 has the mean radiance
// rho E / pi times 2 / 3 (sin a + (pi - a) cos a) / pi over its disk (Lambert 1760; Seeliger).
TEST(ClosedForm, PhasesOfALitSphere) {
  for (const double a : {0.0, 0.5, 1.5, 2.5}) {
    const std::string world =
        fmt::format("LightSource \"distant\" \"point from\" [{} 0 {}] \"point to\" [0 0 0]\n",
                    std::sin(a), -std::cos(a)) +
        kMatte + "Shape \"sphere\"\n";
    const double expected = kWhite / kPiD * 2 / 3 * (std::sin(a) + (kPiD - a) * std::cos(a)) / kPiD;
    for (const std::string& integrator : integrators()) {
      // The square about the disk holds 4 / pi of its area.
      const Image image = renderText(
          "LookAt 0 0 -5  0 0 0  0 1 0 Camera \"orthographic\"\n"
          "Film \"image\" \"integer xresolution\" 80 \"integer yresolution\" 80\n"
          "PixelFilter \"box\" Sampler \"stratified\" \"integer xsamples\" 8 \"integer ysamples\" "
          "8\nIntegrator " +
          integrator + " WorldBegin\n" + world);
      // The crescent of 2.5 has a standard deviation of 0.1 % over seeds.
      const double mean = expected * kPiD / 4;
      EXPECT_NEAR(test::mean(image, "G"), mean, 4e-3 * mean) << a << integrator;
    }
  }
}

// E = I cos / d^2, whatever the distance.
TEST(ClosedForm, FalloffOfAPoint) {
  for (const double d : {1e-3, 0.1, 1.0, 1e3, 1e6})
    for (const double tilt : {0.0, 1.0, 1.5})
      for (const std::string& integrator : integrators()) {
        const std::string light =
            fmt::format("LightSource \"point\" \"rgb I\" [3 3 3] \"point from\" [{} 0 {}]\n",
                        d * std::sin(tilt), d * std::cos(tilt));
        const Estimate e = estimate(kFromAbove, integrator, light + kFloor, 4);
        const double expected = kWhite / kPiD * 3 * std::cos(tilt) / (d * d);
        // The pixels see points that are some 3e-6 apart.
        EXPECT_NEAR(e.mean, expected, expected * (2e-5 + 1e-5 / d)) << d << " " << tilt;
      }
}

// Within the cone its intensity, in the soft edge the fourth power of how far the cosine has come,
// outside nothing.
TEST(ClosedForm, ConeOfASpot) {
  const auto cosine = [](double degrees) { return std::cos(degrees * kPiD / 180); };
  for (const double off : {0.0, 19.9, 22.0, 25.0, 29.0, 30.1})
    for (const std::string& integrator : integrators()) {
      const double a = off * kPiD / 180;
      // Two units above the middle, and aimed aside.
      const std::string light = fmt::format(
          "LightSource \"spot\" \"rgb I\" [5 5 5] \"float coneangle\" 30 \"float conedeltaangle\" "
          "10 \"point from\" [0 0 2] \"point to\" [{} 0 {}]\n",
          std::sin(a), 2 - std::cos(a));
      const double share =
          off < 20 ? 1 : std::pow((cosine(off) - cosine(30)) / (cosine(20) - cosine(30)), 4);
      const double expected = off > 30 ? 0 : kWhite / kPiD * 5 / 4 * share;
      EXPECT_NEAR(estimate(kFromAbove, integrator, light + kFloor, 4).mean, expected,
                  1e-4 * expected)
          << off;
    }
}

// A disk of radius r that hangs parallel to the floor, h above it and a to the side:
// F = 1/2 (1 - (a^2 + h^2 - r^2) / sqrt((a^2 + h^2 + r^2)^2 - 4 r^2 a^2)) (Howell and Menguc, A
// Catalog of Radiation Heat Transfer Configuration Factors, B-13).
TEST(ClosedForm, IrradianceOfADiskToTheSide) {
  for (const auto& [r, h, a] : {std::array{1.0, 1.0, 0.5}, {0.1, 1.0, 2.0}, {3.0, 0.2, 3.0}}) {
    const std::string light = fmt::format(
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] {} Translate {} 0 {} "
        "ReverseOrientation Shape \"disk\" \"float radius\" {} AttributeEnd\n",
        kBlack, a, h, r);
    const double sum = a * a + h * h + r * r;
    const double F = 0.5 * (1 - (sum - 2 * r * r) / std::sqrt(sum * sum - 4 * r * r * a * a));
    for (const std::string& integrator : integrators())
      expectMean(estimate(kFromAbove, integrator, light + kFloor), kWhite * 5 * F);
  }
}

// Two plates without end, one of which shines with radiance 1: B1 = 1 + rho1 B2, B2 = rho2 B1. A
// million units across, one apart, they have ends that nobody sees: F = 1 - 4e-12.
TEST(ClosedForm, InterreflectionOfParallelPlates) {
  constexpr double rho1 = 0.5, rho2 = 0.8;
  const std::string plates =
      "AttributeBegin Material \"matte\" \"rgb Kd\" [0.5 0.5 0.5] AreaLightSource \"diffuse\"\n"
      "Translate 0 0 1 ReverseOrientation Shape \"disk\" \"float radius\" 1e6 AttributeEnd\n" +
      kMatte + "Shape \"disk\" \"float radius\" 1e6\n";
  const double shining = 1 / (1 - rho1 * rho2);
  expectMean(estimate("0 -0.2 0.5  0 0 0  0 0 1", path(100), plates), rho2 * shining);
  expectMean(estimate("0 -0.2 0.5  0 0 1  0 0 1", path(100), plates), shining);
  // And bounce by bounce: rho2 (1 + rho1 rho2 + ...).
  expectMean(estimate("0 -0.2 0.5  0 0 0  0 0 1", path(1), plates), rho2);
  expectMean(estimate("0 -0.2 0.5  0 0 0  0 0 1", path(3), plates), rho2 * (1 + rho1 * rho2));
}

// A sky over half of the sphere lights a surface tilted by b with pi (1 + cos b) / 2.
TEST(ClosedForm, HalfASky) {
  const Folder folder;
  std::string pixels = "Pf 1 1000 -1\n";  // rows from the bottom
  for (int y = 0; y < 1000; ++y) {
    const float v = y < 500 ? 0 : 1;
    pixels.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  folder.write("sky.pfm", pixels);
  const std::string light = fmt::format("LightSource \"infinite\" \"string mapname\" \"{}\"\n",
                                        (folder.path() / "sky.pfm").string());
  for (const double b : {0.0, 0.7, 1.5, 2.5}) {
    const std::string floor = fmt::format("Rotate {} 1 0 0\n", -b * 180 / kPiD) + kFloor;
    // From along the tilted floor's normal.
    const std::string view = fmt::format("0.01 {} {}  0 0 0  1 0 0", std::sin(b), std::cos(b));
    for (const std::string& integrator : integrators()) {
      const Estimate e = estimate(view, integrator, light + floor);
      const double expected = kWhite * (1 + std::cos(b)) / 2;
      EXPECT_NEAR(e.mean, expected, kSigmas * e.error() + 1e-5) << b << integrator;
    }
  }
}

// A closed room whose walls lose nothing, and a lamp that takes what falls on it: whatever they
// look like, in the end everything has the lamp's radiance (Kirchhoff 1860). Paths end at the lamp
// alone: of those that are scattered 1000 times (1 - the lamp's share)^1000 are left, and roulette
// must leave them all.
TEST(ClosedForm, ARoomThatLosesNothing) {
  const std::string room =
      "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [3 3 3]\n" + kBlack +
      "Translate 0.3 0.2 0.1 Shape \"sphere\" \"float radius\" 0.3 AttributeEnd\n"
      "Material \"matte\" \"rgb Kd\" [1 1 1] ReverseOrientation Shape \"sphere\"\n";
  const std::string view = "-0.5 0 -0.3  -0.9 0.1 -0.2  0 0 1";
  const Estimate e = estimate(view, path(1000), room, 60);
  expectMean(e, 3);
  EXPECT_LT(e.error(), 0.05 * e.mean);
  expectMean(estimate(view, path(1000, "\"float rrthreshold\" 0"), room, 60), 3);
}

// The same walls shine with radiance 1: each scattering adds 1, and none ends a path.
TEST(ClosedForm, AThousandScatteringsOfAlbedoOne) {
  const std::string room =
      "Material \"matte\" \"rgb Kd\" [1 1 1] AreaLightSource \"diffuse\" ReverseOrientation\n"
      "Shape \"sphere\"\n";
  expectMean(estimate("0.2 0.1 0.3  0.9 -0.4 -0.2  0 0 1", path(1000), room, 24), 1001);
}

}  // namespace
}  // namespace pbrt
