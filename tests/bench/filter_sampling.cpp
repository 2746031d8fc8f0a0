// Two ways to filter: a sample counts in all pixels that the filter reaches from it, as the film
// has it; or each pixel has samples of its own, placed by the filter (Ernst et al. 2006, "Filter
// Importance Sampling"). Prints the variance of a pixel between seeds at equal samples, means over
// the picture, and what neighbours' errors have in common.

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/render.h"
#include "core/scene/scene.h"
#include "tests/support.h"
#include "tools/converge/variant.h"

namespace pbrt {
namespace {

constexpr int kSamples = 16, kSeeds = 6, kWidth = 48;

struct Picture {
  Point2i size{};
  std::vector<double> values;
};

Variant build(const std::string& scene, const std::string& statements) {
  BuildOptions options;
  options.width = kWidth;
  return buildVariant(PBRT_SOURCE_DIR "/scenes/" + scene + ".pbrt", {"", statements},
                      test::loader(), options);
}

// Draws one coordinate in proportion to the magnitude of the filter along an axis.
class AxisSampler {
 public:
  AxisSampler(const Filter& filter, int axis) : radius_(filter.radius()[axis]) {
    for (int i = 0; i < kCells; ++i) {
      Vec2 p(0);
      p[axis] = ((static_cast<float>(i) + 0.5F) / kCells * 2 - 1) * radius_;
      weight_.push_back(filter.evaluate(p));
      sum_.push_back((i ? sum_.back() : 0) + std::abs(weight_.back()));
    }
  }
  // Where, and 1 or -1, the sign of the filter there.
  std::pair<float, float> sample(float u) const {
    const double at = u * sum_.back();
    auto cell = static_cast<std::size_t>(std::ranges::upper_bound(sum_, at) - sum_.begin());
    cell = std::min<std::size_t>(cell, kCells - 1);
    const double before = cell ? sum_[cell - 1] : 0;
    const double part = (at - before) / (sum_[cell] - before);
    return {static_cast<float>((static_cast<double>(cell) + part) / kCells * 2 - 1) * radius_,
            weight_[cell] < 0 ? -1.F : 1.F};
  }

 private:
  static constexpr int kCells = 1024;
  float radius_;
  std::vector<float> weight_;
  std::vector<double> sum_;
};

Picture spread(const std::string& name, const std::string& statements, std::uint64_t seed) {
  const Variant variant = build(name, statements);
  Scene& scene = *variant.scene;
  RenderControl control;
  control.endSample = kSamples;
  scene.integrator().render(scene, *scene.makeSampler(seed, kSamples), scene.film(), control);
  const Image image = scene.film().image();
  const auto& g = *image.channel("G");
  return {{image.window.width(), image.window.height()}, {g.begin(), g.end()}};
}

Picture placed(const std::string& name, const std::string& statements, const Filter& filter,
               std::uint64_t seed) {
  const Variant variant = build(name, statements);
  const Scene& scene = *variant.scene;
  const auto& integrator = dynamic_cast<const SamplingIntegrator&>(scene.integrator());
  const auto sampler = scene.makeSampler(seed, kSamples);
  const AxisSampler axisX(filter, 0), axisY(filter, 1);
  Scratch scratch;
  const Bounds2i& crop = variant.scene->film().crop();
  Picture picture{{crop.width(), crop.height()}, {}};
  for (int y = crop.lo.y; y < crop.hi.y; ++y)
    for (int x = crop.lo.x; x < crop.hi.x; ++x) {
      double sum = 0, weights = 0;
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        sampler->start({x, y}, i);
        const Point2 u = sampler->pixel2D();
        const auto [dx, signX] = axisX.sample(u.x);
        const auto [dy, signY] = axisY.sample(u.y);
        CameraSample at;
        at.film = Point2(x, y) + 0.5F + Point2(dx, dy);
        if (scene.camera().usesLens()) at.lens = sampler->get2D();
        const CameraRay ray = scene.camera().generate(at, scene.filters());
        const Hit hit = scene.intersect(ray.ray);
        const double w = signX * signY;
        sum += w * (ray.weight * integrator.Li(scene, ray.ray, hit, *sampler, scratch)).y;
        weights += w;
        scratch.release();
      }
      picture.values.push_back(sum / weights);
    }
  return picture;
}

// Of pictures that differ by noise alone: the mean variance of the mean of size x size pixels.
double variance(const std::vector<Picture>& pictures, int size) {
  const Point2i whole = pictures[0].size;
  double sum = 0;
  int count = 0;
  for (int y = 0; y + size <= whole.y; y += size)
    for (int x = 0; x + size <= whole.x; x += size, ++count) {
      double mean = 0, squares = 0;
      for (const Picture& p : pictures) {
        double v = 0;
        for (int j = 0; j < size; ++j)
          for (int i = 0; i < size; ++i)
            v += p.values[static_cast<std::size_t>((y + j) * whole.x + x + i)] / (size * size);
        mean += v / kSeeds;
        squares += v * v / kSeeds;
      }
      sum += (squares - mean * mean) * kSeeds / (kSeeds - 1);
    }
  return sum / count;
}

void compare() {
  fmt::print("variance of a pixel, and of the mean of 4 x 4, with {} samples a pixel\n", kSamples);
  fmt::print("{:8} {:15} {:9} {:>9} {:>9} {:>6} {:>11} {:>11} {:>6}\n", "scene", "sampler",
             "filter", "spread", "placed", "ratio", "4x4 spread", "4x4 placed", "ratio");
  for (const std::string scene : {"cornell", "spheres"})
    for (const std::string sampler : {"random", "lowdiscrepancy", "zsobol"})
      for (const std::string filter : {"box", "triangle", "gaussian", "mitchell"}) {
        const std::string statements =
            fmt::format("Sampler \"{}\" PixelFilter \"{}\" Integrator \"path\"", sampler, filter);
        const auto kernel = test::make<Filter>(filter);
        std::vector<Picture> a, b;
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
          a.push_back(spread(scene, statements, seed));
          b.push_back(placed(scene, statements, *kernel, seed));
        }
        const double pixelA = variance(a, 1), pixelB = variance(b, 1);
        const double blockA = variance(a, 4), blockB = variance(b, 4);
        fmt::print("{:8} {:15} {:9} {:9.3g} {:9.3g} {:6.2f} {:11.3g} {:11.3g} {:6.2f}\n", scene,
                   sampler, filter, pixelA, pixelB, pixelB / pixelA, blockA, blockB,
                   blockB / blockA);
        std::fflush(stdout);
      }
}

}  // namespace
}  // namespace pbrt

int main() {
  pbrt::compare();
}
