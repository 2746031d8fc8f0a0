// What a film costs: to add a sample, with filters of several radii;
// and to save and read it, which is how long a render rests for a checkpoint.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "core/base/rng.h"
#include "core/scene/film_file.h"

namespace pbrt {
namespace {

class Bell final : public Filter {
 public:
  explicit Bell(float radius) : Filter(Vec2(radius)) {}
  float evaluate(Vec2 p) const override { return std::exp(-glm::dot(p, p)); }
};

Film filmOf(int width, int height, float radius, AovSet aovs) {
  return {{width, height}, {{0, 0}, {width, height}}, Bell(radius), {.aovs = aovs}};
}

// A sample in each pixel.
void addSamples(Film& film, Rng& rng) {
  for (int tile = 0; tile < film.tiles(); ++tile) {
    const Bounds2i pixels = film.tilePixels(tile);
    for (int y = pixels.lo.y; y < pixels.hi.y; ++y)
      for (int x = pixels.lo.x; x < pixels.hi.x; ++x) {
        const Point2 at = Point2(x, y) + 0.99F * Point2(rng.uniform(), rng.uniform());
        film.add(tile, at, Spectrum(rng.uniform()), 1);
      }
  }
}

void addASample(benchmark::State& state) {
  Film film = filmOf(256, 256, static_cast<float>(state.range(0)) / 10, 0);
  Rng rng(1);
  for (auto _ : state) addSamples(film, rng);
  const Bounds2i& pixels = film.sampledPixels();
  state.counters["ns_a_sample"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * pixels.width() * pixels.height() * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(addASample)->ArgName("tenths_of_radius")->Arg(5)->Arg(10)->Arg(20);

// 1920 x 1080: the picture alone, and all that can be stored.
void save(benchmark::State& state) {
  Film film = filmOf(1920, 1080, 2, static_cast<AovSet>(state.range(0)));
  Rng rng(1);
  addSamples(film, rng);
  const auto file = std::filesystem::temp_directory_path() / "film_bench.film";
  FilmInfo info;
  info.endSample = 1;
  for (auto _ : state) writeFilm(file, film, info);
  state.counters["MiB"] = static_cast<double>(std::filesystem::file_size(file)) / 0x1p20;
  std::filesystem::remove(file);
}
BENCHMARK(save)
    ->ArgName("aovs")
    ->Arg(0)
    ->Arg(kEveryAov)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace pbrt
