// What features cost the render loop: nothing where a scene only names them, or the renderer only
// has them; beside it, what they cost where they are used.

#include <benchmark/benchmark.h>

#include "core/base/parallel.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

// A scene in parts: the film's parameters, statements before the world and in it.
struct Features {
  const char* name;
  std::string film, options, world;
  std::string shape = "Shape \"sphere\"\n";  // one of five
};

std::string text(const Features& f) {
  std::string scene =
      "LookAt 0 4 12  0 0 0  0 1 0\nSampler \"random\" \"integer pixelsamples\" 4\n"
      "Film \"image\" \"integer xresolution\" 256 \"integer yresolution\" 256 " +
      f.film + "\nIntegrator \"directlighting\" Camera \"perspective\" \"float fov\" 30\n" +
      f.options +
      "WorldBegin\nLightSource \"point\" \"point from\" [3 8 5] \"rgb I\" [90 90 90]\n" + f.world +
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
      "[-9 -1 9  9 -1 9  9 -1 -9  -9 -1 -9]\n";
  for (const char* place : {"0 0 0", "-2 0 0", "2 0 0", "0 0 2", "0 0 -2"})
    scene += std::string("AttributeBegin Translate ") + place + "\n" + f.shape + "AttributeEnd\n";
  return scene + "WorldEnd\n";
}

void render(benchmark::State& state, const Features& features) {
  const auto scene = test::buildText(text(features), {.dialect = Dialect::v3, .threads = 1});
  std::uint64_t rays = 0;
  RenderControl control;
  control.threads = 1;
  control.endSample = 4;
  for (auto _ : state) {
    scene->integrator().render(*scene, scene->sampler(), scene->film(), control);
    rays = control.rays.exchange(0);
  }
  state.counters["rays"] = static_cast<double>(rays);
  state.counters["ns/ray"] = benchmark::Counter(
      1e-9 * static_cast<double>(rays),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const std::string kMoving =
    "ActiveTransform EndTime Translate .2 0 0 ActiveTransform All Shape \"sphere\"\n";
const std::string kChecks =
    "Texture \"checks\" \"color\" \"checkerboard\" Texture \"holes\" \"float\" \"checkerboard\" "
    "\"float tex1\" 1 \"float tex2\" 0\n";

const std::vector<Features> kFeatures = {
    {"plain"},
    // Named, and not used.
    {"unused/textures and materials", "", "",
     kChecks + "MakeNamedMaterial \"m\" \"string type\" \"matte\" \"texture Kd\" \"checks\"\n"},
    {"unused/media", "", "", "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"},
    {"unused/moving object", "", "", "ObjectBegin \"o\" " + kMoving + "ObjectEnd\n"},
    {"unused/area light", "", "",
     "ObjectBegin \"o\" AreaLightSource \"diffuse\" Shape \"disk\" ObjectEnd\n"},
    // Used.
    {"used/motion", "", "", "", kMoving},
    {"used/instances", "", "", "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd\n",
     "ObjectInstance \"o\"\n"},
    {"used/texture that filters", "", "",
     kChecks + "Material \"matte\" \"texture Kd\" \"checks\"\n"},
    {"used/holes", "", "", kChecks, "Shape \"sphere\" \"texture alpha\" \"holes\"\n"},
    {"used/lens", "",
     "Camera \"perspective\" \"float fov\" 30 \"float lensradius\" .1 "
     "\"float focaldistance\" 12\n"},
    {"used/stored variance", "\"string aov\" \"variance\""},
    {"used/stored depth and normal", "\"string aov\" [\"depth\" \"normal\"]"},
    {"used/fog", "", "",
     "Volume \"homogeneous\" \"point p0\" [-9 -1 -9] \"point p1\" [9 3 9] "
     "\"rgb sigma_s\" [.01 .01 .01]\n"},
    {"used/second light", "", "", "LightSource \"point\" \"point from\" [-3 8 5]\n"},
};

}  // namespace
}  // namespace pbrt

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  for (const pbrt::Features& features : pbrt::kFeatures)
    benchmark::RegisterBenchmark(features.name, [&](auto& state) { render(state, features); })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime();
  benchmark::RunSpecifiedBenchmarks();
}
