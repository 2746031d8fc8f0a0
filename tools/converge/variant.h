#pragma once
// What is compared: scenes, each with statements that take the place of its own.

#include <filesystem>
#include <memory>
#include <string>

#include "core/parse/parse.h"
#include "core/scene/builder.h"

namespace pbrt {

// Statements that change how a scene is rendered, as given on the command line: `label=statements`
// or the statements alone, which then are the label too.
struct Change {
  std::string label, statements;
};
Change readChange(const std::string& text);

// A scene as built from a file and a change.
struct Variant {
  std::string label;       // the scene's name and the change's label, as far as they tell it apart
  std::string name;        // of the file, without its suffix
  std::string statements;  // of the change
  double parseSeconds = 0, buildSeconds = 0;
  std::unique_ptr<Parser> parser;  // keeps the text that the scene's messages quote
  std::unique_ptr<Scene> scene;
};

// Reads and builds. The change may have Integrator, SurfaceIntegrator, Sampler and PixelFilter
// statements; the scene's own dialect holds for them. Throws Error.
Variant buildVariant(const std::filesystem::path& file, const Change& change, PluginLoader& loader,
                     BuildOptions options);

}  // namespace pbrt
