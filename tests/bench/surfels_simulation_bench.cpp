// What a step costs by the number of surfels on a fluid of 1,500 atoms at rest, and its stages.

#include <benchmark/benchmark.h>

#include "shapes/metaballs/surfels/atom_field.h"
#include "shapes/metaballs/surfels/landing.h"
#include "shapes/metaballs/surfels/repulsion.h"
#include "tests/bench/metaballs_view.h"

namespace pbrt::surfels {
namespace {

// A cover that has had a few steps.
struct Cover {
  metaballs::bench::Set fluid = metaballs::bench::fluid(1500);
  AtomField field;
  Simulation simulation;
  std::vector<Surfel> surfels;

  explicit Cover(std::size_t count) : simulation({.count = count}) {
    field.set(fluid.field.kernel(), fluid.field.atoms(), {});
    for (int i = 0; i < 8; ++i) simulation.step(field, 0);
    surfels.assign(simulation.surfels().begin(), simulation.surfels().end());
  }
};

// Times are of all threads together.
template <class Stage>
void measure(benchmark::State& state, Stage&& stage) {
  Cover cover(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) stage(cover);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void step(benchmark::State& state) {
  measure(state, [](Cover& c) { c.simulation.step(c.field, 0); });
}
void look(benchmark::State& state) {
  measure(state, [](Cover& c) {
    std::vector<Landing> landings(c.surfels.size());
    for (std::size_t i = 0; i < landings.size(); ++i) landings[i].p = c.surfels[i].p;
    land(c.field, landings);
  });
}
void shape(benchmark::State& state) {
  measure(state, [](Cover& c) {
    std::vector<DPoint3> places;
    for (const Surfel& s : c.surfels) places.push_back(s.p);
    std::vector<ShapeAt> shapes(places.size());
    c.field.shape(places, shapes);
  });
}
void seeds(benchmark::State& state) {
  measure(state, [](Cover& c) {
    std::vector<DPoint3> places(c.surfels.size());
    c.field.seeds(0, places);
  });
}
std::vector<float> crowding(const Cover& c) {
  return std::vector<float>(c.surfels.size(), 15);
}
void neighbours(benchmark::State& state) {
  Neighbours grid;
  measure(state, [&](Cover& c) {
    grid.sort(c.surfels, c.simulation.report().reach);
    grid.store(c.surfels, crowding(c));
  });
}
void repulsion(benchmark::State& state) {
  Neighbours grid;
  std::vector<Repulsion> all;
  measure(state, [&](Cover& c) {
    if (all.empty()) {
      std::vector<Surfel> sorted;
      for (const std::uint32_t i : grid.sort(c.surfels, c.simulation.report().reach))
        sorted.push_back(c.surfels[i]);
      grid.store(sorted, crowding(c));
      all.resize(sorted.size());
    }
    repel(grid.view(), grid.cells(), all.data());
  });
}

BENCHMARK(step)->Arg(4096)->Arg(16384)->Arg(65536)->Arg(1 << 20)->MeasureProcessCPUTime();
BENCHMARK(look)->Arg(16384)->MeasureProcessCPUTime();
BENCHMARK(shape)->Arg(16384)->MeasureProcessCPUTime();
BENCHMARK(seeds)->Arg(16384)->MeasureProcessCPUTime();
BENCHMARK(neighbours)->Arg(16384)->Arg(1 << 20)->MeasureProcessCPUTime();
BENCHMARK(repulsion)->Arg(16384)->Arg(1 << 20)->MeasureProcessCPUTime();

}  // namespace
}  // namespace pbrt::surfels
