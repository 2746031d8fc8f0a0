#include "rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/base/file.h"
#include "core/base/replacement.h"
#include "crash.h"
#include "reading.h"
#include "render_job.h"
#include "stats.h"
#include "status_line.h"

namespace pbrt {

namespace {

// These throw unless files of these names can be written: before long work.
void checkOutputs(const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs) {
    if (isFilm(output))
      checkReplaceable(output);
    else
      checkWritable(output);
  }
}

// One that is there may only be gone on from: no other render writes over it.
void checkCheckpoint(const Options& o) {
  if (o.checkpoint.empty()) return;
  if (!o.resume && std::filesystem::exists(o.checkpoint))
    throw Error(fmt::format("{} is there already: go on from it with --resume, or remove it",
                            o.checkpoint));
  checkReplaceable(o.checkpoint);
}

// Whether film files may be written, which hold the key of the render: the scene may name one, too.
bool mayWriteFilms(const Options& o) {
  return !o.checkpoint.empty() || o.outputs.empty() || std::ranges::any_of(o.outputs, isFilm);
}

}  // namespace

int render(const Options& o, PluginLoader& loader) {
  Times t;
  adviseAfterCrash("");  // what is there of the frame before does not help
  checkOutputs(o.outputs);
  checkCheckpoint(o);
  RenderControl control;
  control.threads = o.build.threads;
  control.strict = o.strict;
  Signals signals(control.stop);
  std::optional<FileDigest> digest;
  if (mayWriteFilms(o)) digest.emplace();
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
  o.build.report({Severity::note,
                  fmt::format("the scene is read as pbrt-{}: {}",
                              dialectName(reader.dialect().dialect), reader.dialect().reason)});
  std::vector<std::string> outputs = o.outputs;
  if (outputs.empty()) {
    outputs = {scene->outputFile()};
    checkOutputs(outputs);
  }
  RenderKey key;
  if (digest) {
    key = renderKey(*scene, reader.dialect().dialect, o.build.permissive, loader, digest->value());
    if (o.frame) key.settings += fmt::format(", frame {}", *o.frame);  // which any string may hold
  }
  t.ready = now();

  signals.catchInterruptions();
  RenderJob job(o, *scene, std::move(key), outputs, control, signals);
  if (o.resume) job.resume();
  const bool whole = job.run();
  t.rendered = now();
  if (control.faults.count() > 0) o.build.report({Severity::warning, describe(control.faults)});
  const bool written = job.finish();
  t.written = now();
  if (written && !o.quiet)
    for (const std::string& output : outputs) fmt::print("{}", pictureLine(o.progress, output));
  const std::uint32_t samples = job.samples();
  const std::string interruption = whole ? "" : job.interruption();
  if (o.stats) fmt::print("{}", stats(std::move(scene), loader, control, samples, t));
  if (whole) return judge(o);
  printError(interruption);
  return kInterrupted;
}

}  // namespace pbrt
