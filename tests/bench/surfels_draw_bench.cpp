// What it costs to draw surfels: discs that cover one ball or many, as seen by a pinhole camera at
// 512 x 512 in blocks of 32 x 32, on one thread. Counters: nanoseconds a disc, and a pixel in which
// one is seen.

#include <benchmark/benchmark.h>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/warp.h"
#include "shapes/metaballs/surfels/draw.h"

namespace pbrt::surfels {
namespace {

constexpr int kSize = 512, kBlock = 32;

// The bits of x, two zeros after each.
std::uint64_t spread(std::uint64_t x) {
  std::uint64_t all = 0;
  for (int i = 0; i < 21; ++i) all |= (x >> i & 1) << (3 * i);
  return all;
}

// `balls` balls in a cube about the origin with n discs on all, neighbours near each other. Discs
// have the radius with which a hexagonal lattice covers the balls, and a third more.
std::vector<Surfel> surfels(std::size_t n, std::size_t balls) {
  Rng rng(3);
  std::vector<Surfel> all(n);
  const std::size_t share = n / balls;
  const double size = balls == 1 ? 1 : 1.1 / std::cbrt(static_cast<double>(balls));
  for (std::size_t ball = 0, i = 0; ball < balls; ++ball) {
    const Point3 centre =
        balls == 1 ? Point3(0)
                   : 2.F * Point3(rng.uniform(), rng.uniform(), rng.uniform()) - Point3(1);
    for (std::size_t k = 0; k < share; ++k, ++i) {
      const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(share);
      const double phi = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5));
      const double rho = std::sqrt(1 - z * z);
      const DVec3 m{rho * std::cos(phi), rho * std::sin(phi), z};
      Surfel& s = all[i];
      s.p = DPoint3(centre) + size * m;
      s.n = Normal3(m);
      s.radius = static_cast<float>(
          4.0 / 3 * size *
          std::sqrt(8 * std::numbers::pi / (3 * std::sqrt(3) * static_cast<double>(share))));
      const glm::dmat3 b = (glm::dmat3(1) - glm::outerProduct(m, m)) / size;
      const double bend[] = {b[0][0], b[1][1], b[2][2], b[0][1], b[0][2], b[1][2]};
      std::copy_n(bend, 6, s.bend);
    }
  }
  const auto code = [](const Surfel& s) {
    const auto cell = [](double x) { return spread(static_cast<std::uint64_t>((x + 4) * 64)); };
    return cell(s.p.x) | cell(s.p.y) << 1 | cell(s.p.z) << 2;
  };
  std::sort(all.begin(), all.end(),
            [&](const Surfel& a, const Surfel& b) { return code(a) < code(b); });
  return all;
}

std::vector<Beam> beams() {
  std::vector<Beam> all;
  for (int top = 0; top < kSize; top += kBlock)
    for (int left = 0; left < kSize; left += kBlock) {
      std::vector<Ray> rays;
      for (int i = 0; i < kBlock * kBlock; ++i) {
        const float x = 2 * (static_cast<float>(left + i % kBlock) + 0.5F) / kSize - 1,
                    y = 1 - 2 * (static_cast<float>(top + i / kBlock) + 0.5F) / kSize;
        rays.push_back({{0, 0, 4}, 0, {0.3F * x, 0.3F * y, -1}});
      }
      all.emplace_back(rays, kBlock);
    }
  return all;
}

void set(benchmark::State& state) {
  const ThreadLimit one(1);
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<Surfel> all = surfels(n, 1);
  Discs discs;
  for (auto _ : state) discs.set(all, {});
  state.counters["ns/disc"] = benchmark::Counter(
      static_cast<double>(n) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(set)->Arg(1 << 14)->Arg(1 << 20)->Unit(benchmark::kMillisecond);

void draw(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Discs discs(surfels(n, static_cast<std::size_t>(state.range(1))), {});
  const std::vector<Beam> all = beams();
  std::vector<Fragment> seen(kBlock * kBlock);
  std::size_t hits = 0;
  for (auto _ : state)
    for (const Beam& beam : all) {
      discs.draw(beam, seen);
      for (const Fragment& f : seen) hits += f.t < kInfinity;
    }
  const auto rate = [](double count, auto flags) {
    return benchmark::Counter(count * 1e-9, flags | benchmark::Counter::kInvert);
  };
  state.counters["ns/disc"] =
      rate(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["ns/pixel"] = rate(static_cast<double>(hits), benchmark::Counter::kIsRate);
}
BENCHMARK(draw)
    ->ArgNames({"discs", "balls"})
    ->Args({1 << 12, 1})
    ->Args({1 << 14, 1})
    ->Args({1 << 14, 64})
    ->Args({1 << 17, 1})
    ->Args({1 << 20, 1})
    ->Unit(benchmark::kMillisecond);

void makeBeams(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(beams());
}
BENCHMARK(makeBeams)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pbrt::surfels
