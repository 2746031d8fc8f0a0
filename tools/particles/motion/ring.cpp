// A ring of drops that go round, rise and fall, and touch now the one neighbour, now the other.

#include <numbers>

#include "tools/particles/motion/drops.h"

namespace pbrt::motion {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kOrbit = 8, kTouch = 3, kWave = 4;  // seconds
constexpr int kDrops = 12;
constexpr double kRadius = 0.38, kDropRadius = 0.07;
constexpr double kSwing = 0.11;  // radians
constexpr double kRise = 0.06;

class Ring final : public Endless {
 public:
  Ring(int atoms, double fps) : Endless(fps) {
    for (int k = 0; k < kDrops; ++k)
      drops_.push_back(ball(static_cast<std::size_t>((atoms + k) / kDrops)));
    spacing_ = kDropRadius / ballRadius(drops_.back().size());
  }

  Bounds3 bounds() const override {
    return {Point3(-0.5F, -0.16F, -0.5F), Point3(0.5F, 0.16F, 0.5F)};
  }

 private:
  void frameAfter(int step, Fluid& out) override {
    // The seconds after which all is as before; the phases so stay exact.
    const Varying t = at(std::fmod(step * dt(), 24));
    for (int k = 0; k < kDrops; ++k) {
      const double rest = kTurn * k / kDrops;
      const double swing = k % 2 == 0 ? kSwing : -kSwing;
      const Varying angle = rest + t * (kTurn / kOrbit) + swing * sin(t * (kTurn / kTouch));
      const Varying c = cos(angle), s = sin(angle);
      const Varying rise = kRise * sin(3 * rest + t * (kTurn / kWave));
      place(
          drops_[k],
          {{kRadius * c, rise, kRadius * s},
           {{{spacing_ * c, 0, spacing_ * s}, {0, spacing_, 0}, {-spacing_ * s, 0, spacing_ * c}}}},
          static_cast<float>(spacing_), out);
    }
  }

  std::vector<std::vector<DVec3>> drops_;
  double spacing_ = 1;
};

}  // namespace

std::unique_ptr<Motion> makeRing(int atoms, double fps) {
  return std::make_unique<Ring>(atoms, fps);
}

}  // namespace pbrt::motion
