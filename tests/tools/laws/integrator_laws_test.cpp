// Every law of integrators finds the integrator that breaks it.

#include <atomic>

#include "core/scene/render.h"
#include "tests/tools/laws/flawed.h"

namespace pbrt::test {
namespace {

enum Kind {
  kGood,
  kNoNumber,
  kNegative,
  kLightOfItsOwn,
  kCountsCalls,
  kCountsObjects,
  kAllocates,
  // Of those that fill the film themselves:
  kCountsThreads,
  kForgetsPasses,
  kMovesWithCrop,
  kIgnoresSeed,
  kOneNumberForAll
};

// How far surfaces face the camera, but for what is wrong with it.
template <Kind kind>
class Facing final : public SamplingIntegrator {
 public:
  explicit Facing(Params&) {
    static float objects = 0;
    if (kind == kCountsObjects) shown_ = ++objects;
  }
  bool usesLights() const override { return kind == kLightOfItsOwn; }

  Spectrum Li(const World& world, const RayDifferential& ray, const Hit& hit, Sampler& sampler,
              Scratch&) const override {
    const float u = sampler.get1D();
    if (!hit.found()) return Spectrum(0);
    if (kind == kNoNumber && u < 0.001F) return Spectrum(std::numeric_limits<float>::quiet_NaN());
    if (kind == kNegative && u < 0.001F) return Spectrum(0, -1, 0);
    if (kind == kAllocates) ::operator delete(::operator new(16));
    const float count = kind == kCountsCalls ? static_cast<float>(++calls_ % 7) : 0;
    const SurfaceInteraction at = world.surface(ray, hit);
    return Spectrum(shown_ * std::abs(glm::dot(at.ns, at.wo)) + count);
  }

 private:
  float shown_ = 1;
  mutable std::atomic<int> calls_ = 0;
};

// Noise: the first number of each sample, but for what is wrong with it.
template <Kind kind>
class Noise final : public Integrator {
 public:
  explicit Noise(Params&) {}
  bool usesLights() const override { return false; }

  void render(const World&, const Sampler& prototype, Film& film,
              RenderControl& control) const override {
    const auto sampler = prototype.clone();
    sampler->start({0, 0}, 0);
    const float one = sampler->get1D();
    for (int tile = 0; tile < film.tiles(); ++tile) {
      const Bounds2i pixels = film.tilePixels(tile);
      for (std::uint32_t s = control.firstSample; s < control.endSample; ++s)
        for (int y = pixels.lo.y; y < pixels.hi.y; ++y)
          for (int x = pixels.lo.x; x < pixels.hi.x; ++x) {
            const Point2i at =
                kind == kMovesWithCrop ? Point2i(x, y) - film.crop().lo : Point2i(x, y);
            sampler->start(at, kind == kForgetsPasses ? s - control.firstSample : s);
            const Point2 p = Point2(x, y) + 0.5F;
            float u = sampler->get1D();
            if (kind == kCountsThreads) u += static_cast<float>(control.threads);
            if (kind == kIgnoresSeed) u = p.x;
            if (kind == kOneNumberForAll) u = one;
            film.add(tile, p, Spectrum(u), 1);
          }
    }
  }
};

// Clear air that brightens what is behind it.
class Brightening final : public VolumeIntegrator {
 public:
  Brightening(Params&, const Setup& setup) : VolumeIntegrator(setup) {}
  Spectrum through(const World&, const Ray&, const Hit&, const Spectrum& L,
                   Sampler&) const override {
    return 1.5F * L;
  }
  Spectrum transmittance(const World&, const Ray&, float) const override { return Spectrum(1.5F); }
};

template <Kind kind>
const PluginInfo* plugin() {
  if constexpr (kind >= kCountsThreads)
    return &own<Integrator, Noise<kind>>();
  else
    return &own<Integrator, Facing<kind>>();
}

TEST(IntegratorLaws, AreObeyedByGoodOnes) {
  expectGood({&own<Integrator, Facing<kGood>>()});
  expectGood({&own<Integrator, Noise<kGood>>()});
}

TEST(IntegratorLaws, FindEveryFlaw) {
  expectFound(PluginKind::integrator,
              {
                  {plugin<kNoNumber>(), "finite", "a ball under a point light: Li of sample"},
                  {plugin<kNegative>(), "finite", "is (0, -1, 0); ray o"},
                  {plugin<kLightOfItsOwn>(), "black-without-light", "usesLights() says"},
                  {plugin<kCountsCalls>(), "repeatable", "in the same render again"},
                  {plugin<kCountsObjects>(), "repeatable", "by another object"},
                  {plugin<kCountsCalls>(), "thread-safe", "in 4 threads"},
                  {plugin<kCountsThreads>(), "thread-safe", "in 4 threads"},
                  {plugin<kForgetsPasses>(), "samples-add-up", "and then 2 and 3"},
                  {plugin<kMovesWithCrop>(), "crop-is-a-part", "in a crop"},
                  {plugin<kIgnoresSeed>(), "seeds-agree", "the same in every scene"},
                  {plugin<kOneNumberForAll>(), "seeds-agree", "of seeds 0 and 1 differ by"},
                  {plugin<kAllocates>(), "allocates-nothing", "0.50 times a sample"},
                  {&own<Integrator, Brightening>(), "transmittance-is-a-share", "is (1.5"},
              });
}

}  // namespace
}  // namespace pbrt::test
