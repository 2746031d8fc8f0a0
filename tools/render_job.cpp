#include "render_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/scene/picture_attributes.h"
#include "crash.h"
#include "stats.h"
#include "status_line.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// As --pixelbounds has it.
std::string inWords(const Bounds2i& window) {
  return fmt::format("{},{},{},{}", window.lo.x, window.hi.x, window.lo.y, window.hi.y);
}

// What went wrong with it; empty: nothing.
std::optional<Error> failureOf(const std::function<void()>& write) {
  try {
    write();
    return {};
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error("out of memory for a picture of this size");
  }
}

// The first of them, which tells of the second as well.
Error joined(const Error& first, const std::vector<Diagnostic>& more) {
  std::vector<Diagnostic> all = first.diagnostics();
  all.insert(all.end(), more.begin(), more.end());
  return Error(std::move(all), first.failure());
}

void note(const Options& o, const std::string& message) {
  if (!o.quiet) printError(format({Severity::note, message}));
}

}  // namespace

RenderJob::RenderJob(const Options& o, Scene& scene, RenderKey key,
                     std::vector<std::string> outputs, RenderControl& control, Signals& signals)
    : o_(o),
      scene_(scene),
      goal_(goalOf(o, scene.sampler().samplesPerPixel())),
      key_(std::move(key)),
      outputs_(std::move(outputs)),
      control_(control),
      signals_(signals),
      start_(now()),
      due_(start_ + o.checkpointEvery) {
  control_.reached.assign(static_cast<std::size_t>(scene.film().tiles()), goal_.firstSample);
}

void RenderJob::resume() try {
  if (!fs::exists(o_.checkpoint)) {
    note(o_, fmt::format("{} is not there yet: the render begins", o_.checkpoint));
    return;
  }
  const auto refuse = [&](const std::string& reason) {
    throw Error(fmt::format("cannot go on from {}: {}", o_.checkpoint, reason));
  };
  const FilmInfo found = FilmReader(o_.checkpoint).info();
  const std::uint32_t most = found.mostEndSample();
  const std::string differs = difference(key_, found.key);
  if (!differs.empty()) refuse(differs);
  if (found.window != scene_.film().crop())
    refuse(fmt::format("it has the pixels {}, not {}", inWords(found.window),
                       inWords(scene_.film().crop())));
  if (found.firstSample != goal_.firstSample)
    refuse(fmt::format("its first sample is {}, not {}", found.firstSample, goal_.firstSample));
  if (most > goal_.endSample)
    refuse(fmt::format("it has {} samples per pixel, more than the {} that are asked for",
                       most - goal_.firstSample, goal_.endSample - goal_.firstSample));
  readFilm(o_.checkpoint, scene_.film());
  if (found.interrupted())
    control_.reached = found.reached;
  else
    std::ranges::fill(control_.reached, found.endSample);
  if (goal_.error) passEnd_ = std::min(found.passEnd, goal_.endSample);
  control_.faults.addEarlier(found.badSamples);
  if (o_.strict && found.badSamples > 0) refuse(describe(control_.faults));
  adviseToResume();
  const auto set = found.attributes.find("instructionSet");
  if (set != found.attributes.end() && set->second != ImageAttribute(instructionSet()))
    o_.build.report({Severity::warning,
                     fmt::format("{} is from a processor with another instruction set: at edges of "
                                 "shapes the picture may differ from that of one processor",
                                 o_.checkpoint)});
  start_ -= found.seconds;
  note(o_, fmt::format("goes on from {}, at {}", o_.checkpoint, progress()));
} catch (const Error& error) {  // a damaged file, too, is the fault of this render alone
  throw Error(error.diagnostics(), Failure::scene);
}

