#pragma once
// Fields with a surface known in closed form, for the tests of surfels.

#include <vector>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "shapes/metaballs/surfels/moving_field.h"

namespace pbrt::surfels::test {

// The union of balls: f = steepness (1 - |x - c|^2 / r^2) of the ball in which that is greatest.
class Balls final : public MovingField {
 public:
  struct Ball {
    DPoint3 c{};
    double r = 1;
    DVec3 velocity{}, spin{};  // of the centre; about it, radians per time
  };

  explicit Balls(std::vector<Ball> balls, double steepness = 1)
      : balls_(std::move(balls)), steepness_(steepness) {}

  Bounds3 bounds() const override {
    Bounds3 b;
    for (const Ball& ball : balls_) b.add(roundOutward(ball.c - ball.r, ball.c + ball.r));
    return b;
  }
  double grain() const override {
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls_) least = std::min(least, ball.r);
    return least;
  }
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      FieldAt& a = out[i] = {.value = -std::numeric_limits<double>::infinity()};
      for (const Ball& b : balls_) {
        const DVec3 x = points[i] - b.c;
        const double f = steepness_ * (1 - lengthSquared(x / b.r));
        if (f <= a.value) continue;
        a.value = f, a.gradient = -2 * steepness_ / b.r * (x / b.r);
        a.flow = b.velocity + glm::cross(b.spin, x);
      }
    }
  }
  void shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      FieldAt a;
      at({&points[i], 1}, {&a, 1});
      const double r = balls_[nearest(points[i])].r;
      out[i] = {a.gradient, glm::dmat3(-2 * steepness_ / r / r)};
    }
  }
  bool seeds(std::uint64_t first, std::span<DPoint3> out) const override {
    double area = 0;
    for (const Ball& b : balls_) area += b.r * b.r;
    for (std::size_t i = 0; i < out.size(); ++i) {
      Rng rng(hash(first + i));
      double share = rng.uniform() * area;
      const Ball* ball = balls_.data();
      while (share > ball->r * ball->r && ball < &balls_.back()) share -= ball->r * ball->r, ++ball;
      const float u = rng.uniform(), v = rng.uniform();
      out[i] = ball->c + ball->r * DVec3(uniformSphere({u, v}));
    }
    return !balls_.empty();
  }

  // The ball of whose surface a point is.
  std::size_t nearest(const DPoint3& p) const {
    const auto f = [&](const Ball& b) { return lengthSquared((p - b.c) / b.r); };
    return std::min_element(balls_.begin(), balls_.end(),
                            [&](const Ball& a, const Ball& b) { return f(a) < f(b); }) -
           balls_.begin();
  }
  // A place on the surface, uniform in area.
  DPoint3 place(std::uint64_t number) const {
    DPoint3 p{};
    for (std::uint64_t i = 0;; ++i) {
      seeds(hash(number, i, 77), {&p, 1});
      FieldAt a;
      at({&p, 1}, {&a, 1});
      if (std::abs(a.value) < 1e-5 * steepness_) return p;
    }
  }

 private:
  std::vector<Ball> balls_;
  double steepness_;
};

}  // namespace pbrt::surfels::test
