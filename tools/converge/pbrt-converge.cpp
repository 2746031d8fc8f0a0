// The command that measures error against run time.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/parallel.h"
#include "core/base/replacement.h"
#include "report.h"
#include "tools/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> scenes, changes, references;
  std::string referenceChange;
  int referenceSamples = 0;
  int minSamples = 1, maxSamples = 256;
  std::vector<double> times;
  bool progressive = false;
  int seeds = 4;
  std::string out;
  BuildOptions build;
  std::string dialect, pluginPath;
  bool quiet = false;
};

constexpr int kMost = std::numeric_limits<int>::max();

void defineOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", "pbrt-converge " PBRT_VERSION);
  app.add_option("scene", o.scenes, "Scene files")->required();
  app.add_option(
         "--with", o.changes,
         "A variant of every scene: Integrator, Sampler and PixelFilter statements in place "
         "of its own, with a label if you like: 'paths=Integrator \"path\"'; may be "
         "repeated; '' is the scene as it is")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--out", o.out, "Folder for index.html, report.csv and report.json")->required();
  app.add_option(
         "--reference", o.references,
         "What is right: a picture (.exr) or a scene to render (.pbrt); one for all scenes, "
         "or one for each. Without it every scene is its own")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option(
         "--reference-spp", o.referenceSamples,
         "Samples per pixel of rendered references (default: 16 times the most of a variant)")
      ->check(CLI::Range(2, kMost));
  app.add_option("--reference-with", o.referenceChange,
                 "Statements for rendered references, as in --with");
  app.add_option("--min-spp", o.minSamples, "Samples per pixel of the first snapshot; then doubled")
      ->check(CLI::Range(1, kMost));
  app.add_option("--max-spp", o.maxSamples,
                 "The most samples per pixel of a snapshot (default 256)")
      ->check(CLI::Range(1, kMost));
  app.add_option("--times", o.times, "Snapshots after so many seconds of rendering, e.g. 1,2,4")
      ->delimiter(',')
      ->excludes("--min-spp", "--max-spp")
      ->check(positiveNumber());
  app.add_flag("--progressive", o.progressive,
               "Snapshots of one growing render, not a render for every number of samples; always "
               "so with --times");
  app.add_option("--seeds", o.seeds, "Renders of every snapshot, for the error bars (default 4)")
      ->check(CLI::Range(1, 10000));
  app.add_option("--seed", o.build.seed, "The first seed (default 1)");
  app.add_option("--width", o.build.width, "Width in pixels; the height follows")
      ->check(CLI::Range(1, 1 << 16));
  app.add_option("--nthreads", o.build.threads, "Number of threads (default: all cores)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--plugin-path", o.pluginPath, "Folders searched first for plug-ins");
  app.add_option("--dialect", o.dialect, "Which pbrt the scenes are written for: v1, v2, v3")
      ->check(CLI::IsMember({"v1", "v2", "v3"}));
  app.add_flag("--quiet", o.quiet, "Say nothing but errors");
  app.footer("Exit codes: 0 done, 2 usage, 3 scene, 4 file or image, 5 plug-in.");
}

// The snapshots: from the fewest samples on, always twice as many, up to the most.
Plan planOf(const Options& o) {
  Plan plan;
  plan.times = o.times;
  if (std::adjacent_find(o.times.begin(), o.times.end(), std::greater_equal()) != o.times.end())
    throw Error("--times must grow", Failure::usage);
  if (o.minSamples > o.maxSamples) throw Error("--min-spp is more than --max-spp", Failure::usage);
  if (o.times.empty())
    for (std::int64_t n = o.minSamples; n <= o.maxSamples; n *= 2)
      plan.samples.push_back(static_cast<std::uint32_t>(n));
  plan.progressive = o.progressive || !o.times.empty();
  plan.firstSeed = *o.build.seed;
  plan.seeds = o.seeds;
  plan.threads = o.build.threads;
  return plan;
}

std::vector<Variant> buildVariants(const Options& o, PluginLoader& loader) {
  std::vector<Change> changes;
  for (const std::string& text : o.changes) changes.push_back(readChange(text));
  if (changes.empty()) changes.emplace_back();
  std::vector<Variant> variants;
  for (const std::string& scene : o.scenes)
    for (const Change& change : changes) {
      Variant& v = variants.emplace_back(buildVariant(scene, change, loader, o.build));
      v.label = change.label.empty()   ? v.name
                : o.scenes.size() == 1 ? change.label
                                       : fmt::format("{} {}", v.name, change.label);
    }
  return variants;
}

// As a person would type it.
std::string commandLine(int argc, char** argv) {
  std::string line = "pbrt-converge";
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    line += ' ';
    if (!word.empty() &&
        word.find_first_of(" \t\n\"'$&|;<>()*?[]\\#~`!{}") == std::string_view::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) {
      if (c == '\'')
        line += "'\\''";  // nothing is special within the quotation but its end
      else
        line += c;
    }
    line += '\'';
  }
  return line;
}

