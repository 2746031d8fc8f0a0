#include "animation.h"

#include "core/base/parallel.h"
#include "shapes/metaballs/surfels/coverage.h"
#include "tools/converge/clock.h"

namespace pbrt {

namespace {

constexpr int kBlock = 32;  // pixels a side

}  // namespace

Animation::Animation(motion::Motion& motion, const PinholeCamera& camera, const Look& look,
                     Point2i size, const surfels::Simulation::Settings& settings, int settle)
    : motion_(motion),
      camera_(camera),
      shader_(look, camera),
      size_(size),
      settle_(settle),
      simulation_(settings) {
  std::vector<Ray> rays;
  std::size_t first = 0;
  for (int y = 0; y < size.y; y += kBlock)
    for (int x = 0; x < size.x; x += kBlock) {
      const Bounds2i pixels{{x, y}, glm::min(Point2i(x, y) + kBlock, size)};
      rays.clear();
      for (int j = pixels.lo.y; j < pixels.hi.y; ++j)
        for (int i = pixels.lo.x; i < pixels.hi.x; ++i) rays.push_back(camera.ray(i, j));
      blocks_.push_back({pixels, surfels::Beam(rays, pixels.width()), first});
      first += rays.size();
    }
  seen_.resize(first);
}

void Animation::shade(bool allChannels, Image& image) const {
  image.window = {Point2i(0), size_};
  image.resolution = size_;
  image.names = {"R", "G", "B"};
  if (allChannels) image.names.insert(image.names.end(), {"A", "Z", "N.X", "N.Y", "N.Z"});
  image.channels.resize(image.names.size());
  for (std::vector<float>& channel : image.channels) channel.resize(seen_.size());
  parallelFor(blocks_.size(), [&](std::size_t b) {
    const Block& block = blocks_[b];
    const auto width = static_cast<std::size_t>(block.pixels.width());
    std::span<const surfels::Fragment> seen(&seen_[block.first], block.rays());
    for (int y = block.pixels.lo.y; y < block.pixels.hi.y; ++y, seen = seen.subspan(width)) {
      const int x = block.pixels.lo.x;
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + x;
      float* const rgb[] = {&image.channels[0][at], &image.channels[1][at], &image.channels[2][at]};
      shader_.shade(x, y, seen.first(width), rgb);
      if (!allChannels) continue;
      for (std::size_t i = 0; i < width; ++i) {
        const surfels::Fragment& f = seen[i];
        const bool met = f.t < kInfinity;
        const float values[] = {met ? 1.F : 0.F, met ? f.t : 0, f.n.x, f.n.y, f.n.z};
        for (std::size_t c = 0; c < 5; ++c) image.channels[3 + c][at + i] = values[c];
      }
    }
  });
}

FrameFigures Animation::make(int number, bool allChannels, Image* image) {
  FrameFigures figures;
  figures.frame = number;
  const auto timed = [](double& milliseconds, auto stage) {
    const Clock clock;
    stage();
    milliseconds = 1e3 * clock.seconds();
  };
  timed(figures.motion, [&] { motion_.frame(number, fluid_); });
  const bool begins = simulation_.surfels().empty();
  const Clock clock;
  timed(figures.field, [&] { field_.set(fluid_.kernel, fluid_.atoms, fluid_.velocities); });
  timed(figures.step, [&] { simulation_.step(field_, begins ? 0 : motion_.dt()); });
  if (begins)
    // Each time anew: a field shows the places that it found when it was set.
    for (int i = 0; i < settle_; ++i) {
      field_.set(fluid_.kernel, fluid_.atoms, fluid_.velocities);
      simulation_.step(field_, 0);
    }
  if (image) {
    timed(figures.discs, [&] { discs_.set(surfels(), camera_.eye()); });
    timed(figures.draw, [&] {
      parallelFor(blocks_.size(), [&](std::size_t b) {
        const Block& block = blocks_[b];
        discs_.draw(block.beam, {&seen_[block.first], block.rays()});
      });
    });
    timed(figures.shade, [&] { shade(allChannels, *image); });
  }
  figures.cpu = 1e3 * clock.cpuSeconds();

  figures.atoms = fluid_.atoms.size();
  figures.surfels = surfels().size();
  figures.report = simulation_.report();
  constexpr std::size_t kPlaces = 256;  // of the surface, others in each frame
  const std::vector<surfels::Place> places =
      surfels::places(field_, kPlaces * static_cast<std::uint64_t>(number), kPlaces);
  if (!places.empty())
    figures.coverage = surfels::coverage(surfels(), places, figures.report.reach).covered;
  return figures;
}

}  // namespace pbrt
