// Every law of volumes finds the medium that breaks it.

#include <atomic>

#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum Kind {
  kGood,
  kNegative,
  kTurnsBack,
  kStays,
  kDense,
  kNotUniform,
  kGlowsInNothing,
  kCountsCalls,
  kCountsObjects,
  kAllocates
};

// A box of two cells of smoke, denser and denser along x, but for what is wrong with it.
template <Kind kind>
class Smoke final : public Medium {
 public:
  Smoke(Params& p, const Setup& setup)
      : Medium(kind == kStays ? Setup{} : setup, kind == kTurnsBack ? -1.5F : 0.3F, DPoint3(-1),
               DPoint3(1, 2, 1)) {
    const float scale = p.positive("scale", 1, "of the density");
    static float objects = 0;
    sigma_ = Spectrum(1, 0.5F, 2) * scale;
    if (kind == kCountsObjects) sigma_ *= ++objects;
    const bool uniform = kind == kNotUniform;
    const float most = kind == kDense ? 0.8F : 1;
    setCells({2, 1, 1}, {{0.5F * sigma_, uniform}, {most * sigma_, uniform}},
             kind != kGlowsInNothing);
    if (kind == kGlowsInNothing) setCells({2, 1, 1}, {{}, {most * sigma_, false}}, false);
  }

 private:
  MediumPoint properties(const DPoint3& p) const override {
    if (kind == kAllocates) ::operator delete(::operator new(16));
    auto density = static_cast<float>(sqr(0.5 + 0.5 * p.x));
    if (kind == kNegative) density -= 0.1F;
    if (kind == kCountsCalls) density *= 1 - 1e-6F * static_cast<float>(++calls_ % 7);
    if (kind == kGlowsInNothing && p.x < 0) return {Spectrum(0), Spectrum(0), Spectrum(1)};
    return MediumPoint{0.3F * sigma_, 0.7F * sigma_, Spectrum(0.2F)} * density;
  }

  Spectrum sigma_;
  mutable std::atomic<int> calls_ = 0;
};

template <Kind kind>
const PluginInfo* plugin() {
  return &own<Medium, Smoke<kind>>();
}

TEST(VolumeLaws, AreObeyedBySmoke) {
  expectGood({plugin<kGood>()});
}

TEST(VolumeLaws, FindEveryFlaw) {
  expectFound(PluginKind::volume,
              {
                  {plugin<kNegative>(), "well-formed", "its absorption is (-"},
                  {plugin<kTurnsBack>(), "well-formed", "g() is -1.5"},
                  {plugin<kStays>(), "moves-with-its-space", "where toRender takes this"},
                  {plugin<kDense>(), "cells-bound-the-medium", "more than the majorant"},
                  {plugin<kNotUniform>(), "cells-bound-the-medium", "says it is uniform"},
                  {plugin<kGlowsInNothing>(), "cells-bound-the-medium", "says that it is empty"},
                  {plugin<kNotUniform>(), "estimates-agree-with-quadrature", "by quadrature"},
                  {plugin<kDense>(), "estimates-agree-with-quadrature", "by quadrature"},
                  {plugin<kNotUniform>(), "transmittance-multiplies", "by quadrature"},
                  {plugin<kCountsCalls>(), "repeatable", "asked again"},
                  {plugin<kCountsObjects>(), "twins", "another object"},
                  {plugin<kCountsCalls>(), "thread-safe", "other threads"},
                  {plugin<kAllocates>(), "allocates-nothing", "operator new"},
              });
}

}  // namespace
}  // namespace pbrt::test