int referenceSamples(const Options& o) {
  if (o.referenceSamples) return o.referenceSamples;
  if (!o.times.empty()) return 1024;
  return static_cast<int>(std::min<std::int64_t>(std::int64_t{16} * o.maxSamples, kMost));
}

bool isPicture(const fs::path& file) {
  return file.extension() == ".exr";
}

Reference makeReference(const Options& o, const fs::path& file, PluginLoader& loader) {
  if (isPicture(file)) return readReference(file);
  const int samples = referenceSamples(o);
  const Variant variant = buildVariant(file, readChange(o.referenceChange), loader, o.build);
  if (!o.quiet) fmt::print(stderr, "reference of {}: {} samples\n", variant.name, samples);
  return renderReference(variant, static_cast<std::uint32_t>(samples), o.build.threads);
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()),
                Failure::io);
  for (const char* file : {"report.json", "report.csv", "index.html"})
    checkReplaceable(folder / file);
}

// Scenes of the same name in different folders are different scenes.
void nameApart(std::vector<Reference>& references) {
  std::map<std::string, int> seen;
  for (Reference& r : references)
    if (const int n = ++seen[r.scene]; n > 1) r.scene += fmt::format(" ({})", n);
}

// Tells of samples that were not a number: they bias what was measured.
void noteBadSamples(Report& report, const Reporter& say) {
  const auto note = [&](const std::string& whose, std::uint64_t bad) {
    if (bad == 0) return;
    report.notes.push_back(fmt::format(
        "{}: {} samples were not a number or infinite; they count as black", whose, bad));
    say({Severity::warning, report.notes.back()});
  };
  for (const Reference& r : report.references) note("reference " + r.description, r.badSamples);
  for (std::size_t v = 0; v < report.curves.size(); ++v)
    note((*report.variants)[v].label, report.curves[v].badSamples);
}

void converge(Options& o, const std::string& command) {
  if (!o.dialect.empty()) o.build.dialect = dialectByName(o.dialect);
  o.build.aovs = kVariance;
  o.build.report = [&](const Diagnostic& d) {
    if (!o.quiet && d.severity != Severity::note) fmt::print(stderr, "{}\n", format(d));
  };
  const std::size_t given = o.references.size();
  if (given > 1 && given != o.scenes.size())
    throw Error("one --reference for all scenes, or one for each", Failure::usage);
  if (given && std::all_of(o.references.begin(), o.references.end(), isPicture) &&
      (o.referenceSamples || !o.referenceChange.empty()))
    throw Error("--reference-spp and --reference-with are for references to be rendered",
                Failure::usage);
  Plan plan = planOf(o);

  PluginLoader loader(PluginLoader::searchPath(o.pluginPath));
  const std::vector<Variant> variants = buildVariants(o, loader);
  const fs::path out = o.out;
  makeFolder(out);  // before the work, which may be long
  Report report;
  report.command = command;
  report.threads = o.build.threads ? o.build.threads : defaultThreads();
  report.variants = &variants;
  for (std::size_t i = 0; i < (given == 1 ? 1 : o.scenes.size()); ++i)
    report.references.push_back(
        makeReference(o, given == 0 ? o.scenes[i] : o.references[i], loader));
  nameApart(report.references);
  // A picture says how many samples its textures were filtered for.
  plan.textureSamples = report.references[0].samples.value_or(0);
  std::vector<const Reference*> references;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const std::size_t scene = v / (variants.size() / o.scenes.size());
    report.referenceOf.push_back(given == 1 ? 0 : scene);
    references.push_back(&report.references[report.referenceOf.back()]);
    if (references.back()->image.window != variants[v].scene->film().crop())
      throw Error(
          fmt::format("the reference of {} has other pixels than the scene", variants[v].name),
          Failure::usage);
  }
  report.curves = measure(variants, references, plan, [&](const std::string& what) {
    if (!o.quiet) fmt::print(stderr, "{}\n", what);
  });
  noteBadSamples(report, o.build.report);
  double rendering = 0, pictures = 0;
  for (const Curve& curve : report.curves) {
    rendering += curve.renderSeconds;
    pictures += curve.pictureSeconds;
  }
  report.notes.push_back(
      fmt::format("{:.1f} s of rendering; taking the pictures from the film, not counted, {:.2g} % "
                  "of that",
                  rendering, 100 * pictures / rendering));
  const nlohmann::ordered_json json = toJson(report);
  writeFile(out / "report.json", toText(json, 1));
  writeFile(out / "report.csv", toCsv(json));
  writeFile(out / "index.html", toHtml(json));
  if (!o.quiet) fmt::print("{}{}\n", toTable(json), (out / "index.html").string());
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  pbrt::Options options;
  options.build.seed = 1;
  CLI::App app("pbrt-converge measures the error of renders against their run time.",
               "pbrt-converge");
  pbrt::defineOptions(app, options);
  return pbrt::runCommand(app, pbrt::reversedWords(argc, argv), [&] {
    pbrt::converge(options, pbrt::commandLine(argc, argv));
    return 0;
  });
}
