#include "core/scene/render.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/signal_stack.h"
#include "core/scene/accel.h"
#include "core/scene/watch.h"

namespace pbrt {

namespace {

// The place u of a pixel. It is in the pixel still when the sum is rounded.
Point2 inPixel(Point2i pixel, Point2 u) {
  Point2 p = Point2(pixel) + u;
  for (int i = 0; i < 2; ++i)
    if (p[i] >= static_cast<float>(pixel[i] + 1)) p[i] = std::nextafter(p[i], -kInfinity);
  return p;
}

bool allFinite(const FirstSurface& s) {
  return isFinite(s.albedo) && isFinite(s.n) && isFinite(s.p) && isFinite(Vec3(s.uv, s.depth)) &&
         isFinite(s.trueN) && isFinite(s.dpdu) && isFinite(s.dpdv);
}

// What one thread works with.
struct Worker {
  Worker(const Sampler& prototype, std::size_t block)
      : samplers(block), samples(block), cameraRays(block), rays(block), hits(block) {
    for (auto& sampler : samplers) sampler = prototype.clone();
    provideSignalStack();
  }

  // For each ray of a block. They are all in the middle of their sample at once.
  std::vector<std::unique_ptr<Sampler>> samplers;
  std::vector<CameraSample> samples;
  std::vector<CameraRay> cameraRays;
  std::vector<const Ray*> rays;
  std::vector<Hit> hits;
  std::array<std::byte, 1 << 14> memory;
  Scratch scratch{memory.data(), memory.size()};
};

struct TileJob {
  const SamplingIntegrator& integrator;
  const World& world;
  Film& film;
  RenderControl& control;
  float differentialScale;
  int blockWidth;

  // Goes on with a tile from where it is.
  void render(int tile, Worker& worker) const {
    const Bounds2i pixels = film.tilePixels(tile);
    const auto samples = static_cast<std::uint64_t>(pixels.width()) * pixels.height();
    // Sample by sample, not pixel by pixel: all pixels have the same samples when it is stopped.
    std::uint32_t& s = control.reached[tile];
    for (; s < control.endSample; ++s) {
      if (control.stop) return;
      for (int y = pixels.lo.y; y < pixels.hi.y; y += blockWidth)
        for (int x = pixels.lo.x; x < pixels.hi.x; x += blockWidth)
          renderBlock(tile, intersect(pixels, {{x, y}, {x + blockWidth, y + blockWidth}}), s,
                      worker);
      control.rays.fetch_add(Accel::takeRayCount(), std::memory_order_relaxed);
      control.samplesDone.fetch_add(samples, std::memory_order_release);
    }
  }

  void renderBlock(int tile, const Bounds2i& pixels, std::uint32_t index, Worker& worker) const {
    int n = 0;
    for (int y = pixels.lo.y; y < pixels.hi.y; ++y)
      for (int x = pixels.lo.x; x < pixels.hi.x; ++x, ++n) {
        const SamplePlace place{{x, y}, index, 1};
        bool sees = false;
        if (attempt(place, [&] { sees = start(place, worker, n); }) && !sees) add({place});
        if (!sees) blind(worker, n);
      }
    look(pixels, index, worker);
    n = 0;
    for (int y = pixels.lo.y; y < pixels.hi.y; ++y)
      for (int x = pixels.lo.x; x < pixels.hi.x; ++x, ++n) {
        const SamplePlace place{{x, y}, index, 1};
        Sample sample;
        if (!attempt(place, [&] { take(worker, n, sample); })) {
          sample = {};
          worker.scratch.release();
        } else if (!sample.finite) {
          add({place});
          sample = {};
        }
        film.add(tile, worker.samples[n].film, sample.L, sample.opaque);
        if (!sample.surface) continue;
        if (allFinite(*sample.surface))
          film.add(tile, place.pixel, index, *sample.surface);
        else
          add({place});
      }
  }

  // What a sample gives; by itself one that counts as black.
  struct Sample {
    Spectrum L{0};
    bool opaque = true;
    bool finite = true;
    std::optional<FirstSurface> surface;
  };

