// What the field of moving atoms costs: to set it up for a frame, and a point on its surface.

#include <benchmark/benchmark.h>

#include <numeric>

#include "shapes/metaballs/surfels/atom_field.h"
#include "shapes/metaballs/surfels/coverage.h"
#include "tests/shapes/metaballs/sets.h"

namespace pbrt::surfels {
namespace {

using metaballs::Kernel;

constexpr std::size_t kPoints = 16384;

std::vector<Vec3> someVelocities(std::size_t count) {
  metaballs::test::Random random(5);
  std::vector<Vec3> v(count);
  for (Vec3& one : v) one = Vec3(random.cube());
  return v;
}

// A deep box of jittered atoms; the kernel's supports are two of their distances.
struct Water {
  metaballs::Field fluid;
  std::vector<Vec3> velocities;
  AtomField field;

  Water(Kernel kernel, std::size_t count, HashKind hash = HashKind::traditional)
      : fluid(metaballs::test::fluid(
            kernel, static_cast<int>(std::cbrt(static_cast<double>(count)) + 0.5), 0.25,
            static_cast<int>(std::cbrt(static_cast<double>(count)) + 0.5))),
        velocities(someVelocities(fluid.atoms().size())),
        field(hash) {
    set();
  }
  void set() { field.set(fluid.kernel(), fluid.atoms(), velocities); }
};

// In the order of small cells, as a simulation keeps its surfels.
std::vector<DPoint3> pointsOn(const AtomField& field) {
  std::vector<DPoint3> points;
  for (const Place& place : places(field, 0, 2 * kPoints))
    if (points.size() < kPoints) points.push_back(place.p);
  if (points.size() < kPoints) std::abort();
  const auto cell = [](const DPoint3& p) {
    const DVec3 c = glm::floor(p * 2.0);
    return std::tuple(c.z, c.y, c.x);
  };
  std::ranges::sort(points, {}, cell);
  return points;
}

void set(benchmark::State& state) {
  Water water(Kernel::poly6, static_cast<std::size_t>(state.range(0)),
              static_cast<HashKind>(state.range(1)));
  for (auto _ : state) water.set();
}
// The second argument: 0 the traditional hash, 1 the inverted one.
BENCHMARK(set)
    ->ArgsProduct({{1000, 1500, 10000, 100000}, {0, 1}})
    ->Args({1000000, 0})
    ->Unit(benchmark::kMillisecond);

// Its hash alone.
void build(benchmark::State& state) {
  const Water water(Kernel::poly6, static_cast<std::size_t>(state.range(0)));
  std::vector<std::uint32_t> numbers(water.fluid.atoms().size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  AtomHash hash;
  for (auto _ : state)
    hash.build(water.fluid.atoms(), numbers, 2, static_cast<HashKind>(state.range(1)));
}
BENCHMARK(build)
    ->ArgsProduct({{1000, 1500, 10000, 100000}, {0, 1}})
    ->Args({1000000, 0})
    ->Unit(benchmark::kMillisecond);

void at(benchmark::State& state) {
  const Water water(static_cast<Kernel>(state.range(1)), static_cast<std::size_t>(state.range(0)),
                    static_cast<HashKind>(state.range(2)));
  const std::vector<DPoint3> points = pointsOn(water.field);
  std::vector<FieldAt> out(kPoints);
  for (auto _ : state) water.field.at(points, out);
  state.SetItemsProcessed(state.iterations() * kPoints);
}
// Arguments: atoms, kernel, hash.
BENCHMARK(at)
    ->ArgsProduct({{1500}, {0, 1, 2, 3}, {0, 1}})
    ->Args({100000, 0, 0})
    ->Args({100000, 0, 1})
    ->Unit(benchmark::kMillisecond);

void shape(benchmark::State& state) {
  const Water water(Kernel::poly6, static_cast<std::size_t>(state.range(0)));
  const std::vector<DPoint3> points = pointsOn(water.field);
  std::vector<ShapeAt> out(kPoints);
  for (auto _ : state) water.field.shape(points, out);
  state.SetItemsProcessed(state.iterations() * kPoints);
}
BENCHMARK(shape)->Arg(1500)->Unit(benchmark::kMillisecond);

void seeds(benchmark::State& state) {
  const Water water(Kernel::poly6, static_cast<std::size_t>(state.range(0)));
  std::vector<DPoint3> points(256);
  std::uint64_t first = 0;
  for (auto _ : state) {
    water.field.seeds(first, points);
    first += points.size();
  }
  state.SetItemsProcessed(state.iterations() * 256);
}
BENCHMARK(seeds)->Arg(1500)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pbrt::surfels
