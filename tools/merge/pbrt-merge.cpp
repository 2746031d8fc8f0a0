// The command that puts the parts of a render together.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "merge.h"
#include "tools/command.h"

namespace pbrt {
namespace {

struct Options {
  std::vector<std::filesystem::path> films, outputs;
  bool partial = false, check = false, quiet = false;
};

void defineOptions(CLI::App& app, Options& o) {
  app.set_version_flag("--version", "pbrt-merge " PBRT_VERSION);
  app.add_option("film", o.films,
                 "Films (.film) that pbrt has written as --outfile or --checkpoint")
      ->required();
  auto* outfile =
      app.add_option("--outfile", o.outputs,
                     "Where the whole goes: a picture (.exr, .png), or a film (.film) to be merged "
                     "or resumed; may be repeated")
          ->take_all()
          ->allow_extra_args(false);
  app.add_flag("--partial", o.partial,
               "Make pictures although samples or pixels of the whole render are not there");
  app.add_flag("--check", o.check, "Read all, tell what is wrong, write nothing")
      ->excludes(outfile);
  app.add_flag("--quiet", o.quiet, "Say nothing but errors");
  app.footer(
      "By samples:  pbrt scene.pbrt --samples 0..32 --outfile a.film   (anywhere)\n"
      "             pbrt scene.pbrt --samples 32..64 --outfile b.film\n"
      "             pbrt-merge a.film b.film --outfile whole.exr\n"
      "By windows:  pbrt scene.pbrt --cropwindow 0,0.5,0,1 --outfile left.film ...\n"
      "In stages:   pbrt-merge a.film b.film --outfile ab.film ...\n"
      "So far:      pbrt-merge --partial checkpoint.film --outfile so-far.exr\n"
      "The picture is the same, bit for bit, as that of one process.\n"
      "Exit codes: 0 done, 2 usage, 3 no parts of one render, overlap, gap or not whole, 4 file.");
}

int run(const Options& o) {
  if (o.outputs.empty() && !o.check)
    throw Error("--outfile says where the whole goes; --check writes nothing", Failure::usage);
  MergedFilm film(o.films);
  std::string lacks = incompleteness(film.info());
  if (!lacks.empty()) lacks = "the film is not whole: " + lacks;
  if (!lacks.empty() && !o.partial && !std::ranges::all_of(o.outputs, isFilm))
    throw Error(lacks + "; --partial makes a picture of it all the same");
  writeMerged(film, o.outputs);
  if (o.quiet) return 0;
  if (!lacks.empty()) complain("warning: " + lacks);
  if (film.differentProcessors())
    complain(
        "warning: the films are from processors with different instruction sets: at edges of "
        "shapes "
        "the picture may differ from that of one of them");
  for (const auto& output : o.outputs) fmt::print("{}\n", output.string());
  if (o.check) {
    const std::uint32_t samples = film.info().endSample - film.info().firstSample;
    fmt::print("{} film{}: {} sample{} per pixel\n", o.films.size(), o.films.size() == 1 ? "" : "s",
               samples, samples == 1 ? "" : "s");
  }
  return 0;
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  pbrt::Options options;
  CLI::App app("pbrt-merge makes one picture of the parts of a render.", "pbrt-merge");
  pbrt::defineOptions(app, options);
  return pbrt::runCommand(app, pbrt::reversedWords(argc, argv), [&] { return pbrt::run(options); });
}
