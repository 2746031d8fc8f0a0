// The command: reads scenes, renders, writes pictures; the place where errors end.

#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <iterator>

#include "core/parse/parse.h"
#include "core/scene/builder.h"
#include "core/scene/render.h"
#include "listing.h"
#include "progress.h"

namespace pbrt {
namespace {

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> outputs;
  BuildOptions build;
  std::string dialect;
  std::vector<float> cropWindow;
  std::vector<int> pixelBounds;
  int samplesPerPixel = 0;
  bool quiet = false;
  bool stats = false;
  std::string logLevel = "warning";
  std::string pluginPath;
  bool listPlugins = false;
  std::vector<std::string> describe;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Defines the command line; what it reads lands in `o`.
void defineOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", "pbrt " PBRT_VERSION);
  app.add_option("scene", o.files,
                 "Scene files; several are one scene in sequence. None, or -, is "
                 "standard input");
  app.add_option("--outfile", o.outputs, "Where the picture goes (.exr or .png); may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--spp", o.samplesPerPixel, "Samples per pixel")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  app.add_option("--seed", o.build.seed, "Seed of all random numbers (default 0)");
  app.add_option("--nthreads", o.build.threads, "Number of threads (default: all cores)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--cropwindow", o.cropWindow,
                 "The part to render: x0 x1 y0 y1 or x0,x1,y0,y1, "
                 "each from 0 to 1")
      ->expected(4)
      ->allow_extra_args(false);
  app.add_option("--pixelbounds", o.pixelBounds, "The part to render in pixels: x0,x1,y0,y1")
      ->expected(4)
      ->allow_extra_args(false);
  app.add_flag("--quick", o.build.quick, "A quarter of the resolution each way and of the samples");
  app.add_flag("--quiet", o.quiet, "Say nothing but errors");
  app.add_flag("--stats", o.stats, "Tell times, rays, memory and the plug-ins that were opened");
  app.add_option("--log-level", o.logLevel, "What to say beside results: verbose, warning, error")
      ->check(CLI::IsMember({"verbose", "warning", "error"}));
  app.add_option("--plugin-path", o.pluginPath,
                 "Folders searched first for plug-ins, separated by "
                 "colons (also: PBRT_PLUGIN_PATH)");
  app.add_flag("--list-plugins", o.listPlugins, "List the plug-ins that there are");
  app.add_option("--describe", o.describe, "Show a plug-in's parameters: KIND NAME")->expected(2);
  app.add_option("--dialect", o.dialect, "Which pbrt the scene is written for: v1, v2, v3")
      ->check(CLI::IsMember({"v1", "v2", "v3"}));
  app.footer("Exit codes: 0 done, 2 usage, 3 scene, 4 file or image, 5 plug-in.");
}

// The words of the command line, the last first as CLI11 wants them. pbrt-v4 writes a window as
// x0,x1,y0,y1, perhaps after an equals sign; it becomes the four words that pbrt-v3 has.
std::vector<std::string> words(int argc, char** argv) {
  std::vector<std::string> result;
  for (int i = 1; i < argc; ++i) {
    std::string_view word = argv[i];
    bool window = i > 1 && (argv[i - 1] == std::string_view("--cropwindow") ||
                            argv[i - 1] == std::string_view("--pixelbounds"));
    if (word.starts_with("--cropwindow=") || word.starts_with("--pixelbounds=")) {
      const std::size_t equals = word.find('=');
      result.emplace_back(word.substr(0, equals));
      word.remove_prefix(equals + 1);
      window = true;
    }
    for (std::size_t comma; window && (comma = word.find(',')) != word.npos;) {
      result.emplace_back(word.substr(0, comma));
      word.remove_prefix(comma + 1);
    }
    result.emplace_back(word);
  }
  std::reverse(result.begin(), result.end());
  return result;
}

void finishOptions(Options& o) {
  if (!o.dialect.empty()) o.build.dialect = dialectByName(o.dialect);
  if (o.samplesPerPixel) o.build.samplesPerPixel = o.samplesPerPixel;
  if (!o.cropWindow.empty()) {
    o.build.cropWindow.emplace();
    std::copy(o.cropWindow.begin(), o.cropWindow.end(), o.build.cropWindow->begin());
    for (const float x : o.cropWindow)
      if (!std::isfinite(x)) throw Error("--cropwindow takes numbers from 0 to 1", Failure::usage);
  }
  if (!o.pixelBounds.empty()) {
    o.build.pixelBounds.emplace();
    std::copy(o.pixelBounds.begin(), o.pixelBounds.end(), o.build.pixelBounds->begin());
  }
  if (o.files.empty()) o.files = {"-"};
  o.build.report = [quiet = o.quiet, level = o.logLevel](const Diagnostic& d) {
    const bool wanted =
        d.severity == Severity::error ||
        (!quiet && (d.severity == Severity::warning ? level != "error" : level == "verbose"));
    if (wanted) fmt::print(stderr, "{}\n", format(d));
  };
}

void readScene(Parser& parser, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (file == "-")
      parser.text("<stdin>", {std::istreambuf_iterator<char>(std::cin), {}});
    else
      parser.file(file);
  }
}