  // Begins lane i of a block. False if sampler or camera give what is no number.
  bool start(const SamplePlace& place, Worker& worker, int i) const {
    Sampler& sampler = *worker.samplers[i];
    CameraSample& sample = worker.samples[i];
    sample.film = Point2(place.pixel) + 0.5F;  // unless the sampler says better
    sampler.start(place.pixel, place.sample);
    const Point2 u = sampler.pixel2D();
    if (!(u.x >= 0 && u.y >= 0 && u.x < 1 && u.y < 1)) return false;
    sample.film = inPixel(place.pixel, u);
    if (world.camera().usesLens()) sample.lens = sampler.get2D();
    if (world.moves()) sample.time = sampler.get1D();
    CameraRay& camera = worker.cameraRays[i];
    camera = world.camera().generate(sample, world.filters());
    // Zero times what is not a number, or infinite, is no number.
    const Vec3 zero(0);
    if (camera.weight * 0 != 0 ||
        (camera.weight > 0 && glm::dot(camera.ray.o, zero) + glm::dot(camera.ray.d, zero) != 0))
      return false;
    // One that meets nothing, for what may be no ray.
    if (!(camera.weight > 0)) camera.ray = RayDifferential({.d = {0, 0, 1}, .tMax = 0});
    if (world.filters()) camera.ray.scaleDifferentials(differentialScale);
    worker.rays[i] = &camera.ray;
    return true;
  }

  // Lane i of a sample that has failed already: it sees nothing.
  static void blind(Worker& worker, int i) {
    worker.cameraRays[i] = {RayDifferential({.d = {0, 0, 1}, .tMax = 0}), 0};
    worker.rays[i] = &worker.cameraRays[i].ray;
  }

  // Finds the hits of a block. If that throws, it is each ray's own, as nobody knows whose it was.
  void look(const Bounds2i& pixels, std::uint32_t index, Worker& worker) const {
    currentSample = {pixels.lo, index, blockWidth};
    const int width = pixels.width();
    const auto n = static_cast<std::size_t>(width * pixels.height());
    const std::span rays(worker.rays.data(), n);
    const std::span hits(worker.hits.data(), n);
    try {
      integrator.look(world, rays, width, hits);
    } catch (...) {
      for (int i = 0; i < static_cast<int>(n); ++i)
        if (!attempt({pixels.lo + Point2i(i % width, i / width), index, 1}, [&] {
              hits[i] = {};
              integrator.look(world, rays.subspan(i, 1), 1, hits.subspan(i, 1));
            }))
          blind(worker, i);
    }
  }

  // Follows the ray of lane i; `s` is as new.
  void take(Worker& worker, int i, Sample& s) const {
    CameraRay& camera = worker.cameraRays[i];
    Hit& hit = worker.hits[i];
    if (!(camera.weight > 0)) return;
    s.L =
        camera.weight * integrator.Li(world, camera.ray, hit, *worker.samplers[i], worker.scratch);
    worker.scratch.release();
    s.finite = isFinite(s.L);
    if (!s.finite) return;
    const bool stores = film.stores(kOfSurface);
    const Point3 eye = camera.ray.o;
    if (world.bordersMedia() && (stores || isBlack(s.L))) passBorders(camera.ray, hit);
    // As in pbrt-v1: a sky that shines is no hole in the picture. Nor is the barrel of a lens.
    s.opaque = hit.found() || !isBlack(s.L);
    if (!hit.found() || !stores) return;
    s.surface = firstSurface(eye, camera.ray, hit, worker.scratch);
    worker.scratch.release();
  }

  // Runs a part of a sample. False if it threw: that is entered then.
  template <class Work>
  bool attempt(const SamplePlace& place, const Work& work) const {
    currentSample = place;
    try {
      work();
      return true;
    } catch (...) {
      control.faults.addThrown(place);
      if (control.strict || control.faults.outOfMemory()) control.stop = true;
      return false;
    }
  }

