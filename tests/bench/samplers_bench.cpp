// What a camera sample costs: its numbers, the ray, and the filter that weighs it.

#include <benchmark/benchmark.h>

#include "tests/support.h"

namespace pbrt {
namespace {

std::unique_ptr<Sampler> sampler(const std::string& name) {
  Sampler::Setup setup;
  setup.samplesPerPixel = 16;
  return test::make<Sampler>(name, {}, setup);
}

// The numbers of a path's first vertex: place in the pixel, one 1D and one 2D dimension.
void startOfPath(benchmark::State& state, const std::string& name) {
  const auto s = sampler(name);
  int x = 0;
  for (auto _ : state) {
    s->start({x & 255, x >> 12}, static_cast<std::uint32_t>(x >> 8 & 15));
    ++x;
    benchmark::DoNotOptimize(s->pixel2D());
    benchmark::DoNotOptimize(s->get1D());
    benchmark::DoNotOptimize(s->get2D());
  }
}

// One two-dimensional number among the first sixteen of a sample.
void twoDimensions(benchmark::State& state, const std::string& name) {
  const auto s = sampler(name);
  int x = 0;
  for (auto _ : state) {
    s->start({x & 255, x >> 12}, static_cast<std::uint32_t>(x >> 8 & 15));
    ++x;
    for (int d = 0; d < 16; ++d) benchmark::DoNotOptimize(s->get2D());
  }
  state.SetItemsProcessed(16 * state.iterations());
}

void lightSamples(benchmark::State& state, const std::string& name) {
  const auto s = sampler(name);
  std::array<Point2, 16> points;
  std::uint32_t index = 0;
  for (auto _ : state) {
    s->start({3, 4}, index++ & 15U);
    s->get2D(points);
    benchmark::DoNotOptimize(points);
  }
  state.SetItemsProcessed(16 * state.iterations());
}

void construction(benchmark::State& state, const std::string& name) {
  for (auto _ : state) benchmark::DoNotOptimize(sampler(name));
}

void cameraRay(benchmark::State& state, const std::string& name, float lens, bool differentials) {
  const auto camera = test::make<Camera>(name, {test::number("lensradius", lens)},
                                         {Transform::rotate(30, {1, 2, 3}), {640, 480}});
  CameraSample sample{{0.5F, 0.5F}, {0.25F, 0.75F}, 0.5F};
  for (auto _ : state) {
    sample.film.x += 0.001F;
    benchmark::DoNotOptimize(camera->generate(sample, differentials));
  }
}

const bool registered = [] {
  for (const std::string& name : test::loader().available(PluginKind::sampler)) {
    benchmark::RegisterBenchmark(("start_of_path/" + name).c_str(), startOfPath, name);
    benchmark::RegisterBenchmark(("get2D/" + name).c_str(), twoDimensions, name);
    benchmark::RegisterBenchmark(("light_samples/" + name).c_str(), lightSamples, name);
    benchmark::RegisterBenchmark(("construction/" + name).c_str(), construction, name)
        ->Unit(benchmark::kMillisecond);
  }
  for (const std::string& name : test::loader().available(PluginKind::camera)) {
    benchmark::RegisterBenchmark((name + "/pinhole").c_str(), cameraRay, name, 0.F, false);
    benchmark::RegisterBenchmark((name + "/lens").c_str(), cameraRay, name, 0.1F, false);
    benchmark::RegisterBenchmark((name + "/differentials").c_str(), cameraRay, name, 0.F, true);
  }
  return true;
}();

}  // namespace
}  // namespace pbrt
