// The command that covers moving fluids with surface particles and draws them, frame by frame.

#include <fmt/format.h>

#include <csignal>
#include <deque>
#include <set>

#include "animation.h"
#include "core/base/parallel.h"
#include "core/base/replacement.h"
#include "frame_files.h"
#include "options.h"
#include "tools/command.h"
#include "tools/converge/clock.h"
#include "writer.h"

namespace pbrt {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// Ctrl-C ends the run between two frames: what is being written is finished. The second time it
// ends the process at once.
void stopAtSignals() {
  for (const int signal : {SIGINT, SIGTERM})
    std::signal(signal, [](int number) {
      interrupted = number;
      std::signal(number, SIG_DFL);
    });
}

// The figures as columns of a file.
std::string toCsv(const std::deque<FrameFigures>& frames) {
  std::string text =
      "frame,atoms,surfels,motion_ms,field_ms,step_ms,discs_ms,draw_ms,shade_ms,write_ms,cpu_ms,"
      "coverage,evenness,residual,holes,looked,moved,reach\n";
  for (const FrameFigures& f : frames)
    text += fmt::format(
        "{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{:.4f},{:.3g},{},{},"
        "{},{:.6g}\n",
        f.frame, f.atoms, f.surfels, f.motion, f.field, f.step, f.discs, f.draw, f.shade, f.write,
        f.cpu, f.coverage ? fmt::format("{:.4f}", *f.coverage) : "", f.report.evenness,
        f.report.residual, f.report.holes, f.report.looked, f.report.moved, f.report.reach);
  return text;
}

void printHead() {
  fmt::print("{:>6} {:>9} {:>9} {:>9} {:>9} {:>6} {:>6}\n", "frame", "frames/s", "coverage",
             "evenness", "residual", "holes", "moved");
}

void print(const FrameFigures& f) {
  fmt::print("{:6} {:9.1f} {:>9} {:9.3f} {:9.1e} {:6} {:6}\n", f.frame, 1e3 / f.made(),
             f.coverage ? fmt::format("{:.2f} %", 100 * *f.coverage) : "-", f.report.evenness,
             f.report.residual, f.report.holes, f.report.moved);
}

// What all frames took, apart from the first, where the surfels are made.
void printSum(const std::deque<FrameFigures>& frames, double seconds) {
  FrameFigures sum;
  double n = 0;
  for (std::size_t i = frames.size() > 1 ? 1 : 0; i < frames.size(); ++i, ++n) {
    const FrameFigures& f = frames[i];
    sum.motion += f.motion, sum.field += f.field, sum.step += f.step, sum.discs += f.discs;
    sum.draw += f.draw, sum.shade += f.shade, sum.write += f.write, sum.cpu += f.cpu;
  }
  fmt::print(
      "{} frames: {:.1f} a second simulated and drawn, {:.1f} in all\n"
      "of a frame, in ms: field {:.2f}, step {:.2f}, discs {:.2f}, draw {:.2f}, shade {:.2f} (all "
      "cores together {:.2f}); motion {:.2f}, file {:.2f}\n",
      frames.size(), 1e3 * n / sum.made(), static_cast<double>(frames.size()) / seconds,
      sum.field / n, sum.step / n, sum.discs / n, sum.draw / n, sum.shade / n, sum.cpu / n,
      sum.motion / n, sum.write / n);
}

// Nothing is written over what is read, nor the figures over a frame.
void checkApart(const motion::Motion& motion, FrameRange range,
                const std::optional<FrameFiles>& files, const std::string& stats) {
  namespace fs = std::filesystem;
  std::set<fs::path> taken;
  for (const fs::path& file : motion.files()) taken.insert(fs::weakly_canonical(file));
  const auto check = [&](const fs::path& file) {
    if (taken.contains(fs::weakly_canonical(file)))
      throw Error(fmt::format("{} would be written over: choose another name", file.string()),
                  Failure::usage);
  };
  if (!stats.empty()) check(stats);
  if (files && fs::path(stats).extension() == files->file(range.first).extension())
    throw Error(fmt::format("--stats {}: frames have names like this one", stats), Failure::usage);
  for (int n = range.first; files && !taken.empty() && n <= range.last; ++n) check(files->file(n));
}

int run(const ParticleOptions& o) {
  const ThreadLimit limit(o.threads);
  const Point2i size = readSize(o.size);
  const std::unique_ptr<motion::Motion> motion = openMotion(o);
  const FrameRange range = readFrames(o.frames, *motion);
  const PinholeCamera camera(viewOf(o, *motion, size), size);
  std::optional<FrameFiles> files;
  if (!o.out.empty()) files.emplace(o.out, range.first, range.last);
  if (!o.stats.empty()) checkReplaceable(o.stats);
  checkApart(*motion, range, files, o.stats);

  stopAtSignals();
  Animation animation(*motion, camera, lookOf(o), size, {.count = readCount(o), .seed = o.seed},
                      o.settle);
  std::deque<FrameFigures> frames;
  Writer writer;
  const Clock clock;
  if (!o.quiet) printHead();
  const bool ofSurfels = files && files->ofSurfels();
  Image image;
  const auto next = [&](int number) {
    FrameFigures& figures = frames.emplace_back(
        animation.make(number, files && files->ofChannels(), ofSurfels ? nullptr : &image));
    if (!o.quiet) print(figures);
    if (!files) return;
    const auto put = [&](auto write) {
      writer.put([write = std::move(write), file = files->file(number), &ms = figures.write] {
        const Clock writing;
        write(file);
        ms = 1e3 * writing.seconds();
      });
    };
    if (ofSurfels)
      put([surfels = std::vector(animation.surfels().begin(), animation.surfels().end())](
              const auto& file) { writePly(file, surfels); });
    else
      put([picture = std::move(image)](const auto& file) { writeImage(file, picture); });
  };
  // What was measured before an error is kept.
  const auto save = [&] {
    if (!o.stats.empty()) writeFile(o.stats, toCsv(frames));
  };
  try {
    for (int number = range.first; number <= range.last && !interrupted; ++number) next(number);
    writer.finish();
  } catch (...) {
    try {
      writer.finish();
    } catch (...) {  // one error is told, the first
    }
    save();
    throw;
  }
  save();
  if (!o.quiet && !frames.empty()) printSum(frames, clock.seconds());
  return interrupted ? 128 + interrupted : 0;
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  pbrt::ParticleOptions options;
  CLI::App app(
      "pbrt-particles covers a moving fluid with surface particles and draws it, frame by frame.",
      "pbrt-particles");
  pbrt::defineOptions(app, options);
  return pbrt::runCommand(app, pbrt::reversedWords(argc, argv), [&] { return pbrt::run(options); });
}