struct Times {
  double start = now(), parsed = 0, built = 0, rendered = 0, written = 0;
};

void printStats(const Options& o, const Scene& scene, const PluginLoader& loader,
                const RenderControl& control, const Times& t) {
  std::size_t available = 0;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i)
    available += loader.available(static_cast<PluginKind>(i)).size();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("Seconds   parse {:.3f}, build {:.3f}, render {:.3f}, write {:.3f}\n",
             t.parsed - t.start, t.built - t.parsed, t.rendered - t.built, t.written - t.rendered);
  fmt::print("Rays      {} ({:.2f} Mrays/s)\n", control.rays.load(),
             static_cast<double>(control.rays) / (t.rendered - t.built) / 1e6);
  fmt::print("Scene     {} shapes, {} lights; seed {}\n", scene.shapes(), scene.lights().size(),
             o.build.seed);
  fmt::print("Memory    {:.1f} MiB at most\n", static_cast<double>(usage.ru_maxrss) / 1024);
  fmt::print("Plug-ins  {} opened of {}\n", loader.opened().size(), available);
  for (const LoadedPlugin& plugin : loader.opened())
    fmt::print("  {}/{} ({:.2f} ms)\n", kindFolder(plugin.info->kind), plugin.info->name,
               1e3 * plugin.seconds);
}

void writePictures(const Options& o, Scene& scene, const RenderControl& control,
                   const std::vector<std::string>& outputs, double seconds) {
  Image image = scene.film().image();
  image.attributes = scene.attributes();
  image.attributes["samplesPerPixel"] = static_cast<int>(control.endSample - control.firstSample);
  image.attributes["renderTimeSeconds"] = seconds;
  image.attributes["seed"] = std::to_string(o.build.seed);
  image.attributes["scene"] = fmt::format("{}", fmt::join(o.files, " "));
  image.attributes["software"] = std::string("pbrt " PBRT_VERSION);
  for (const std::string& output : outputs) {
    writeImage(output, image);
    if (!o.quiet) fmt::print("{}\n", output);
  }
}

void render(const Options& o, PluginLoader& loader) {
  Times t;
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  readScene(parser, o.files);
  t.parsed = now();

  const auto scene = buildScene(std::move(directives), loader, o.build);
  std::vector<std::string> outputs = o.outputs;
  if (outputs.empty()) outputs = {scene->outputFile()};
  for (const std::string& output : outputs) checkWritable(output);
  t.built = now();

  RenderControl control;
  control.endSample = static_cast<std::uint32_t>(scene->sampler().samplesPerPixel());
  control.threads = o.build.threads;
  {
    std::optional<Progress> progress;
    if (!o.quiet) progress.emplace(control, scene->film().tiles());
    scene->integrator().render(*scene, scene->sampler(), scene->film(), control);
  }
  t.rendered = now();
  if (control.badSamples)
    o.build.report({Severity::warning,
                    fmt::format("{} samples were not a number or infinite; they count as black",
                                control.badSamples.load())});
  writePictures(o, *scene, control, outputs, t.rendered - t.built);
  t.written = now();
  if (o.stats && !o.quiet) printStats(o, *scene, loader, control, t);
}

int run(const Options& o) {
  PluginLoader loader(PluginLoader::searchPath(o.pluginPath));
  if (o.listPlugins)
    fmt::print("{}", listPlugins(loader));
  else if (!o.describe.empty())
    fmt::print("{}", describePlugin(loader, o.describe[0], o.describe[1]));
  else
    render(o, loader);
  return 0;
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  constexpr int kUsage = 2, kScene = 3, kBug = 1;
  pbrt::Options options;
  CLI::App app("pbrt renders scenes described in the pbrt format.", "pbrt");
  pbrt::defineOptions(app, options);
  try {
    app.parse(pbrt::words(argc, argv));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  }
  try {
    pbrt::finishOptions(options);
    return pbrt::run(options);
  } catch (const pbrt::Error& error) {
    for (const pbrt::Diagnostic& d : error.diagnostics())
      fmt::print(stderr, "{}\n", pbrt::format(d));
    return static_cast<int>(error.failure());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory\n");
    return kScene;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {} (this is a bug in pbrt)\n", error.what());
    return kBug;
  }
}
