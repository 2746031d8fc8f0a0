// Every law of filters finds the filter that breaks it.

#include <atomic>

#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum Kind {
  kGood,
  kLopsided,
  kLeaks,
  kHollow,
  kSteps,
  kSpike,
  kNeedle,
  kUnchecked,
  kFixed,
  kCountsObjects,
  kCountsCalls,
  kAllocates
};

// A cone, but for what is wrong with it.
template <Kind kind>
class Cone final : public Filter {
 public:
  explicit Cone(Params& p) : Filter(kind == kFixed ? (width(p), Vec2(2)) : width(p)) {
    if (kind == kUnchecked || kind == kGood) {
      power_ = p.number("power", 1, "how steep it is");
      if (kind == kGood && !(power_ >= 1 && power_ <= 100)) p.fail("power", "must be 1 to 100");
    }
    static float objects = 0;
    if (kind == kCountsObjects) power_ = ++objects;
  }

  float evaluate(Vec2 p) const override {
    if (kind == kAllocates) ::operator delete(::operator new(16));
    const float r = glm::length(p / radius());
    if (kind == kLeaks && r < 1.1F) return 1.1F - r;
    if (kind == kSpike) return r < 0.01F ? 1 : 0;
    if (kind == kNeedle) return r > 1 ? 0 : r < 0.03F ? 100 : 1 - r;
    if (!(r < 1)) return 0;
    if (kind == kSteps) return 1;
    if (kind == kHollow) return r;
    if (kind == kLopsided && p.x > 0) return 0.9F * (1 - r);
    if (kind == kCountsCalls) return 1 - r + 1e-6F * static_cast<float>(++calls_ % 7);
    return std::pow(1 - r, power_);
  }

 private:
  static Vec2 width(Params& p) {
    return {p.positive("xwidth", 2, "half its width", "pixels"),
            p.positive("ywidth", 2, "half its height", "pixels")};
  }

  float power_ = 1;
  mutable std::atomic<int> calls_ = 0;
};

template <Kind kind>
const PluginInfo* plugin() {
  return &own<Filter, Cone<kind>>();
}

TEST(FilterLaws, AreObeyedByACone) {
  expectGood({plugin<kGood>()});
}

TEST(FilterLaws, FindEveryFlaw) {
  expectFound(PluginKind::filter,
              {
                  {plugin<kLopsided>(), "even", "but at"},
                  {plugin<kLeaks>(), "zero-beyond-radius", "beyond the radius"},
                  {plugin<kHollow>(), "peaks-at-centre", "at the centre only 0"},
                  {plugin<kSteps>(), "continuous", "jumps from 0 at (-2, 0) to 1"},
                  {plugin<kNeedle>(), "smooth-for-the-film", "by the film's table"},
                  {plugin<kSpike>(), "even-light-stays-even", "gives no sample any weight"},
                  {plugin<kUnchecked>(), "extremes", "\"float power\""},
                  {plugin<kFixed>(), "widths", "its radius() is (2, 2)"},
                  {plugin<kCountsCalls>(), "repeatable", "asked again"},
                  {plugin<kCountsObjects>(), "twins", "another object"},
                  {plugin<kCountsCalls>(), "thread-safe", "other threads"},
                  {plugin<kAllocates>(), "allocates-nothing", "operator new"},
              });
}

}  // namespace
}  // namespace pbrt::test
