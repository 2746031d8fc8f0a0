// Mitchell's best-candidate pattern: points that keep their distance from one another, without
// the regularity of a grid (Mitchell 1991, "Spectrally Optimal Sampling for Distribution Ray
// Tracing"). pbrt-v1 tiles the picture with one pattern of 4096 points; here every pixel gets its
// own first points of a pattern, shifted at random on the torus: any first points of such a
// pattern are well spread, and every pixel has the same number.

#include <vector>

#include "core/plugin/sampler_params.h"

namespace pbrt {
namespace {

using Pattern = std::vector<Point2>;

constexpr std::uint32_t kPoints = 1024;

// Every point is the one of many random candidates that is farthest from all points before it, on
// the torus. A grid of cells holds the distance to the nearest point, so that a candidate costs
// one look. The cells nearer to the new point than to any other are a convex polygon about it:
// rings of cells around it are updated until one needs no change.
Pattern makePattern() {
  constexpr int cells = 256;
  const auto cellOf = [](int x, int y) { return (y & (cells - 1)) * cells + (x & (cells - 1)); };
  std::vector<int> distance2(cells * cells, std::numeric_limits<int>::max());
  Pattern pattern;
  pattern.reserve(kPoints);
  Rng rng(0);
  for (std::uint32_t n = 0; n < kPoints; ++n) {
    std::uint32_t best = rng.uniform(cells * cells);
    for (std::uint32_t candidates = std::min(8 * n, 512U); candidates > 1; --candidates) {
      const std::uint32_t cell = rng.uniform(cells * cells);
      if (distance2[cell] > distance2[best]) best = cell;
    }
    const int x = static_cast<int>(best) % cells, y = static_cast<int>(best) / cells;
    const float jitterX = rng.uniform(), jitterY = rng.uniform();
    pattern.push_back(glm::min((Point2(x, y) + Point2(jitterX, jitterY)) / float{cells},
                               Point2(kOneMinusEpsilon)));
    bool changed = true;
    const auto update = [&](int dx, int dy) {
      int& d2 = distance2[cellOf(x + dx, y + dy)];
      if (dx * dx + dy * dy >= d2) return;
      d2 = dx * dx + dy * dy;
      changed = true;
    };
    for (int r = 0; r <= cells / 2 && changed; ++r) {
      changed = false;
      for (int t = -r; t < std::max(r, 1); ++t) {
        update(t, -r);
        update(r, t);
        update(-t, r);
        update(-r, -t);
      }
    }
  }
  return pattern;
}

// Element i of the pattern, moved by a shift in [0, 1)^2 on the torus. Beyond its end it goes on
// with copies of itself that are shifted otherwise.
Point2 shifted(const Pattern& pattern, std::uint32_t i, Point2 shift) {
  Point2 p = pattern[i % kPoints] + shift;
  if (i >= kPoints) p += uniformPoint(hash(i / kPoints));
  return {p.x - static_cast<float>(static_cast<int>(p.x)),
          p.y - static_cast<float>(static_cast<int>(p.y))};
}

class BestCandidateSampler final : public Sampler {
 public:
  BestCandidateSampler(Params& p, const Setup& setup)
      : Sampler(sampleCount(p, setup, 4)),
        keys_(samplerSeed(p, setup)),
        pattern_(p.describing() ? nullptr : std::make_shared<const Pattern>(makePattern())),
        count_(static_cast<std::uint32_t>(samplesPerPixel())),
        inverseCount_(1.F / static_cast<float>(count_)) {}

  std::unique_ptr<Sampler> clone() const override {
    return std::make_unique<BestCandidateSampler>(*this);
  }

  void start(Point2i pixel, std::uint32_t index) override {
    keys_.start(pixel, index);
    round_ = index / count_ * 0xd1342543de82ef95ULL;
    index_ = index % count_;
  }

  // The pattern in its own order: also a part of the samples is well spread.
  Point2 pixel2D() override {
    keys_.nextDimension();
    return shifted(*pattern_, index_, uniformPoint(keys_.pixel() ^ round_));
  }

  // Stratified: in one dimension nothing is better spread.
  float get1D() override {
    keys_.nextDimension();
    const std::uint32_t stratum = permute(index_, count_, keys_.pixel() ^ round_);
    const float offset = uniformPoint(keys_.sample()).x;
    return std::min((static_cast<float>(stratum) + offset) * inverseCount_, kOneMinusEpsilon);
  }

  // The same points in another order, so that dimensions are independent, and shifted otherwise.
  Point2 get2D() override {
    keys_.nextDimension();
    const std::uint64_t key = keys_.pixel() ^ round_;
    return shifted(*pattern_, permute(index_, count_, key), uniformPoint(mixBits(key)));
  }

  // One point in each cell of a grid for the set; in every cell the samples follow the pattern.
  void get2D(std::span<Point2> points) override {
    if (points.empty()) return;
    const auto count = static_cast<std::uint32_t>(points.size());
    const Strata set(squarest(count));
    const std::uint64_t order = mixBits(keys_.sample());
    for (std::uint32_t i = 0; i < count; ++i)
      points[permute(i, count, order)] = set.point(i, get2D());
  }

 private:
  SampleKeys keys_;
  std::shared_ptr<const Pattern> pattern_;
  std::uint32_t count_;
  float inverseCount_;
  std::uint64_t round_ = 0;  // bits that change shuffle and shift each time all points are used up
  std::uint32_t index_ = 0;
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Sampler, pbrt::BestCandidateSampler, "bestcandidate",
            "points that keep their distance from one another")
