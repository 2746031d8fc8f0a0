// A blob that parts into two halves and three droplets, which all meet again.

#include <numbers>

#include "tools/particles/motion/drops.h"

namespace pbrt::motion {
namespace {

constexpr double kPeriod = 4;  // seconds
constexpr double kRadius = 0.2;
constexpr double kDistance = 0.36;  // of a half from the middle, at most
// Where the droplets are then.
constexpr std::array<std::array<double, 3>, 3> kDroplets{
    {{-0.09, 0.02, 0}, {0.1, -0.03, 0.02}, {0.01, 0.16, -0.03}}};

class Split final : public Endless {
 public:
  Split(int atoms, double fps)
      : Endless(fps),
        droplet_(ball(static_cast<std::size_t>(std::max(1, atoms / 75)))),
        left_(ball((static_cast<std::size_t>(atoms) - 3 * droplet_.size()) / 2)),
        right_(ball(static_cast<std::size_t>(atoms) - 3 * droplet_.size() - left_.size())),
        spacing_(kRadius / ballRadius(left_.size() + right_.size())) {
    // Its mirror image, so that the two share few places.
    for (DVec3& p : right_) p = -p;
  }

  Bounds3 bounds() const override {
    return {Point3(-0.57F, -0.23F, -0.23F), Point3(0.57F, 0.23F, 0.23F)};
  }

 private:
  void frameAfter(int step, Fluid& out) override {
    // From 0, when all is one, to 1, when all is apart.
    const Varying apart =
        0.5 - 0.5 * cos(at(std::fmod(step * dt(), kPeriod)) * (2 * std::numbers::pi / kPeriod));
    // A half fills the volume of all at first, and its own at last; in between it is pulled long.
    const Varying swell = std::cbrt(2.) + apart * (1 - std::cbrt(2.));
    const Varying stretch = 1 + 1.6 * apart * (1 - apart);
    const Varying along = spacing_ * swell * stretch, across = spacing_ * swell / sqrt(stretch);
    const auto spacing = static_cast<float>(spacing_);
    for (const double side : {-1., 1.})
      place(side < 0 ? left_ : right_,
            {{side * kDistance * apart, 0, 0}, {{{along, 0, 0}, {0, across, 0}, {0, 0, across}}}},
            spacing, out);
    for (const auto& [x, y, z] : kDroplets)
      place(droplet_,
            {{x * apart, y * apart, z * apart},
             {{{spacing_, 0, 0}, {0, spacing_, 0}, {0, 0, spacing_}}}},
            spacing, out);
  }

  std::vector<DVec3> droplet_, left_, right_;
  double spacing_;
};

}  // namespace

std::unique_ptr<Motion> makeSplit(int atoms, double fps) {
  return std::make_unique<Split>(atoms, fps);
}

}  // namespace pbrt::motion
