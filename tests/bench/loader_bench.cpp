// Time to open a plug-in, and to open all that a small scene names.

#include <benchmark/benchmark.h>

#include "tests/command.h"
#include "tests/support.h"

namespace pbrt {
namespace {

// A plug-in is never closed, and opening the same file again costs next to nothing: each round
// opens a copy of it.
void openOnePlugin(benchmark::State& state) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path() / "shapes");
  for (auto _ : state) {
    state.PauseTiming();
    static int copies = 0;
    const auto place = folder.path() / std::to_string(copies++);
    std::filesystem::create_directories(place / "shapes");
    std::filesystem::copy_file(PBRT_BUILD_DIR "/lib/pbrt/shapes/sphere.so",
                               place / "shapes/sphere.so");
    PluginLoader loader({place});
    state.ResumeTiming();
    benchmark::DoNotOptimize(&loader.open(PluginKind::shape, "sphere"));
  }
}
BENCHMARK(openOnePlugin)->Iterations(200)->Unit(benchmark::kMicrosecond);

// The whole command for a picture of one pixel.
void startToEnd(benchmark::State& state) {
  const test::Folder folder;
  folder.write("scene.pbrt",
               "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
               "Sampler \"random\" \"integer pixelsamples\" 1 Integrator \"whitted\"\nCamera "
               "\"perspective\"\nWorldBegin\nLightSource \"point\"\nShape \"sphere\"\nWorldEnd\n");
  for (auto _ : state)
    if (folder.pbrt("--quiet scene.pbrt").code != 0) state.SkipWithError("pbrt failed");
}
BENCHMARK(startToEnd)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace pbrt
