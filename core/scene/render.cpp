#include "core/scene/render.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/accel.h"

namespace pbrt {

namespace {

// The place u of a pixel. It is in the pixel still when the sum is rounded.
Point2 inPixel(Point2i pixel, Point2 u) {
  Point2 p = Point2(pixel) + u;
  for (int i = 0; i < 2; ++i)
    if (p[i] >= static_cast<float>(pixel[i] + 1)) p[i] = std::nextafter(p[i], -kInfinity);
  return p;
}

// What one thread works with.
struct Worker {
  Worker(const Sampler& prototype, std::size_t block)
      : samplers(block), samples(block), cameraRays(block), rays(block), hits(block) {
    for (auto& sampler : samplers) sampler = prototype.clone();
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
      control.samplesDone.fetch_add(samples, std::memory_order_relaxed);
    }
    ++control.tilesDone;
  }

  void renderBlock(int tile, const Bounds2i& pixels, std::uint32_t index, Worker& worker) const {
    const bool lens = world.camera().usesLens();
    int n = 0;
    for (int y = pixels.lo.y; y < pixels.hi.y; ++y)
      for (int x = pixels.lo.x; x < pixels.hi.x; ++x, ++n) {
        Sampler& sampler = *worker.samplers[n];
        sampler.start({x, y}, index);
        CameraSample& sample = worker.samples[n];
        sample.film = inPixel({x, y}, sampler.pixel2D());
        if (lens) sample.lens = sampler.get2D();
        if (world.moves()) sample.time = sampler.get1D();
        CameraRay& camera = worker.cameraRays[n];
        camera = world.camera().generate(sample, world.filters());
        // One that meets nothing, for what may be no ray.
        if (!(camera.weight > 0)) camera.ray = RayDifferential({.d = {0, 0, 1}, .tMax = 0});
        if (world.filters()) camera.ray.scaleDifferentials(differentialScale);
        worker.rays[n] = &worker.cameraRays[n].ray;
      }
    const auto count = static_cast<std::size_t>(n);
    integrator.look(world, {worker.rays.data(), count}, pixels.width(),
                    {worker.hits.data(), count});
    for (int i = 0; i < n; ++i) {
      CameraRay& camera = worker.cameraRays[i];
      Hit& hit = worker.hits[i];
      Spectrum L(0);
      if (camera.weight > 0) {
        L = camera.weight *
            integrator.Li(world, camera.ray, hit, *worker.samplers[i], worker.scratch);
        worker.scratch.release();
        if (!isFinite(L)) {
          L = Spectrum(0);
          control.badSamples.fetch_add(1, std::memory_order_relaxed);
        }
      }
      const bool stores = film.stores(kOfSurface);
      const Point3 eye = camera.ray.o;
      if (world.bordersMedia() && (stores || isBlack(L))) passBorders(camera.ray, hit);
      // As in pbrt-v1: a sky that shines is no hole in the picture. Nor is the barrel of a lens.
      const bool hole = camera.weight > 0 && !hit.found() && isBlack(L);
      film.add(tile, worker.samples[i].film, L, hole ? 0 : 1);
      if (hit.found() && stores) {
        const Point2i pixel = pixels.lo + Point2i(i % pixels.width(), i / pixels.width());
        film.add(tile, pixel, index, firstSurface(eye, camera.ray, hit, worker.scratch));
        worker.scratch.release();
      }
    }
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
    prepare(world, film.resolution());
    tbb::parallel_for(
        tbb::blocked_range<int>(0, film.tiles(), 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int tile = range.begin(); tile < range.end() && !control.stop; ++tile)
            job.render(tile, workers.local());
        },
        tbb::simple_partitioner());
  });
  // oneTBB has ordered the tiles before what follows; this read says so to ThreadSanitizer, which
  // does not see into it.
  static_cast<void>(control.tilesDone.load());
}

}  // namespace pbrt
