// Any text is a scene, or is refused with an Error: parsed, built with the plug-ins of this build,
// and a few pixels of it rendered.

#include "core/parse/parse.h"
#include "core/plugin/loader.h"
#include "core/scene/builder.h"
#include "core/scene/render.h"

namespace pbrt {
namespace {

// What may take any time, as the scene asks for it, is no find.
void makeCheap(Directive& d) {
  for (Param& p : d.params)
    if (p.name == "maxdepth" || p.name == "nsamples" || p.name == "samples")
      if (auto* values = std::get_if<std::vector<int>>(&p.values))
        for (int& value : *values) value = std::min(value, 4);
}

void renderPixels(Scene& scene) {
  RenderControl control;
  control.threads = 1;
  scene.integrator().render(scene, scene.sampler(), scene.film(), control);
  scene.film().image();
}

void readScene(const std::string& text) {
  static PluginLoader loader(PluginLoader::searchPath(""));
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) {
    makeCheap(d);
    directives.push_back(std::move(d));
  });
  BuildOptions options;
  options.threads = 1;
  options.samplesPerPixel = 1;
  options.pixelBounds = {0, 4, 0, 4};
  options.report = [](const Diagnostic& warning) { format(warning); };
  try {
    parser.text("fuzz", text);
    renderPixels(*buildScene(std::move(directives), loader, options));
  } catch (const Error& error) {
    for (const Diagnostic& d : error.diagnostics()) format(d);
  }
}

}  // namespace
}  // namespace pbrt

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pbrt::readScene({data, data + size});
  return 0;
}
