#include "render_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/base/replacement.h"
#include "core/scene/picture_attributes.h"
#include "progress.h"
#include "stats.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

bool isFilm(const fs::path& file) { return file.extension() == ".film"; }

}  // namespace

void checkOutputs(const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs) {
    if (isFilm(output))
      checkReplaceable(output);
    else
      checkWritable(output);
  }
}

void checkCheckpoint(const Options& o) {
  if (o.checkpoint.empty()) return;
  if (!o.resume && fs::exists(o.checkpoint))
    throw Error(fmt::format("{} is there already: go on from it with --resume, or remove it",
                            o.checkpoint),
                Failure::io);
  checkReplaceable(o.checkpoint);
}

bool writesFilms(const Options& o) {
  return !o.checkpoint.empty() || std::ranges::any_of(o.outputs, isFilm);
}

RenderJob::RenderJob(const Options& o, Scene& scene, RenderKey key,
                     std::vector<std::string> outputs, RenderControl& control, Signals& signals)
    : o_(o),
      scene_(scene),
      goal_(goalOf(o, scene.sampler().samplesPerPixel())),
      key_(std::move(key)),
      outputs_(std::move(outputs)),
      control_(control),
      signals_(signals),
      start_(now()) {
  control_.reached.assign(static_cast<std::size_t>(scene.film().tiles()), goal_.firstSample);
}

void RenderJob::resume() {
  if (!fs::exists(o_.checkpoint)) {
    note(o_, fmt::format("{} is not there yet: the render begins", o_.checkpoint));
    return;
  }
  const auto refuse = [&](const std::string& reason) {
    throw Error(fmt::format("cannot go on from {}: {}", o_.checkpoint, reason));
  };
  {
    const FilmReader reader(o_.checkpoint);
    const FilmInfo& found = reader.info();
    const std::string differs = difference(key_, found.key);
    if (!differs.empty()) refuse(differs);
    const Bounds2i window = scene_.film().crop();
    if (found.window.lo != window.lo || found.window.hi != window.hi)
      refuse(fmt::format("it has other pixels: {} {} {} {}, not {} {} {} {}", found.window.lo.x,
                         found.window.hi.x, found.window.lo.y, found.window.hi.y, window.lo.x,
                         window.hi.x, window.lo.y, window.hi.y));
    if (found.firstSample != goal_.firstSample)
      refuse(fmt::format("its first sample is {}, not {}", found.firstSample, goal_.firstSample));
    const std::uint32_t most =
        found.interrupted() ? *std::ranges::max_element(found.reached) : found.endSample;
    if (most > goal_.endSample)
      refuse(fmt::format("it has {} samples per pixel, more than the {} that are asked for",
                         most - goal_.firstSample, goal_.endSample - goal_.firstSample));
  }
  const FilmInfo found = readFilm(o_.checkpoint, scene_.film());
  if (!found.interrupted())
    std::ranges::fill(control_.reached, found.endSample);
  else if (found.reached.size() == control_.reached.size())
    control_.reached = found.reached;
  else
    refuse("its tiles are not those of this film");
  control_.badSamples = found.badSamples;
  start_ -= found.seconds;
  // Planned by the error alone, passes end where those of a render did that was not interrupted.
  if (goal_.error) passEnd_ = std::min(found.passEnd, goal_.endSample);
  note(o_, fmt::format("goes on from {}, at {}", o_.checkpoint, progress()));
}

bool RenderJob::run() {
  const Bounds2i& pixels = scene_.film().sampledPixels();
  Progress progress(o_.progress, control_, pixels.width() * pixels.height());
  double looked = now();
  Passes passes(goal_, least(), std::max(most(), passEnd_));
  while (true) {
    std::optional<double> error;
    if (goal_.error && samples() > 0 && least() == most()) {
      error = estimatedError(scene_.film().image(kVariance));
      progress.error(*error);
    }
    const Passes::Pass pass = passes.next(seconds(), now() - looked, error);
    if (pass.empty()) break;
    if (!renderPass(pass, progress)) {
      progress.end(Stage::interrupted);
      return false;
    }
    if (goal_.interval && now() - looked >= *goal_.interval) {
      writeSoFar();
      looked = now();
    }
  }
  progress.end(Stage::done);
  return true;
}

// Returns false if a signal asks the render to end before the pass does.
bool RenderJob::renderPass(const Passes::Pass& pass, Progress& progress) {
  control_.firstSample = goal_.firstSample;
  control_.endSample = passEnd_ = pass.end;
  while (least() < pass.end) {
    control_.stop = false;  // before its reasons are looked for: those that come later set it again
    if (Signals::interrupted()) return false;
    const bool asked = Signals::takeRequest();
    if (!o_.checkpoint.empty() && (asked || now() >= due_))
      tryTo([&] { saveCheckpoint(); });
    else if (asked)
      writeSoFar();
    signals_.setTimer(due_ - now());
    progress.begin(pass, samplesSince(pass.first));
    scene_.integrator().render(scene_, scene_.sampler(), scene_.film(), control_);
    progress.rest();
  }
  return true;
}

void RenderJob::finish() {
  signals_.setTimer(kNever);
  if (o_.checkpoint.empty()) return writeOutputs();
  saveCheckpoint();
  try {
    writeOutputs();
  } catch (const Error& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    diagnostics.push_back(
        {Severity::note, fmt::format("its samples are in {}: go on with --resume", o_.checkpoint)});
    throw Error(std::move(diagnostics), error.failure());
  }
}

void RenderJob::saveCheckpoint() {
  due_ = kNever;
  writeFilm(o_.checkpoint, scene_.film(), info());
}

