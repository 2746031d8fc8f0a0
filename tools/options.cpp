#include "options.h"

#include <fmt/format.h>

#include <charconv>

#include "command.h"
#include "core/scene/film_file.h"
#include "frames.h"

namespace pbrt {

namespace {

// "a..b": the samples from a up to, not including, b.
void readRange(const std::string& text, Goal& goal) {
  const char* const end = text.data() + text.size();
  const auto [dots, error] = std::from_chars(text.data(), end, goal.firstSample);
  if (error == std::errc() && std::string_view(dots, end).starts_with("..")) {
    const auto [last, error2] = std::from_chars(dots + 2, end, goal.endSample);
    if (error2 == std::errc() && last == end && goal.firstSample < goal.endSample &&
        goal.endSample <= kMostSamples)
      return;
  }
  throw Error(
      fmt::format("--samples takes a range like 0..64 (64 samples, the first is 0), not {}", text),
      Failure::usage);
}

const std::map<std::string, ProgressStyle> kProgressStyles = {{"auto", ProgressStyle::automatic},
                                                              {"bar", ProgressStyle::bar},
                                                              {"lines", ProgressStyle::lines},
                                                              {"json", ProgressStyle::json},
                                                              {"none", ProgressStyle::none}};

// A duration in seconds: 30, 30s, 1.5m, 2h, 500ms.
CLI::Validator seconds() {
  return CLI::AsNumberWithUnit(
             std::map<std::string, double>{{"ms", 1e-3}, {"s", 1}, {"m", 60}, {"h", 3600}},
             CLI::AsNumberWithUnit::UNIT_OPTIONAL, "DURATION") &
         positiveNumber();
}

}  // namespace

void defineOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", "pbrt " PBRT_VERSION);
  app.add_option("scene", o.files,
                 "Scene files; several are one scene in sequence. None, or -, is "
                 "standard input");
  app.add_option(
         "--outfile", o.outputs,
         "Where the picture goes (.exr, .png; .film: its sums, for pbrt-merge and --resume); "
         "may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--spp", o.samplesPerPixel, "Samples per pixel")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  app.add_option("--samples", o.samples,
                 "Take samples A..B of each pixel only (0..64 are the first 64)");
  app.add_option(
         "--time", o.goal.seconds,
         "Render for as long as this, e.g. 30s, 5m, 2h; without --spp, any number of samples")
      ->transform(seconds());
  app.add_option("--target-error", o.goal.error,
                 "Render until the relative error, as estimated from the picture's own noise, is "
                 "this, e.g. 0.01")
      ->check(positiveNumber());
  app.add_option("--write-every", o.goal.interval, "Write the picture so far this often, e.g. 10s")
      ->transform(seconds());
  auto* checkpoint = app.add_option("--checkpoint", o.checkpoint,
                                    "Save all samples to this file (.film) now and then, when a "
                                    "signal stops the render, and at its end");
  app.add_option("--checkpoint-every", o.checkpointEvery, "How often (default 60s)")
      ->transform(seconds())
      ->needs(checkpoint);
  app.add_flag("--resume", o.resume,
               "Go on from the checkpoint, to the same picture bit for bit; begin if there is none "
               "yet. --time counts the seconds of all runs")
      ->needs(checkpoint);
  app.add_option("--aov", o.aovs,
                 fmt::format("What to store in the .exr beside the picture: {}",
                             fmt::join(aovNames(), ", ")))
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false)
      ->check(CLI::IsMember(std::vector<std::string>(aovNames().begin(), aovNames().end())));
  app.add_option(
      "--frames", o.frameList,
      "Render frames of an animation, one after the other: 7, 1-240, 1-240:10 (every tenth) or "
      "1-10,20. A run of # becomes the frame's number, in the names of scenes and outputs and in "
      "all strings of the scene: --outfile out/####.exr");
  app.add_option("--fps", o.framesPerSecond,
                 "Frames per second: frame k shows the scene k / FPS seconds later (default: its "
                 "time stands still)")
      ->check(positiveNumber());
  app.add_flag("--skip-existing", o.skipExisting,
               "Leave out frames whose pictures are there already");
  app.add_option("--seed", o.build.seed, "Seed of all random numbers (default 0)");
  app.add_option("--nthreads", o.build.threads,
                 "Exactly so many threads work, above the number of cores, too (default: the cores "
                 "that affinity and the container leave to pbrt)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--width", o.build.width, "Width in pixels; the height follows")
      ->check(CLI::Range(1, 1 << 16));
  app.add_option("--cropwindow", o.cropWindow,
                 "The part to render: x0 x1 y0 y1 or x0,x1,y0,y1, "
                 "each from 0 to 1")
      ->expected(4)
      ->allow_extra_args(false);
  app.add_option("--pixelbounds", o.pixelBounds, "The part to render in pixels: x0,x1,y0,y1")
      ->expected(4)
      ->allow_extra_args(false);
  app.add_flag("--quick", o.build.quick, "A quarter of the resolution each way and of the samples");
  app.add_flag("--quiet", o.quiet,
               "Say nothing but errors, and what --stats and --progress are asked to tell");
  app.add_option_function<std::string>(
         "--progress",
         [&o](const std::string& name) { o.progress = kProgressStyles.find(name)->second; },
         "How to tell how far the render is: bar (on a terminal; elsewhere a line now and then), "
         "lines (messages of Open Job Description on standard output), json (there, an object a "
         "line), none; auto: bar, or none with --quiet")
      ->check(CLI::IsMember(&kProgressStyles));
  app.add_flag("--progress-error", o.goal.showsError,
               "Tell the relative error, as --target-error estimates it, about every 10 s");
  auto* stats = app.add_flag("--stats", o.stats,
                             "Tell times, rays, memory and the plug-ins that were opened");
  app.add_option("--log-level", o.logLevel, "What to say beside results: verbose, warning, error")
      ->check(CLI::IsMember({"verbose", "warning", "error"}));
  app.add_option("--plugin-path", o.pluginPath,
                 "Folders searched first for plug-ins, separated by "
                 "colons (also: PBRT_PLUGIN_PATH)");
  app.add_flag("--list-plugins", o.listPlugins, "List the plug-ins that there are");
  app.add_option("--describe", o.describe,
                 "Show a plug-in's parameters: KIND NAME; all: those of every plug-in, in Markdown")
      ->expected(1, 2)
      ->allow_extra_args(false);
  app.add_option("--dialect", o.dialect, "Which pbrt the scene is written for: v1, v2, v3, v4")
      ->check(CLI::IsMember({"v1", "v2", "v3", "v4"}));
  auto* check = app.add_flag("--check", o.check,
                             "Read and build the scene, tell all that is wrong, render nothing")
                    ->excludes(stats);
  app.add_flag("--format", o.format,
               "Print the scene in a normal form that means the same, with its includes put in")
      ->excludes(check, stats);
  app.add_flag("--permissive", o.permissive,
               "Go on where the scene is wrong: what cannot be had is magenta, or left out");
  app.add_flag("--strict", o.strict,
               "End at the first sample that fails, instead of counting it as black");
  app.footer(
      "SIGUSR1: save the checkpoint (without one: the picture so far) and go on.\n"
      "SIGTERM, SIGINT, SIGHUP: save both and end; a second SIGINT: end at once.\n"
      "Exit codes: 0 done, 2 usage, 3 scene, 4 file or image, 5 plug-in, 75 interrupted.");
}

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
  if (o.progress == ProgressStyle::automatic)
    o.progress = o.quiet ? ProgressStyle::none : ProgressStyle::bar;
  if (o.stats && o.progress == ProgressStyle::json)
    throw Error("--stats would come between the objects of --progress=json", Failure::usage);
  if (!o.dialect.empty()) o.build.dialect = dialectByName(o.dialect);
  if (!o.describe.empty() && (o.describe.size() == 1) != (o.describe[0] == "all"))
    throw Error("--describe takes KIND NAME, or all", Failure::usage);
  if (o.samplesPerPixel) o.build.samplesPerPixel = o.samplesPerPixel;
  if (!o.samples.empty()) readRange(o.samples, o.goal);
  for (const std::string& name : o.aovs) o.aovSet |= *aovByName(name);
  o.build.aovs = o.aovSet;
  if (o.goal.error || o.goal.showsError) o.build.aovs |= kVariance;
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
  if (!o.checkpoint.empty() && !isFilm(o.checkpoint))  // a picture might take its place
    throw Error(fmt::format("--checkpoint {}: its name must end in .film", shown(o.checkpoint)),
                Failure::usage);
  if (o.checkpointEvery < 0.1)  // or it does nothing else
    throw Error("--checkpoint-every takes 100ms or more", Failure::usage);
  if (o.files.empty()) o.files = {"-"};
  if (o.files[0] != "-") o.build.folder = std::filesystem::path(o.files[0]).parent_path();
  if (o.frameList) o.frames = readFrames(*o.frameList);
  if (!o.frames.empty())
    checkFrames(o);
  else if (o.skipExisting || o.framesPerSecond > 0)
    throw Error("--skip-existing and --fps are about --frames", Failure::usage);
  const Severity least = o.quiet || o.logLevel == "error" ? Severity::error
                         : o.logLevel == "verbose"        ? Severity::note
                                                          : Severity::warning;
  o.reports = std::make_shared<Reports>(least);
  o.build.permissive = o.permissive || o.check;
  renewReports(o);
}

void renewReports(Options& o) {
  o.reports = std::make_shared<Reports>(o.reports->least());
  o.build.report = [reports = o.reports](const Diagnostic& d) { reports->add(d); };
}

Goal goalOf(const Options& o, int samplesPerPixel) {
  Goal goal = o.goal;
  goal.evenly = !o.checkpoint.empty();
  const bool byOther = goal.seconds || goal.error;
  if (o.samples.empty())
    goal.endSample =
        byOther && !o.samplesPerPixel ? kMostSamples : static_cast<std::uint32_t>(samplesPerPixel);
  return goal;
}

}  // namespace pbrt
