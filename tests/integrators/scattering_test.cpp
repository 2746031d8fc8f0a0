// Light that media scatter: once, against quadrature in double; and again and again, where the sum
// is known.

#include "tests/integrators/media.h"

namespace pbrt {
namespace {

using namespace test;

// In pbrt-v2 the path tracers' maxdepth leaves out the first scattering: 0 is once.
//
// A box from z = 0 to 1 about the z axis with a point light inside of it: what goes to the camera
// at z = -5 after one scattering.
struct Fog {
  DVec3 absorption, scattering;
  double g;
  DPoint3 light;
};

double henyey(double g, double cosine) {
  return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

DVec3 onceScattered(const Fog& fog) {
  constexpr int kSteps = 100000;
  DVec3 sum(0);
  for (int i = 0; i < kSteps; ++i) {
    const double z = (i + 0.5) / kSteps;
    const DVec3 way = DPoint3(0, 0, z) - fog.light;  // of the light; it goes on along -z
    const double distance = glm::length(way);
    const double phase = henyey(fog.g, -way.z / distance);
    sum += fog.scattering * glm::exp(-(fog.absorption + fog.scattering) * (z + distance)) *
           (phase / sqr(distance) / kSteps);
  }
  return sum;
}

const Fog kFogs[] = {{{0.1, 0.2, 0.3}, {0.5, 0.6, 0.2}, 0, {0.4, 0.2, 0.5}},
                     {{0, 0, 0}, {2, 1, 4}, 0.6, {0.3, 0.1, 0.8}},
                     {{1, 3, 0.5}, {0.1, 7, 0.3}, -0.7, {0.1, 0.3, 0.2}}};

std::string rgb(const DVec3& v) {
  return fmt::format("[{} {} {}]", v.x, v.y, v.z);
}

std::string sigmas(const Fog& fog) {
  return fmt::format("\"color sigma_a\" {} \"color sigma_s\" {} \"float g\" {} ",
                     rgb(fog.absorption), rgb(fog.scattering), fog.g);
}

std::string lamp(const Fog& fog) {
  return fmt::format("LightSource \"point\" \"color I\" [1 1 1] \"point from\" {}\n",
                     rgb(fog.light));
}
const std::string kBox = "\"point p0\" [-9 -9 0] \"point p1\" [9 9 1] ";

TEST(Scattering, OnceIsWhatQuadratureSays) {
  for (const Fog& fog : kFogs) {
    SCOPED_TRACE(fog.g);
    const DVec3 expected = onceScattered(fog);
    const std::string region = lamp(fog) + "Volume \"homogeneous\" " + kBox + sigmas(fog);
    expectColour(measure(regionScene("\"single\" \"float stepsize\" 0.1", region, "\"whitted\"")),
                 expected, 1e-4);
    expectColour(measure(regionScene("", region, "\"volpath\" \"integer maxdepth\" 0", 200)),
                 expected, 1e-4);
    // The same as voxels that differ, but not in density.
    const std::string grid = lamp(fog) +
                             "Volume \"volumegrid\" \"integer nz\" 2 \"float density\" [1 1] " +
                             kBox + sigmas(fog);
    expectColour(measure(regionScene("\"single\" \"float stepsize\" 0.05", grid, "\"whitted\"")),
                 expected, 1e-4);
  }
}

// An area light is found both by sampling it and by sampling the phase function.
TEST(Scattering, BothStrategiesFindTheSameLight) {
  const std::string ball =
      "AreaLightSource \"diffuse\" \"color L\" [3 3 3] Translate 0.8 0 0.5 "
      "Shape \"sphere\" \"float radius\" 0.3\n";
  for (const double g : {-0.9, 0.0, 0.5}) {
    SCOPED_TRACE(g);
    const std::string fog = fmt::format(
        "Volume \"homogeneous\" {} \"color sigma_s\" [0.4 0.4 0.4] \"float g\" {}\n", kBox, g);
    const Colour single =
        measure(regionScene("\"single\" \"float stepsize\" 0.1", fog + ball, "\"whitted\""));
    const Colour volpath =
        measure(regionScene("", fog + ball, "\"volpath\" \"integer maxdepth\" 0", 300));
    EXPECT_GT(single.mean.y, 0.0005);
    EXPECT_NEAR(single.mean.y, volpath.mean.y,
                kSigmas * std::hypot(single.error.y, volpath.error.y));
  }
}

const std::string kView = "0 0 -5 0 0 0 0 1 0";

// In a white sky, what only scatters cannot be seen: each path brings 1 in the mean, in each
// channel, however often it is scattered.
TEST(Scattering, FurnaceCannotBeSeen) {
  const std::string box = "\"point p0\" [-1 -1 -1] \"point p1\" [1 1 1]";
  const std::string media[] = {
      "\"homogeneous\" \"rgb sigma_s\" [1 4 0.2]",
      "\"homogeneous\" \"rgb sigma_s\" [5 5 5] \"float g\" 0.9",
      "\"homogeneous\" \"rgb sigma_s\" [5 4 6] \"float g\" -0.6",
      "\"uniformgrid\" \"rgb sigma_s\" [2 1 3] \"integer nx\" 2 \"integer nz\" 2 "
      "\"float density\" [0 4 2 0.1] " +
          box,
      "\"uniformgrid\" \"rgb sigma_s\" [2 1 3] \"float density\" 1 " + box,
      "\"cloud\" \"rgb sigma_s\" [3 3 3] " + box,
  };
  for (const std::string& medium : media) {
    SCOPED_TRACE(medium);
    const std::string world =
        "MakeNamedMedium \"m\" \"string type\" " + medium +
        " \"rgb sigma_a\" [0 0 0]\nMediumInterface \"m\" \"\" Material \"interface\" "
        "Shape \"sphere\" MediumInterface \"\" \"\" LightSource \"infinite\"\n";
    const Colour e = measure(
        scene("0.3 0.2 -5 0.3 0.2 0 0 1 0", "\"volpath\" \"integer maxdepth\" 1000000", world, 60));
    expectColour(e, DVec3(1), 1e-4);
    EXPECT_LT(e.error.y, 0.03);
  }
}

// Glass about a medium, a white ball and a bubble in it: nothing of it absorbs.
TEST(Scattering, FurnaceWithSurfaces) {
  const std::string world =
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0 0 0] "
      "\"rgb sigma_s\" [1 2 3] \"float g\" 0.4\n"
      "LightSource \"infinite\"\n"
      "AttributeBegin MediumInterface \"m\" \"\" Material \"glass\" Shape \"sphere\" AttributeEnd\n"
      "AttributeBegin MediumInterface \"m\" \"m\" Material \"matte\" \"rgb Kd\" [1 1 1]\n"
      "Translate 0.2 0.1 0 Shape \"sphere\" \"float radius\" 0.4 AttributeEnd\n"
      "AttributeBegin MediumInterface \"\" \"m\" Material \"\" Translate -0.5 -0.1 0\n"
      "Shape \"sphere\" \"float radius\" 0.3 AttributeEnd\n";
  const Colour e = measure(
      scene("0 0 -5 0.1 0.1 0 0 1 0", "\"volpath\" \"integer maxdepth\" 1000000", world, 60));
  expectColour(e, DVec3(1), 1e-4);
}

// The camera within, and a lamp behind two borders.
TEST(Scattering, BordersDimWhatPassesThem) {
  const std::string media =
      "MakeNamedMedium \"thin\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.1 .1 .1] "
      "\"rgb sigma_s\" [0 0 0]\n"
      "MakeNamedMedium \"thick\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.5 .5 .5] "
      "\"rgb sigma_s\" [0 0 0]\nMediumInterface \"\" \"thin\"\n";
  // A matte wall at z = 2 seen from z = 0, lit from the point (0, 2, 0) through a ball of radius
  // 0.2 about the middle of the way: half of the wall's albedo, by the law of cosines.
  const std::string world =
      "LightSource \"point\" \"point from\" [0 2 0] \"rgb I\" [1 1 1]\n"
      "AttributeBegin MediumInterface \"thin\" \"thin\" Material \"matte\" \"rgb Kd\" [.5 .5 .5] "
      "Translate 0 0 2\n"
      "Shape \"disk\" \"float radius\" 9 AttributeEnd\n"
      "AttributeBegin MediumInterface \"thick\" \"thin\" Material \"\" Translate 0 1 1\n"
      "Shape \"sphere\" \"float radius\" 0.2 AttributeEnd\n";
  const std::string text = "LookAt 0 0 0 0 0 1 0 1 0\n" + media +
                           "Camera \"perspective\" \"float fov\" 0.001\n"
                           "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
                           "PixelFilter \"box\" Sampler \"random\" \"integer pixelsamples\" 1\n"
                           "Integrator \"volpath\" \"integer maxdepth\" 1\nWorldBegin\n" +
                           world + "WorldEnd";
  const double way = std::sqrt(8.0);
  const double irradiance = std::cos(std::numbers::pi / 4) / 8;
  const double dimmed = std::exp(-0.1 * (2 + way - 0.4) - 0.5 * 0.4);
  // The eye's own ray may be absorbed, too: that is a chance, and the mean counts.
  const Colour e = measure(text);
  EXPECT_NEAR(e.mean.y, 0.5 / std::numbers::pi * irradiance * dimmed, kSigmas * e.error.y + 1e-6);
}

const char* const kRoom =
    "LightSource \"point\" \"point from\" [0 0 3] \"rgb I\" [2 3 4]\n"
    "LightSource \"infinite\" \"rgb L\" [.1 .2 .3]\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [4 4 4] Translate 1 2 0\n"
    "Shape \"sphere\" \"float radius\" 0.4 AttributeEnd\n"
    "Material \"plastic\" Shape \"sphere\" Translate 1.5 0 0 Material \"glass\" Shape \"sphere\" "
    "\"float radius\" 0.7 Material \"matte\" Translate 0 -2 0 Rotate 90 1 0 0 Shape \"disk\" "
    "\"float radius\" 9\n";

std::string view(const std::string& integrator, const std::string& world) {
  return "LookAt 1 1 -6 0.5 0 0 0 1 0 Camera \"perspective\" \"float fov\" 50\n"
         "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 24\n"
         "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 4\n"
         "Integrator " +
         integrator + "\nWorldBegin\n" + world + "WorldEnd";
}

TEST(Scattering, WithoutMediaVolpathIsPathBitForBit) {
  for (const char* more :
       {"", "\"integer maxdepth\" 20 \"string lightsamplestrategy\" \"spatial\""})
    EXPECT_EQ(renderText(view(fmt::format("\"path\" {}", more), kRoom)).channels,
              renderText(view(fmt::format("\"volpath\" {}", more), kRoom)).channels);
}

TEST(Scattering, ThreadsDoNotCount) {
  const std::string fog =
      "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" "
      "[1 3] \"point p0\" [-1 -1 -1] \"point p1\" [1 1 1]\n"
      "AttributeBegin Translate 0 1 -2 MediumInterface \"m\" \"\" Material \"\" Shape \"sphere\" "
      "AttributeEnd\n";
  const std::string text = view("\"volpath\"", fog + kRoom);
  EXPECT_EQ(renderText(text, 1).channels, renderText(text, 3).channels);
  EXPECT_NE(renderText(text).channels, renderText(view("\"volpath\"", kRoom)).channels);
}

// A sampler without jitter gives every pixel the same numbers; collisions are drawn anew all the
// same.
TEST(Scattering, PixelsAreIndependentWithoutJitter) {
  const Image image = renderText(
      "LookAt 0 0 -5 0 0 0 0 1 0 Camera \"orthographic\" Film \"image\" \"integer xresolution\" 8\n"
      "\"integer yresolution\" 8 Sampler \"stratified\" \"integer xsamples\" 1 \"integer "
      "ysamples\" 1\n"
      "\"bool jitter\" \"false\" PixelFilter \"box\" SurfaceIntegrator \"volpath\" WorldBegin\n"
      "LightSource \"infinite\" \"color L\" [1 1 1] Volume \"exponential\" \"float b\" 0.1\n"
      "\"color sigma_a\" [.5 .5 .5] \"point p0\" [-2 -2 -1] \"point p1\" [2 2 1] WorldEnd");
  const auto [least, greatest] = std::ranges::minmax(*image.channel("G"));
  EXPECT_LT(least, greatest);
  EXPECT_NEAR(mean(image, "G"), std::exp(-0.82), 0.25);
}

// Regions dim shadow rays, mirrors and indirect light of every integrator of surfaces.
TEST(Scattering, SurfacesAreLitThroughRegions) {
  const std::string fog =
      "Volume \"homogeneous\" \"color sigma_a\" [.2 .2 .2] "
      "\"point p0\" [-9 -9 -9] \"point p1\" [9 9 9]\n";
  const std::string light = "LightSource \"point\" \"point from\" [0 4 0] \"color I\" [1 1 1]\n";
  const std::string wall =
      "Material \"matte\" \"color Kd\" [.5 .5 .5] Translate 0 0 1 Shape \"disk\" "
      "\"float radius\" 50\n";
  const double way = std::sqrt(17.0);
  const double lit = 0.5 / std::numbers::pi / (17 * way) * std::exp(-0.2 * (way + 6));
  for (const char* surface : {"whitted", "directlighting", "path", "volpath"}) {
    SCOPED_TRACE(surface);
    const std::string name = fmt::format("\"{}\"", surface);
    const Colour seen = measure(regionScene("", fog + light + wall, name));
    EXPECT_NEAR(seen.mean.y, lit, kSigmas * seen.error.y + 1e-5 * lit);
  }
  // A mirror at z = 1 that looks back over the camera's shoulder: twice through the fog.
  const std::string mirror =
      "Material \"mirror\" \"color Kr\" [1 1 1] Translate 0 0 1 Shape \"disk\" "
      "\"float radius\" 50\n";
  for (const char* surface : {"whitted", "directlighting", "path", "volpath"}) {
    SCOPED_TRACE(surface);
    const Colour seen =
        measure(regionScene("", "LightSource \"infinite\" \"color L\" [1 1 1]\n" + fog + mirror,
                            fmt::format("\"{}\" \"integer maxdepth\" 4", surface)));
    EXPECT_NEAR(seen.mean.y, std::exp(-0.2 * 16), kSigmas * seen.error.y + 2e-5);
  }
}

// pbrt-v3's shapes without a material may shine, and let light pass. A wall that is 2 away from a
// disk of radius 1, on its axis, receives pi L / 5 of it, and what a lamp behind it sends.
TEST(Scattering, SurfacesWithoutMaterialShine) {
  const std::string world =
      "LightSource \"point\" \"point from\" [0 0 -3] \"rgb I\" [50 50 50]\n"
      "AttributeBegin Material \"matte\" \"rgb Kd\" [.5 .5 .5] Translate 0 0 2 "
      "Shape \"disk\" \"float radius\" 9 AttributeEnd\n"
      "AttributeBegin Material \"\" AreaLightSource \"diffuse\" \"rgb L\" [3 3 3] "
      "Shape \"disk\" AttributeEnd\n";
  const double lamp = 0.5 / std::numbers::pi * 50 / 25, disk = 0.5 * 3 / 5;
  for (const bool media : {true, false}) {
    std::string said;
    BuildOptions options;
    options.report = [&](const Diagnostic& d) { said += d.message; };
    const std::string integrator = media ? "\"volpath\" \"integer maxdepth\" 1" : "\"path\"";
    const Colour seen = measure(scene(kView, integrator, world, 100), options);
    EXPECT_NEAR(seen.mean.y, lamp + (media ? disk : 0), kSigmas * seen.error.y + 1e-5);
    EXPECT_EQ(said.empty(), media) << said;
  }
  // From the other side, before a sky of 1.
  const Colour seen = measure(scene("0 0 5 0 0 0 0 1 0", "\"volpath\"",
                                    "LightSource \"infinite\" Material \"none\" AreaLightSource "
                                    "\"diffuse\" \"rgb L\" [3 3 3] Shape \"disk\"",
                                    8));
  EXPECT_NEAR(seen.mean.y, 4, 1e-5);
}

}  // namespace
}  // namespace pbrt