  // Enters a sample that is no number, or infinite.
  void add(const Fault& fault) const {
    control.faults.add(fault);
    if (control.strict) control.stop = true;
  }

  // Who gave what is not a number, or infinite: the sample is taken once more, alone and watched.
  const PluginCode* culprit(const SamplePlace& at, const Sampler& sampler) const {
    Watch watch(integrator, world, sampler);
    TileJob job{watch.integrator(), watch.world(), film, control, differentialScale, 1};
    Worker worker(watch.sampler(), 1);
    currentSample = at;
    return watch.culprit([&] {
      if (!job.start(at, worker, 0)) return;
      watch.integrator().look(watch.world(), worker.rays, 1, worker.hits);
      Sample sample;
      job.take(worker, 0, sample);
    });
  }

  // On to what can be seen: the borders of media cannot.
  void passBorders(RayDifferential& ray, Hit& hit) const {
    while (hit.found()) {
      const SurfaceInteraction at = world.surface(ray, hit);
      if (at.material) return;
      static_cast<Ray&>(ray) = spawnRay(at, ray.d);
      hit = world.intersect(ray);
    }
  }

  FirstSurface firstSurface(const Point3& eye, const RayDifferential& ray, const Hit& hit,
                            Scratch& scratch) const {
    SurfaceInteraction at = integrator.surface(world, ray, hit);
    Spectrum albedo(0);
    if (film.stores(kAlbedo | kNormal)) {  // a bump map turns the normal
      const Bsdf bsdf = world.bsdf(at, scratch);
      if (film.stores(kAlbedo)) albedo = bsdf.rho(at.wo);
    }
    return {albedo, at.ns,   at.p,    glm::distance(eye, at.p), at.uv,
            at.n,   at.dpdu, at.dpdv, hit.placed() + 1};
  }
};

}  // namespace

void SamplingIntegrator::render(const World& world, const Sampler& sampler, Film& film,
                                RenderControl& control) const {
  const auto tiles = static_cast<std::size_t>(film.tiles());
  if (control.reached.empty()) control.reached.assign(tiles, control.firstSample);
  if (control.reached.size() != tiles) throw Error("a render cannot go on with another film");
  // A pixel's samples share its area: each stands for 1 / n of it.
  const float samples = control.samplesPerPixel ? static_cast<float>(control.samplesPerPixel)
                                                : static_cast<float>(sampler.samplesPerPixel());
  const float scale = 1 / std::sqrt(samples);
  const TileJob job{*this, world, film, control, scale, blockWidth()};
  const auto block = static_cast<std::size_t>(job.blockWidth * job.blockWidth);
  const int threads = control.threads > 0 ? control.threads : defaultThreads();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(threads);
  tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(sampler, block); });
  arena.execute([&] {
    try {
      if (!control.prepared) prepare(world, film.resolution());
      control.prepared = true;
    } catch (...) {
      std::rethrow_exception(asError());
    }
    tbb::parallel_for(
        tbb::blocked_range<int>(0, film.tiles(), 1),
        [&](const tbb::blocked_range<int>& range) {
          try {
            for (int tile = range.begin(); tile < range.end() && !control.stop; ++tile)
              job.render(tile, workers.local());
          } catch (...) {  // no sample's fault; nobody else need work on
            control.stop = true;
            std::rethrow_exception(asError());
          }
          currentSample = {};
        },
        tbb::simple_partitioner());
  });
  // oneTBB has ordered the tiles before what follows; this read says so to ThreadSanitizer, which
  // does not see into it.
  static_cast<void>(control.samplesDone.load(std::memory_order_acquire));
  control.faults.locate([&](const SamplePlace& at) { return job.culprit(at, sampler); });
  currentSample = {};
  if (control.faults.outOfMemory()) throw Error("out of memory: " + describe(control.faults));
  if (control.strict && control.faults.count() > 0)
    throw Error(describe(control.faults), Failure::plugin);
}

}  // namespace pbrt
