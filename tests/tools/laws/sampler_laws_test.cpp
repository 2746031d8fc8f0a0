// Every law of samplers finds the sampler that breaks it.

#include <atomic>

#include "core/plugin/sampler_params.h"
#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum Kind {
  kGood,
  kGoesOn,
  kForgetfulClone,
  kReachesOne,
  kHugeReachesOne,
  kOwnCount,
  kOneSeed,
  kAnyCount,
  kSkewed,
  kSkewedSets,
  kOneDimension,
  kPaired,
  kCounts,
  kSharedByClones,
  kAllocates
};

// Independent numbers, but for what is wrong with them.
template <Kind kind>
class Numbers final : public Sampler {
 public:
  Numbers(Params& p, const Setup& setup)
      : Sampler(kind == kOwnCount ? 4 : setup.samplesPerPixel.value_or(count(p))),
        keys_(kind == kOneSeed ? 0 : setup.seed),
        made_(kind == kCounts ? ++objects() : 0) {}

  std::unique_ptr<Sampler> clone() const override {
    auto clone = std::make_unique<Numbers>(*this);
    if (kind == kForgetfulClone) clone->keys_ = SampleKeys(99);
    if (kind == kSharedByClones) clone->made_ = ++objects();
    return clone;
  }
  void start(Point2i pixel, std::uint32_t index) override {
    if (kind == kAllocates) ::operator delete(::operator new(16));
    if (kind == kGoesOn && started_) return;
    started_ = true;
    keys_.start(kind == kPaired ? Point2i(pixel.x / 2, pixel.y) : pixel, index);
    if (made_ > 1)
      for (std::uint64_t i = 0; i < made_ % 8; ++i) keys_.nextDimension();
    if (kind == kOneDimension) keys_.nextDimension();
  }
  float get1D() override { return get2D().x; }
  Point2 get2D() override {
    if (kind != kOneDimension) keys_.nextDimension();
    Point2 p = uniformPoint(keys_.sample());
    if (kind == kReachesOne && p.x > 0.99F) p.x = 1;
    if (kind == kHugeReachesOne && samplesPerPixel() > 1000000) p.x = 1;
    if (kind == kSkewed) p.y *= p.y;
    return p;
  }
  void get2D(std::span<Point2> points) override {
    for (Point2& p : points) p = get2D() * (kind == kSkewedSets ? 0.9F : 1.F);
  }

 private:
  static std::atomic<std::uint64_t>& objects() {
    static std::atomic<std::uint64_t> made;
    return made;
  }
  static int count(Params& p) {
    if (kind != kAnyCount) return sampleCount(p, {}, 4);
    const int most = std::numeric_limits<int>::max();
    return std::max(1, p.integer("pixelsamples", 4, -most - 1, most, "samples per pixel"));
  }

  SampleKeys keys_;
  std::uint64_t made_;
  bool started_ = false;
};

template <Kind kind>
const PluginInfo* plugin() {
  return &own<Sampler, Numbers<kind>>();
}

TEST(SamplerLaws, AreObeyedByIndependentNumbers) {
  expectGood({plugin<kGood>(), {}, {.independentNumbers = true}});
}

TEST(SamplerLaws, FindEveryFlaw) {
  expectFound(PluginKind::sampler,
              {
                  {plugin<kGoesOn>(), "order-does-not-matter", "taken in another order"},
                  {plugin<kForgetfulClone>(), "order-does-not-matter", "by a clone"},
                  {plugin<kReachesOne>(), "below-one", "not in [0, 1)"},
                  {plugin<kOneDimension>(), "below-one", "differ"},
                  {plugin<kHugeReachesOne>(), "huge-counts", "not in [0, 1)"},
                  {plugin<kOwnCount>(), "huge-counts", "takes 4"},
                  {plugin<kOwnCount>(), "count-of-the-render", "takes 4"},
                  {plugin<kOneSeed>(), "seeds-differ", "the same numbers"},
                  {plugin<kAnyCount>(), "counts-from-one", "\"integer pixelsamples\" 0"},
                  {plugin<kReachesOne>(), "uniform", "not in [0, 1)"},
                  {plugin<kSkewed>(), "uniform", "standard deviations"},
                  {plugin<kSkewedSets>(), "sets-uniform", "point 0 of sets of 1"},
                  {plugin<kOneDimension>(), "independent", "points 0 and 1"},
                  {plugin<kPaired>(), "independent", "of the next"},
                  {plugin<kOneDimension>(), "not-aligned", "repeats the pattern"},
                  {plugin<kGood>(), "well-spread", "times that of independent points"},
                  {plugin<kGood>(), "sets-well-spread", "times that of independent points"},
                  {plugin<kCounts>(), "twins", "another object"},
                  {plugin<kSharedByClones>(), "thread-safe", "other threads"},
                  {plugin<kAllocates>(), "allocates-nothing", "operator new"},
              });
}

}  // namespace
}  // namespace pbrt::test
