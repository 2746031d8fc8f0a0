#include "options.h"

#include <fmt/format.h>

#include <charconv>

#include "core/base/error.h"
#include "core/base/memory_limit.h"
#include "tools/command.h"
#include "tools/particles/motion/sequence.h"

namespace pbrt {

namespace {

CLI::Validator finiteNumber() {
  return {[](std::string& text) {
            float value = 0;
            const bool fine = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            return fine ? "" : "must be a finite number, not " + text;
          },
          "NUMBER"};
}

CLI::Option* addTriple(CLI::App& app, const std::string& name, std::vector<float>& to,
                       const std::string& help) {
  return app.add_option(name, to, help)->delimiter(',')->expected(3)->check(finiteNumber());
}

// Two numbers from 0 on, `mark` between them.
std::optional<Point2i> pairOf(std::string_view text, char mark) {
  Point2i pair;
  const char *at = text.data(), *const end = at + text.size();
  for (const int i : {0, 1}) {
    if (i == 1 && (at == end || *at++ != mark)) return {};
    const auto [stop, error] = std::from_chars(at, end, pair[i]);
    if (error != std::errc() || pair[i] < 0) return {};
    at = stop;
  }
  return at == end ? std::optional(pair) : std::nullopt;
}

Vec3 tripleOf(const std::vector<float>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

void defineOptions(CLI::App& app, ParticleOptions& o) {
  app.set_version_flag("--version", "pbrt-particles " PBRT_VERSION);
  CLI::Option* const files =
      app.add_option("files", o.files,
                     "Numbered files of particles, such as fluid####.ply, with # for the digits");
  CLI::Option* const motion = app.add_option(
      "--motion", o.motion,
      "A motion of its own: " + fmt::format("{}", fmt::join(motion::motionNames(), ", ")) +
          " (default dam)");
  motion->excludes(files);
  app.add_option("--atoms", o.atoms, "Atoms of the motion (default 1500)")->excludes(files);
  app.add_option("--particles", o.particles, "Particles on the surface (default 16384)")
      ->check(CLI::Range(1, 100'000'000));
  app.add_option("--frames", o.frames,
                 "Frames to make, such as 1-120 (default: all files, or 1-120)");
  app.add_option("--fps", o.fps,
                 "Frames a second of the motion (default: 24 of files, 60 of the others)")
      ->check(positiveNumber());
  app.add_option("--settle", o.settle,
                 "Steps at the first frame, for the particles to spread (default 30)")
      ->check(CLI::Range(0, 1'000'000));
  app.add_option("--seed", o.seed, "Of what is random");
  app.add_option("--out", o.out,
                 "Files for the frames, such as frames/####.png: pictures (.png, .exr) or surface "
                 "particles (.ply)");
  app.add_option("--size", o.size, "Pixels of a picture (default 512x512)");
  app.add_option("--stats", o.stats, "A CSV file with the figures of every frame");

  const std::string atoms = "Atoms of files";
  app.add_option("--kernel", o.kernel, "How an atom's field falls with the distance")
      ->check(CLI::IsMember(
          std::vector<std::string>(metaballs::kKernels.begin(), metaballs::kKernels.end())))
      ->needs(files)
      ->group(atoms);
  CLI::Option* const radius =
      app.add_option("--radius", o.radius, "Where an atom's field ends (default: by radiusscale)")
          ->check(positiveNumber())
          ->needs(files)
          ->group(atoms);
  app.add_option("--radiusscale", o.radiusScale,
                 "That over the radius of the particle in the file (default 4)")
      ->check(positiveNumber())
      ->needs(files)
      ->excludes(radius)
      ->group(atoms);
  app.add_option("--threshold", o.threshold, "The field on the surface")
      ->check(positiveNumber())
      ->needs(files)
      ->group(atoms);

  const std::string view = "View";
  addTriple(app, "--eye", o.eye, "Where the camera is, as x,y,z (default: all is in the picture)")
      ->group(view);
  addTriple(app, "--look", o.look, "What is in the middle of the picture")->group(view);
  addTriple(app, "--up", o.up, "What is up (default 0,1,0)")->group(view);
  app.add_option("--fov", o.fov, "Angle of view over the shorter side, in degrees (default 40)")
      ->check(CLI::Range(0.001, 179.0))
      ->group(view);
  addTriple(app, "--color", o.color, "Of the surface, as red,green,blue of linear light")
      ->check(CLI::Range(0.0, 1e6))
      ->group(view);
  addTriple(app, "--background", o.background, "One colour in place of the sky")
      ->check(CLI::Range(0.0, 1e6))
      ->group(view);

  app.add_option("--nthreads,--threads", o.threads, "Number of threads (default: all cores)")
      ->check(CLI::Range(1, 4096));
  app.add_flag("--quiet", o.quiet, "Say nothing but errors");
  app.footer(
      "Examples:\n"
      "  pbrt-particles --motion split --out frames/####.png\n"
      "  pbrt-particles sim/fluid####.ply --frames 10-99 --eye 2,1,-3 --look 0,0.5,0 --out "
      "####.exr\n"
      "  pbrt-particles --particles 65536 --stats figures.csv\n"
      "Exit codes: 0 done, 2 usage, 3 what a file holds, 4 file or image, 130 interrupted.");
}

FrameRange readFrames(const std::string& text, const motion::Motion& motion) {
  constexpr int kUsual = 120;
  const int first = motion.first(), last = motion.last();
  const bool endless = last == motion::kMostFrames - 1;
  if (text.empty()) return {first, endless ? first + kUsual - 1 : last};
  const std::optional<Point2i> pair =
      pairOf(text.find('-') < text.size() ? text : text + '-' + text, '-');
  if (!pair)
    throw Error(fmt::format("--frames is {}, but must be as 1-120, or 7 for one", shown(text)),
                Failure::usage);
  if (pair->x > pair->y)
    throw Error(fmt::format("--frames {}: the last is before the first", text), Failure::usage);
  if (pair->x < first || pair->y > last)
    throw Error(endless ? fmt::format("--frames {}: the first frame is {}", text, first)
                        : fmt::format("--frames {}: there are frames {} to {}", text, first, last),
                Failure::usage);
  motion.require(pair->x, pair->y);
  return {pair->x, pair->y};
}

Point2i readSize(const std::string& text) {
  constexpr int kMost = 16384;
  constexpr std::size_t kBytesOfPixel =
      192;  // its ray, what it sees, and its values, waiting ones too
  const std::optional<Point2i> pair = pairOf(text, 'x');
  if (!pair || pair->x < 1 || pair->y < 1 || pair->x > kMost || pair->y > kMost)
    throw Error(
        fmt::format("--size is {}, but must be as 512x512, each from 1 to {}", shown(text), kMost),
        Failure::usage);
  if (std::size_t(pair->x) * std::size_t(pair->y) > halfOfMemory() / kBytesOfPixel)
    throw Error(fmt::format("--size {} is more than the memory of this machine can take", text),
                Failure::usage);
  return *pair;
}

std::size_t readCount(const ParticleOptions& o) {
  constexpr std::size_t kBytesOfSurfel =
      1024;  // with what the simulation, the drawing and the writer keep of it
  if (o.particles > halfOfMemory() / kBytesOfSurfel)
    throw Error(
        fmt::format("--particles {} is more than the memory of this machine can take", o.particles),
        Failure::usage);
  return o.particles;
}

std::unique_ptr<motion::Motion> openMotion(const ParticleOptions& o) {
  if (o.files.empty()) return motion::makeMotion(o.motion, o.atoms, o.fps.value_or(60));
  motion::SequenceSettings settings;
  settings.fps = o.fps.value_or(settings.fps);
  settings.kernel = static_cast<metaballs::Kernel>(
      std::ranges::find(metaballs::kKernels, o.kernel) - metaballs::kKernels.begin());
  settings.radius = o.radius;
  settings.radiusScale = o.radiusScale;
  settings.threshold = o.threshold;
  return motion::openSequence(o.files, settings);
}

View viewOf(const ParticleOptions& o, const motion::Motion& motion, Point2i size) {
  View view = viewOf(motion.bounds(), tripleOf(o.up), size, o.fov);
  if (!o.look.empty()) view.look = tripleOf(o.look);
  if (!o.eye.empty()) view.eye = tripleOf(o.eye);
  return view;
}

Look lookOf(const ParticleOptions& o) {
  Look look;
  if (!o.color.empty()) look.color = tripleOf(o.color);
  if (!o.background.empty()) look.background = tripleOf(o.background);
  return look;
}

}  // namespace pbrt
