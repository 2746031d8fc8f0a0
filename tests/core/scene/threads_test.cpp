// As many threads render as are asked for, neither more nor fewer.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/scenes.h"

namespace pbrt {
namespace {

// Counts who is inside at once. They wait for so many, but not for ever.
class Gathering : public SamplingIntegrator {
 public:
  explicit Gathering(int wanted) : wanted_(wanted) {}
  int most() const { return most_; }

  Spectrum Li(const World&, const RayDifferential&, const Hit&, Sampler&, Scratch&) const override {
    const int here = ++inside_;
    for (int seen = most_; seen < here && !most_.compare_exchange_weak(seen, here);) {
    }
    while (most_ < wanted_ && std::chrono::steady_clock::now() < patience_)
      std::this_thread::yield();
    --inside_;
    return Spectrum(0);
  }

 private:
  int wanted_;
  std::chrono::steady_clock::time_point patience_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(10);
  mutable std::atomic<int> inside_ = 0, most_ = 0;
};

TEST(Threads, RenderAsManyAsAreAskedFor) {
  const auto scene = test::buildText(
      "Film \"image\" \"integer xresolution\" 320 \"integer yresolution\" 320\n"
      "PixelFilter \"box\" Integrator \"whitted\" WorldBegin WorldEnd");
  for (const int n : {1, 2, 3, 7, 20}) {
    const Gathering gathering(n);
    RenderControl control;
    control.threads = n;
    gathering.render(*scene, scene->sampler(), scene->film(), control);
    EXPECT_EQ(gathering.most(), n);
  }
}

}  // namespace
}  // namespace pbrt
