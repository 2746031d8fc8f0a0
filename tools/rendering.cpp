#include "rendering.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/base/file.h"
#include "reading.h"
#include "render_job.h"
#include "stats.h"
#include "status_line.h"

namespace pbrt {

int render(const Options& o, PluginLoader& loader) {
  Times t;
  checkOutputs(o.outputs);
  checkCheckpoint(o);
  RenderControl control;
  control.threads = o.build.threads;
  control.strict = o.strict;
  Signals signals(control.stop);
  std::optional<FileDigest> digest;
  if (writesFilms(o)) digest.emplace();
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
  if (digest)
    key = renderKey(*scene, reader.dialect().dialect, o.build.permissive, loader, digest->value());
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
