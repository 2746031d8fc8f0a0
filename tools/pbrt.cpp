// The command: reads scenes, renders, writes pictures.

#include <fmt/format.h>

#include <cstdio>

#include "command.h"
#include "core/base/file.h"
#include "core/parse/format.h"
#include "core/parse/parse.h"
#include "core/plugin/culprit.h"
#include "core/scene/render.h"
#include "crash.h"
#include "listing.h"
#include "options.h"
#include "progress.h"
#include "stats.h"

namespace pbrt {
namespace {

// Parses the scene files. Their text is in `parser`, for messages to quote.
void parse(Parser& parser, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (file == "-")
      parser.text("<stdin>", readFile("/dev/stdin", FileKind::any));
    else
      parser.file(file);
  }
}

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

// Says what was passed over. Returns the exit code for a scene with so many errors.
int judge(const Options& o) {
  const std::size_t errors = o.reports->errors();
  if (errors == 0) return 0;
  fmt::print(stderr, "{} error{}{}\n", errors, errors == 1 ? "" : "s",
             o.permissive ? " passed over: the picture is not what the scene asks for" : "");
  return o.permissive ? 0 : static_cast<int>(Failure::scene);
}

// Tells errors of includes, where those are to be passed over.
Reporter includes(const Options& o) {
  return o.build.permissive ? o.build.report : Reporter();
}

int formatScene(const Options& o) {
  Formatter formatter;
  std::string text;
  Parser parser([&](Directive&& d) { text += formatter.print(d); }, includes(o));
  parse(parser, o.files);
  fmt::print("{}", text);
  return judge(o);
}

int check(const Options& o, PluginLoader& loader) {
  SceneReader reader(loader, o.build);
  Parser parser([&](Directive&& d) { reader.read(std::move(d)); }, includes(o));
  parse(parser, o.files);
  const auto scene = reader.finish();
  const DetectedDialect& dialect = reader.dialect();
  if (!o.quiet)
    fmt::print("{}: pbrt-{} ({}); {} shapes, {} lights, {} instances, {} plug-ins\n",
               fmt::join(o.files, " "), dialectName(dialect.dialect), dialect.reason,
               scene->shapes(), scene->lights().size(), scene->instances(), loader.opened().size());
  return judge(o);
}

int render(const Options& o, PluginLoader& loader) {
  Times t;
  SceneReader reader(loader, o.build);
  const auto build = [&](auto step) {
    const double start = now();
    step();
    t.build += now() - start;
  };
  Parser parser([&](Directive&& d) { build([&] { reader.read(std::move(d)); }); }, includes(o));
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
  control.strict = o.strict;
  const Goal goal = goalOf(o, scene->sampler().samplesPerPixel());
  const std::uint32_t samples = renderPasses(o, *scene, goal, control, outputs);
  t.rendered = now();
  if (control.faults.count()) o.build.report({Severity::warning, describe(control.faults)});
  writePictures(o, *scene, goal, samples, t.rendered - t.ready, outputs);
  t.written = now();
  if (!o.quiet)
    for (const std::string& output : outputs) fmt::print("{}\n", output);
  if (o.stats) fmt::print("{}", stats(std::move(scene), loader, control, samples, t));
  return judge(o);
}

int run(const Options& o) {
  PluginLoader loader(PluginLoader::searchPath(o.pluginPath));
  if (o.listPlugins)
    fmt::print("{}", listPlugins(loader));
  else if (!o.describe.empty())
    fmt::print("{}", o.describe[0] == "all" ? describeAll(loader)
                                            : describePlugin(loader, o.describe[0], o.describe[1]));
  else if (o.check)
    return check(o, loader);
  else if (o.format)
    return formatScene(o);
  else
    return render(o, loader);
  return 0;
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  pbrt::Options options;
  CLI::App app("pbrt renders scenes described in the pbrt format.", "pbrt");
  pbrt::defineOptions(app, options);
  return pbrt::runCommand(app, pbrt::words(argc, argv), [&] {
    pbrt::finishOptions(options);
    pbrt::tellOfCrashes();
    try {
      return pbrt::run(options);
    } catch (...) {
      std::rethrow_exception(pbrt::asError());
    }
  });
}
