#pragma once
// Scenes from text, and their pictures.

#include "core/parse/parse.h"
#include "core/scene/builder.h"
#include "core/scene/render.h"
#include "tests/support.h"

namespace pbrt::test {

inline std::unique_ptr<Scene> buildText(const std::string& text, BuildOptions options = {},
                                        PluginLoader& plugins = loader()) {
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.text("test", text);
  return buildScene(std::move(directives), plugins, options);
}

inline std::unique_ptr<Scene> buildFile(const std::filesystem::path& file,
                                        BuildOptions options = {}) {
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.file(file);
  return buildScene(std::move(directives), loader(), options);
}

// Renders samples [first, end) of every pixel into the scene's film; all that the scene asks for if
// end is 0.
inline Image renderScene(Scene& scene, int threads = 0, std::uint32_t first = 0,
                         std::uint32_t end = 0) {
  RenderControl control;
  control.threads = threads;
  control.firstSample = first;
  control.endSample = end ? end : static_cast<std::uint32_t>(scene.sampler().samplesPerPixel());
  scene.integrator().render(scene, scene.sampler(), scene.film(), control);
  EXPECT_EQ(describe(control.faults), "");
  return scene.film().image();
}

inline Image renderText(const std::string& text, int threads = 0, BuildOptions options = {}) {
  return renderScene(*buildText(text, std::move(options)), threads);
}

// The mean of a channel over the whole picture.
inline double mean(const Image& image, const char* channel) {
  double sum = 0;
  for (const float v : *image.channel(channel)) sum += v;
  return sum / static_cast<double>(image.channel(channel)->size());
}

}  // namespace pbrt::test
