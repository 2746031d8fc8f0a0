// A slab of a medium, one unit thick, before a sky: Beer's law and what it emits, for every medium
// and every integrator that looks after media.

#include "tests/integrators/media.h"

namespace pbrt {
namespace {

using namespace test;

constexpr double kDepths[] = {1e-6, 1e-3, 1, 30, 1e6};

// Regions between z = 0 and 1 about the z axis, with a total optical depth in green; red has half
// of it and blue twice.
struct Slab {
  std::string name;
  std::string parameters;
  double depth;  // for sigma_a = 1
};
const Slab kSlabs[] = {
    {"homogeneous", "", 1},
    {"exponential", "\"float b\" 3 \"vector updir\" [0 0 1]", (1 - std::exp(-3)) / 3},
    {"exponential", "\"float b\" 0 \"float a\" 2", 2},
    {"volumegrid", "\"integer nz\" 1 \"float density\" [0.7]", 0.7},
    // Zero for half a voxel, a tent over two, zero again.
    {"volumegrid", "\"integer nz\" 3 \"float density\" [0 1 0]", 1 / 3.0},
};

std::string region(const Slab& slab, double depth, const std::string& more = "") {
  const double s = depth / slab.depth;
  return fmt::format(
      "Volume \"{}\" \"point p0\" [-0.1 -0.1 0] \"point p1\" [0.1 0.1 1] {} \"color sigma_a\" [{} "
      "{} {}] "
      "{}\n",
      slab.name, slab.parameters, 0.5 * s, s, 2 * s, more);
}

const std::string kSky = "LightSource \"infinite\" \"color L\" [1 1 1]\n";

DVec3 beer(double depth) {
  return glm::exp(-depth * DVec3(0.5, 1, 2));
}

TEST(Slab, RegionsFollowBeersLawWhoeverLooks) {
  for (const Slab& slab : kSlabs)
    for (const double depth : kDepths)
      for (const char* volume :
           {"\"emission\" \"float stepsize\" 0.02", "\"single\" \"float stepsize\" 0.02", ""}) {
        SCOPED_TRACE(fmt::format("{} {} {} {}", slab.name, slab.parameters, depth, volume));
        const std::string surface = *volume ? "\"whitted\"" : "\"volpath\"";
        expectColour(measure(regionScene(volume, kSky + region(slab, depth), surface, 50)),
                     beer(depth), *volume ? 1e-4 : 2e-5,
                     *volume ? 1e-12 : 1e-6);  // steps; too rare
      }
}

// Two that overlap, and two behind each other.
TEST(Slab, RegionsAddUp) {
  for (const char* volume : {"\"emission\"", "\"single\"", ""})
    expectColour(measure(regionScene(volume,
                                     kSky + region(kSlabs[0], 0.3) + region(kSlabs[3], 0.2) +
                                         "Translate 0 0 0.5\n" + region(kSlabs[0], 0.1) +
                                         "Translate 0 0 2\n" + region(kSlabs[2], 0.4),
                                     *volume ? "\"path\"" : "\"volpath\"")),
                 beer(1.0), 1e-4);
}

// The integral of exp(-sigma t) e over the slab.
TEST(Slab, RegionsGlow) {
  for (const double depth : kDepths)
    for (const char* volume :
         {"\"emission\" \"float stepsize\" 0.1", "\"single\" \"float stepsize\" 0.1", ""}) {
      SCOPED_TRACE(fmt::format("{} {}", depth, volume));
      const DVec3 sigma = depth * DVec3(0.5, 1, 2);
      DVec3 expected;
      for (int c = 0; c < 3; ++c) expected[c] = 0.8 * -std::expm1(-sigma[c]) / sigma[c];
      expectColour(
          measure(regionScene(volume, region(kSlabs[0], depth, "\"color Le\" [0.8 0.8 0.8]"),
                              *volume ? "\"whitted\"" : "\"volpath\"", 200)),
          expected, 1e-4);
    }
}

// Where nothing is absorbed, a grid glows all the same.
TEST(Slab, ClearGridGlows) {
  for (const char* volume : {"\"emission\" \"float stepsize\" 0.02", ""})
    expectColour(
        measure(regionScene(volume,
                            region({"volumegrid", "\"integer nz\" 3 \"float density\" [0 1 0]", 1},
                                   0, "\"color Le\" [6 3 9]"),
                            *volume ? "\"whitted\"" : "\"volpath\"")),
        {2, 1, 3}, 1e-3);
}

// Named media, in a ball of diameter 1 that is seen through its middle.
std::string ball(const std::string& medium) {
  return "MakeNamedMedium \"m\" " + medium +
         "\nAttributeBegin MediumInterface \"m\" \"\" Material \"\"\n"
         "Shape \"sphere\" \"float radius\" 0.5 AttributeEnd\n" +
         kSky;
}
std::string volpath(int maxDepth = 5) {
  return fmt::format("\"volpath\" \"integer maxdepth\" {}", maxDepth);
}
const std::string kView = "0 0 -5 0 0 0 0 1 0";

TEST(Slab, NamedMediaFollowBeersLaw) {
  const std::string box = "\"point p0\" [-0.5 -0.5 -0.5] \"point p1\" [0.5 0.5 0.5]";
  // Voxels fade out half a voxel outside of the box: at its border half is left.
  const std::tuple<std::string, double, const char*> media[] = {
      {"\"homogeneous\"", 1, "homogeneous"},
      {"\"heterogeneous\" \"integer nz\" 1 \"float density\" 2 " + box, 1.5, "heterogeneous"},
      {"\"uniformgrid\" \"integer nz\" 4 \"float density\" [1 1 1 1] " + box, 0.9375,
       "uniformgrid"},
  };
  for (const auto& [type, unit, name] : media)
    for (const double depth : kDepths) {
      SCOPED_TRACE(fmt::format("{} {}", name, depth));
      if (depth > 1e5 && unit != 1) continue;  // see SteepDensities
      const double s = depth / unit;
      const std::string sigma =
          fmt::format("\"string type\" {} \"rgb sigma_a\" [{} {} {}] \"rgb sigma_s\" [0 0 0]", type,
                      0.5 * s, s, 2 * s);
      expectColour(measure(scene(kView, volpath(), ball(sigma), 50)), beer(depth));
    }
}

TEST(Slab, NamedMediaGlowLikeBlackBodies) {
  for (const double depth : kDepths) {
    SCOPED_TRACE(depth);
    const std::string medium = fmt::format(
        "\"string type\" \"homogeneous\" \"rgb sigma_a\" [{} {} {}] \"rgb sigma_s\" [0 0 0] "
        "\"rgb Le\" [2 2 2] \"float Lescale\" 1.5",
        0.5 * depth, depth, 2 * depth);
    expectColour(measure(scene(kView, volpath(), ball(medium), 200)),
                 3.0 * (1.0 - beer(depth)) + beer(depth), 1e-4);
  }
}

// A voxel ten thousand times as thick as what is about it, in the same cells as the ray.
TEST(Slab, SteepDensities) {
  const std::string grid =
      "Volume \"volumegrid\" \"point p0\" [0 -1 0] \"point p1\" [2 1 1] \"integer nx\" 2 "
      "\"integer nz\" 2 \"float density\" [1 10000 1 10000] \"color sigma_a\" [1 1 1]\n";
  // At x = 0.52 the density is 1 + 0.02 * 9999.
  const double density = 1 + 0.02 * 9999;
  const std::string world = kSky + "Scale 1 1 0.01\n" + grid;
  expectColour(measure(regionScene("", world, "\"volpath\"", 60, "0.52 0 -5 0.52 0 0 0 1 0")),
               DVec3(std::exp(-0.01 * density)), 1e-4);
  // And one that is opaque but for its border.
  expectColour(measure(regionScene("", world, "\"volpath\"", 60, "1.9 0 -5 1.9 0 0 0 1 0")),
               DVec3(0));
}

}  // namespace
}  // namespace pbrt
