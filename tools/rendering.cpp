#include "rendering.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/scene/render.h"
#include "progress.h"
#include "reading.h"
#include "stats.h"

namespace pbrt {

namespace {

// The picture after so many samples per pixel and seconds.
void writePictures(const Options& o, Scene& scene, const Goal& goal, std::uint32_t samples,
                   double seconds, const std::vector<std::string>& outputs) {
  const AovSet notStored = o.build.aovs & ~o.aovSet;  // wanted only for the goal
  Image image = scene.film().image(~notStored);
  image.attributes = scene.attributes();
  image.attributes["firstSample"] = static_cast<int>(goal.firstSample);
  image.attributes["samplesPerPixel"] = static_cast<int>(samples);
  image.attributes["filterNoise"] = static_cast<float>(scene.film().filterNoise());
  image.attributes["renderTimeSeconds"] = seconds;
  image.attributes["seed"] = std::to_string(scene.seed());
  image.attributes["scene"] = fmt::format("{}", fmt::join(o.files, " "));
  image.attributes["software"] = std::string("pbrt " PBRT_VERSION);
  for (const std::string& output : outputs) writeImage(output, image);
}

// Renders until the goal is reached. Returns the samples that each pixel then has.
std::uint32_t renderPasses(const Options& o, Scene& scene, const Goal& goal, RenderControl& control,
                           const std::vector<std::string>& outputs) {
  std::optional<Progress> progress;
  if (!o.quiet) progress.emplace(control, scene.film().tiles());
  const double start = now();
  double looked = start;
  std::optional<double> error;
  Passes passes(goal);
  while (true) {
    const Passes::Pass pass = passes.next(now() - start, now() - looked, error);
    if (pass.empty()) return passes.taken();
    if (progress) progress->begin(pass.from, pass.to, error);
    control.firstSample = pass.first;
    control.endSample = pass.end;
    scene.integrator().render(scene, scene.sampler(), scene.film(), control);
    if (goal.error) error = estimatedError(scene.film().image(kVariance));
    if (goal.interval && now() - looked >= *goal.interval) {
      writePictures(o, scene, goal, passes.taken(), now() - start, outputs);
      looked = now();
    }
  }
}

void note(const Options& o, const std::string& message) {
  o.build.report({Severity::note, message});
}

}  // namespace

int render(const Options& o, PluginLoader& loader) {
  Times t;
  SceneReader reader(loader, o.build);
  const auto build = [&](auto step) {
    const double start = now();
    step();
    t.build += now() - start;
  };
  Parser parser([&](Directive&& d) { build([&] { reader.read(std::move(d)); }); }, includes(o),
                o.frame);
  parse(parser, o.files);
  std::unique_ptr<Scene> scene;
  build([&] { scene = reader.finish(); });
  note(o, fmt::format("the scene is read as pbrt-{}: {}", dialectName(reader.dialect().dialect),
                      reader.dialect().reason));
  std::vector<std::string> outputs = o.outputs;
  if (outputs.empty()) outputs = {scene->outputFile()};
  for (const std::string& output : outputs) checkWritable(output);
  t.ready = now();

  RenderControl control;
  control.threads = o.build.threads;
  const Goal goal = goalOf(o, scene->sampler().samplesPerPixel());
  const std::uint32_t samples = renderPasses(o, *scene, goal, control, outputs);
  t.rendered = now();
  if (control.badSamples)
    o.build.report({Severity::warning,
                    fmt::format("{} samples were not a number or infinite; they count as black",
                                control.badSamples.load())});
  writePictures(o, *scene, goal, samples, t.rendered - t.ready, outputs);
  t.written = now();
  if (!o.quiet)
    for (const std::string& output : outputs) fmt::print("{}\n", output);
  if (o.stats) fmt::print("{}", stats(std::move(scene), loader, control, samples, t));
  return judge(o);
}

}  // namespace pbrt
