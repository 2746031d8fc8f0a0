// How surfels grow: with their number, with the fluid, and in how many frames they cover what is
// new. Fluids are those of metaballs_view.h: jittered grids of atoms. CPU milliseconds a frame, all
// threads together; the least of a few frames, as what disturbs a frame only adds.
//
//   surfels_scale [most surfels (1048576)] [most atoms (1000000)]

#include <fmt/format.h>

#include <cstdlib>

#include "tests/bench/measure.h"
#include "tests/bench/ways.h"
#include "tests/shapes/metaballs/surfels/uniform_places.h"

namespace pbrt::bench {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr int kPixels = 512, kMostFrames = 200;
constexpr std::size_t kPlaces = 4000;

// On a disc and no farther from a surfel than about its neighbours are.
double covered(const surfels::Simulation& simulation, std::span<const surfels::Place> places) {
  const surfels::Coverage c =
      coverage(simulation.surfels(), places, 0.5 * simulation.report().reach);
  return std::min(c.covered, c.near);
}

struct Moving {
  metaballs::Field still;
  std::vector<metaballs::Atom> atoms;
  surfels::AtomField field;

  explicit Moving(metaballs::Field all) : still(std::move(all)), atoms(still.atoms()) { set(); }
  void set(std::size_t first = 0) {
    field.set(still.kernel(), std::span(atoms).subspan(first), {});
  }
  // Frames as at rest: each finds places anew where the simulation looks for holes.
  void rest(surfels::Simulation& simulation, int frames, std::size_t first = 0) {
    for (int i = 0; i < frames; ++i) {
      set(first);
      simulation.step(field, kFrame);
    }
  }
  std::vector<surfels::Place> places() const {
    return surfels::test::uniformPlaces({still.kernel(), atoms}, kPlaces);
  }
  // Frames until 99 % of the surface are covered.
  int frames(surfels::Simulation& simulation) {
    const auto all = places();
    for (int frame = 1; frame <= kMostFrames; ++frame) {
      rest(simulation, 1);
      if (covered(simulation, all) >= 0.99) return frame;
    }
    return kMostFrames;
  }
};

double drawSeconds(const Moving& fluid, const surfels::Simulation& simulation) {
  const View view(fluid.field.bounds(), kPixels);
  surfels::Discs discs;
  return fastest([&] {
    discs.set(simulation.surfels(), DPoint3(0));
    parallelFor(view.blocks(), [&](std::size_t block) {
      std::array<surfels::Fragment, sqr(View::kBlock)> fragments;
      discs.draw(view.beam(block), fragments);
    });
  });
}

void byCount(std::size_t most) {
  fmt::print(
      "\n1500 atoms, 60 frames at rest, then a start with all surfels on one atom, then half of "
      "the\n"
      "fluid set elsewhere: frames until 99 % are covered\n\n"
      "| surfels | step ms | us a surfel | draw ms | evenness | covered | residual | bad start | "
      "split |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t count = 4096; count <= most; count *= 4) {
    Moving fluid(metaballs::bench::fluid(1500).field);
    surfels::Simulation rest({count});
    fluid.rest(rest, 57);
    const double step = fastest([&] { rest.step(fluid.field, kFrame); });
    const auto& report = rest.report();
    fmt::print("| {} | {:.1f} | {:.2f} | {:.1f} | {:.3f} | {:.3f} % | {:.1e} |", count, 1e3 * step,
               1e6 * step / static_cast<double>(count), 1e3 * drawSeconds(fluid, rest),
               report.evenness, 100 * covered(rest, fluid.places()), report.residual);
    std::fflush(stdout);

    surfels::Simulation bad({count});
    fluid.rest(bad, 20, fluid.atoms.size() - 1);
    fmt::print(" {} |", fluid.frames(bad));
    std::fflush(stdout);

    for (std::size_t i = 0; i < fluid.atoms.size() / 2; ++i) fluid.atoms[i].centre.x += 100;
    fmt::print(" {} |\n", fluid.frames(rest));
    std::fflush(stdout);
  }
}

void byAtoms(double most) {
  fmt::print(
      "\n16,384 surfels\n\n| atoms | field ms | step ms | draw ms | evenness | covered |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (double atoms = 1000; atoms <= most; atoms *= 10) {
    Moving fluid(metaballs::bench::fluid(static_cast<int>(atoms)).field);
    surfels::Simulation rest({});
    const double set = fastest([&] { fluid.set(); });
    fluid.rest(rest, 57);
    const double step = fastest([&] { rest.step(fluid.field, kFrame); });
    fmt::print("| {:.0f} | {:.2f} | {:.1f} | {:.1f} | {:.3f} | {:.2f} % |\n", atoms, 1e3 * set,
               1e3 * step, 1e3 * drawSeconds(fluid, rest), rest.report().evenness,
               100 * covered(rest, fluid.places()));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace pbrt::bench

int main(int count, char** arguments) {
  const double surfels = count > 1 ? std::atof(arguments[1]) : 1 << 20;
  const double atoms = count > 2 ? std::atof(arguments[2]) : 1e6;
  pbrt::bench::byCount(static_cast<std::size_t>(surfels));
  pbrt::bench::byAtoms(atoms);
}