bool RenderJob::run() {
  const Bounds2i& pixels = scene_.film().sampledPixels();
  Progress progress(o_.progress, control_, pixels.width() * pixels.height(), goal_.firstSample,
                    samplesSince(goal_.firstSample), o_.frame);
  double looked = now();
  Passes passes(goal_, least(), std::max(most(), passEnd_));
  while (true) {
    std::optional<double> error;
    if ((goal_.error || goal_.showsError) && samples() > 0 && least() == most()) {
      error = estimatedError(scene_.film().image(kVariance));
      progress.error(*error);
    }
    const Passes::Pass pass = passes.next(seconds(), now() - looked, error);
    progress.next(pass);
    if (pass.empty()) break;
    passEnd_ = passes.errorAt();
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
  return whole_ = true;
}

// Returns false if a signal asks the render to end before the pass does.
bool RenderJob::renderPass(const Passes::Pass& pass, Progress& progress) {
  control_.firstSample = goal_.firstSample;
  control_.endSample = pass.end;
  while (least() < pass.end) {
    control_.stop = false;  // before its reasons are looked for: those that come later set it again
    if (Signals::interrupted()) return false;
    const bool due = saves() && now() >= due_;
    if (Signals::takeRequest() || due) {
      if (saves())
        tryTo([&] { saveCheckpoint(); });
      else
        writeSoFar();
      due_ = now() + o_.checkpointEvery;
      Signals::takeRequest();  // what was asked for meanwhile has been done: nothing has changed
      continue;
    }
    signals_.setTimer(saves() ? due_ - now() : kNever);
    progress.begin();
    try {
      scene_.integrator().render(scene_, scene_.sampler(), scene_.film(), control_);
    } catch (const Error& error) {
      if (!saves() || control_.samplesDone == 0) throw;
      // Samples that memory was too short for are black in this film, but are not with more of it.
      if (control_.faults.outOfMemory()) {
        if (!fs::exists(o_.checkpoint)) throw;
        throw joined(error, {{Severity::note, fmt::format("{} is as it was last saved: go on with "
                                                          "--resume where there is more memory",
                                                          o_.checkpoint)}});
      }
      tryTo([&] { saveCheckpoint(); });
      throw;
    }
    progress.rest();
  }
  return true;
}

bool RenderJob::finish() {
  signals_.setTimer(kNever);
  std::optional<Error> unsaved, unwritten;
  if (saves() && control_.samplesDone > 0) unsaved = failureOf([&] { saveCheckpoint(); });
  if (mayWrite()) unwritten = failureOf([&] { writeOutputs(); });
  if (unwritten && unsaved) throw joined(*unwritten, unsaved->diagnostics());
  if (unwritten && saves())
    throw joined(*unwritten, {{Severity::note, fmt::format("the samples are in {}: go on with "
                                                           "--resume",
                                                           o_.checkpoint)}});
  if (unwritten) throw *unwritten;
  if (unsaved) throw *unsaved;
  return mayWrite();
}

bool RenderJob::mayWrite() const {
  return most() > goal_.firstSample && (whole_ || !o_.frame);
}

void RenderJob::saveCheckpoint() {
  writeFilm(o_.checkpoint, scene_.film(), info());
  adviseToResume();
}

void RenderJob::adviseToResume() const {
  adviseAfterCrash(o_.checkpoint + " holds the samples so far: go on with --resume");
}

void RenderJob::writeOutputs() const {
  const FilmInfo info = this->info();
  std::optional<Image> image;
  const auto write = [&](const std::string& output) {
    if (isFilm(output)) return writeFilm(output, scene_.film(), info);
    if (!image) {
      image = scene_.film().image(~info.hidden);
      image->attributes = pictureAttributes(info);
    }
    writeImage(output, *image);
  };
  std::optional<Error> first;  // failure; the other outputs are written all the same
  for (const std::string& output : outputs_) {
    const std::optional<Error> failure = failureOf([&] { write(output); });
    if (!first) first = failure;
  }
  if (first) throw *first;
}

void RenderJob::writeSoFar() const {
  if (mayWrite()) tryTo([&] { writeOutputs(); });
}

// Errors become warnings: it is tried again later.
void RenderJob::tryTo(const std::function<void()>& write) const {
  const std::optional<Error> failure = failureOf(write);
  if (!failure) return;
  for (Diagnostic d : failure->diagnostics()) {
    d.severity = Severity::warning;
    o_.build.report(d);
  }
}

FilmInfo RenderJob::info() const {
  FilmInfo info;
  info.key = key_;
  info.hidden = o_.build.aovs & ~o_.aovSet;  // wanted only for the goal
  info.firstSample = goal_.firstSample;
  info.endSample = least();
  if (most() > least()) info.reached = control_.reached;
  info.passEnd = goal_.error && !whole_ ? passEnd_ : 0;
  info.badSamples = control_.faults.count();
  info.seconds = seconds();
  info.attributes = scene_.attributes();
  info.attributes["filterNoise"] = static_cast<float>(scene_.film().filterNoise());
  info.attributes["seed"] = std::to_string(scene_.seed());
  info.attributes["scene"] = fmt::format("{}", fmt::join(o_.files, " "));
  info.attributes["instructionSet"] = instructionSet();
  info.attributes["software"] = std::string("pbrt " PBRT_VERSION);
  return info;
}

std::string RenderJob::progress() const {
  const std::uint32_t most = this->most() - goal_.firstSample;
  std::string text =
      samples() < most ? fmt::format("{} to {}", samples(), most) : std::to_string(most);
  if (goal_.endSample < kMostSamples)
    text += fmt::format(" of {}", goal_.endSample - goal_.firstSample);
  return text + " samples per pixel";
}

std::string RenderJob::interruption() const {
  const auto film = std::ranges::find_if(outputs_, isFilm);
  return fmt::format("interrupted at {}; {}", progress(),
                     !o_.checkpoint.empty() ? "go on with --resume"
                     : film != outputs_.end() && mayWrite()
                         ? fmt::format("go on with --checkpoint {} --resume", *film)
                         : "without --checkpoint, it cannot be continued");
}

std::uint64_t RenderJob::samplesSince(std::uint32_t first) const {
  std::uint64_t sum = 0;
  for (int tile = 0; tile < scene_.film().tiles(); ++tile) {
    const Bounds2i pixels = scene_.film().tilePixels(tile);
    sum += (control_.reached[static_cast<std::size_t>(tile)] - first) *
           static_cast<std::uint64_t>(pixels.width() * pixels.height());
  }
  return sum;
}

std::uint32_t RenderJob::least() const {
  return std::ranges::min(control_.reached);
}
std::uint32_t RenderJob::most() const {
  return std::ranges::max(control_.reached);
}
double RenderJob::seconds() const {
  return now() - start_;
}

}  // namespace pbrt
