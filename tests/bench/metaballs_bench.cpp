// How fast rays meet metaballs: through the ray tree and the plug-in's shape, one ray at a time.
// Counters: rays per second, cells, and per ray the looks at the field in float and in double, over
// all cells whose box the ray meets up to its first crossing.

#include <benchmark/benchmark.h>

#include "core/base/rng.h"
#include "core/scene/accel.h"
#include "tests/bench/cell_shape.h"

namespace pbrt::metaballs {
namespace {

// `count` atoms of radius 1 in a ball, about 12 supports over every interior point; f = 0 is where
// a lone atom's field of the wyvill kernel falls to a half.
Field ballOfAtoms(int count, Kernel kernel) {
  Rng rng(7);
  std::vector<Atom> atoms;
  const float extent = std::cbrt(static_cast<float>(count) / 12);
  while (std::ssize(atoms) < count) {
    const Vec3 p = 2.F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.F;
    if (lengthSquared(p) > 1) continue;
    atoms.push_back({extent * p, 1, scale(kernel, 1) / (kernel == Kernel::poly6 ? 0.78 : 0.5)});
  }
  return {kernel, atoms};
}

// Rays from all around towards points of the ball that the atoms fill.
std::vector<Ray> someRays(float extent) {
  Rng rng(11);
  std::vector<Ray> rays;
  const auto inBall = [&rng] {
    Vec3 p;
    do p = 2.F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.F;
    while (lengthSquared(p) > 1);
    return p;
  };
  for (int i = 0; i < 1 << 14; ++i) {
    const Point3 from = 4 * extent * glm::normalize(inBall()), to = extent * inBall();
    rays.push_back({from, 0, glm::normalize(to - from)});
  }
  return rays;
}

template <bool Occlusion>
void trace(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const Field field = ballOfAtoms(count, static_cast<Kernel>(state.range(1)));
  Effort effort;
  const bench::CellShape shape(field, &effort);
  const AccelDevice device(1);
  Accel tree(device);
  tree.add(shape, Transform());
  tree.build();
  const std::vector<Ray> rays = someRays(1 + std::cbrt(static_cast<float>(count) / 12));
  std::size_t i = 0, hits = 0;
  for (auto _ : state) {
    const Ray& ray = rays[i++ % rays.size()];
    hits += Occlusion ? tree.occluded(ray) : tree.intersect(ray).found();
  }
  const auto perRay = [&](std::size_t n) {
    return benchmark::Counter(static_cast<double>(n), benchmark::Counter::kAvgIterations);
  };
  state.counters["rays"] = benchmark::Counter(static_cast<double>(i), benchmark::Counter::kIsRate);
  state.counters["hits"] = perRay(hits);
  state.counters["cells"] = shape.primitives();
  state.counters["atoms/cell"] = shape.atomsPerCell();
  if (!Occlusion) {
    state.counters["looks in float"] = perRay(effort.floats);
    state.counters["in double"] = perRay(effort.doubles);
  }
}

void build(benchmark::State& state) {
  const Field field = ballOfAtoms(static_cast<int>(state.range(0)), Kernel::poly6);
  for (auto _ : state) benchmark::DoNotOptimize(Cells(field).cells().size());
}

BENCHMARK(trace<false>)->Name("first")->ArgsProduct({{1, 12, 300}, {0, 2, 3}});
BENCHMARK(trace<true>)->Name("any")->ArgsProduct({{12, 300}, {0}});
BENCHMARK(build)->Arg(12)->Arg(300)->Arg(3000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pbrt::metaballs
