#pragma once
// Directives in, scene out.

#include <array>
#include <filesystem>
#include <optional>

#include "core/plugin/loader.h"
#include "core/scene/dialect.h"
#include "core/scene/scene.h"

namespace pbrt {

// What the command line may say about a scene.
struct BuildOptions {
  std::optional<Dialect> dialect;
  std::optional<std::uint64_t> seed;  // else the scene's own, or 0
  std::optional<int> samplesPerPixel;
  int threads = 0;                                 // for building; 0 is all
  std::optional<std::array<float, 4>> cropWindow;  // x0 x1 y0 y1 in [0, 1]
  std::optional<std::array<int, 4>> pixelBounds;   // x0 x1 y0 y1 in pixels
  bool quick = false;        // a quarter of the resolution each way and of the samples
  std::optional<int> width;  // in pixels instead of the scene's; the height follows
  // Of an animation: when the frame begins, in the scene's time. The shutter's times count from
  // there, and what does not move while it is open, lights for one, stands where it then is.
  std::optional<double> time;
  AovSet aovs = 0;  // what the film stores beside what the scene asks for
  // Report errors of the scene and go on: what is wrong is left out, or something that can be seen
  // stands for it.
  bool permissive = false;
  // Where the files that a scene names are looked for after the folder of the file that names them.
  std::filesystem::path folder;
  Reporter report;
};

class SceneBuilder;

// Builds a scene from directives while they come, e.g. from a Parser: nobody needs to hold all of
// them. Only as long as it is open which generation they are written for, they wait here.
class SceneReader {
 public:
  // The Sources into which the locations point must outlive the scene's construction, and calls of
  // Scene::makeSampler().
  SceneReader(PluginLoader& loader, BuildOptions options);
  ~SceneReader();
  SceneReader(const SceneReader&) = delete;
  SceneReader& operator=(const SceneReader&) = delete;

  // Uses up one directive. Throws Error.
  void read(Directive&& d);
  // After the last. Throws Error.
  std::unique_ptr<Scene> finish();
  // Known at the end.
  const DetectedDialect& dialect() const { return dialect_; }

 private:
  void begin();

  PluginLoader& loader_;
  BuildOptions options_;
  DialectDetector detector_;
  DetectedDialect dialect_;
  std::vector<Directive> waiting_;
  std::unique_ptr<SceneBuilder> builder_;  // once the generation is known
};

// The same with all directives at hand.
std::unique_ptr<Scene> buildScene(std::vector<Directive> directives, PluginLoader& loader,
                                  const BuildOptions& options);

}  // namespace pbrt
