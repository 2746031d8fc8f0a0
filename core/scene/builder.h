#pragma once
// Directives in, scene out.

#include <array>
#include <optional>

#include "core/scene/resources.h"
#include "core/scene/scene.h"

namespace pbrt {

// What the command line may say about a scene.
struct BuildOptions {
  std::optional<Dialect> dialect;
  std::uint64_t seed = 0;
  std::optional<int> samplesPerPixel;
  int threads = 0;                                 // for building; 0 is all
  std::optional<std::array<float, 4>> cropWindow;  // x0 x1 y0 y1 in [0, 1]
  std::optional<std::array<int, 4>> pixelBounds;   // x0 x1 y0 y1 in pixels
  bool quick = false;        // a quarter of the resolution each way and of the samples
  std::optional<int> width;  // in pixels instead of the scene's; the height follows
  std::uint8_t aovs = 0;     // what the film stores beside what the scene asks for
  Reporter report;
};

// Builds the scene that the directives describe. They are used up; the Sources into which their
// locations point must outlive the call, and those of Scene::makeSampler(). Throws Error.
std::unique_ptr<Scene> buildScene(std::vector<Directive> directives, PluginLoader& loader,
                                  const BuildOptions& options);

}  // namespace pbrt
