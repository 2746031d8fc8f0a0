#pragma once
// Transforms that change between two ends of time: what motion blur shows.

#include <glm/gtc/quaternion.hpp>

#include "core/base/transform.h"

namespace pbrt {

// A transform at the start and at the end of a motion; how it gets there is left open.
struct TransformPair {
  Transform start, end;

  TransformPair() = default;
  TransformPair(const Transform& still) : start(still), end(still) {}  // NOLINT: a pair that rests
  TransformPair(const Transform& s, const Transform& e) : start(s), end(e) {}

  bool moves() const { return start.matrix() != end.matrix(); }
  TransformPair inverse() const { return {start.inverse(), end.inverse()}; }
  friend TransformPair operator*(const TransformPair& a, const TransformPair& b) {
    return {a.start * b.start, a.end * b.end};
  }
  friend bool operator==(const TransformPair& a, const TransformPair& b) {
    return a.start.matrix() == b.start.matrix() && a.end.matrix() == b.end.matrix();
  }
};

// When motions start and end, in the unit of the camera's shutter. Before and after, all rests.
struct MotionTimes {
  float start = 0, end = 1;  // start < end

  // How far the motion has come: 0 at its start, 1 at its end.
  float fraction(float time) const {
    return std::min(1.F, std::max(0.F, (time - start) / (end - start)));
  }
};

// The way between the two of a pair as pbrt defines it: each is split into a translation, a
// rotation and a stretch (Shoemake and Duff 1992, "Matrix Animation and Polar Decomposition"),
// M = T R S; T and S are blended linearly, R at even speed the short way round.
class AnimatedTransform {
 public:
  AnimatedTransform() = default;
  // Both invertible. Throws Error (without a place) if one of them mirrors and the other does not:
  // every way between them flattens space.
  explicit AnimatedTransform(const TransformPair& pair);

  bool moves() const { return moves_; }
  const TransformPair& ends() const { return ends_; }
  // At a fraction of the way; exactly the start from 0 down and the end from 1 up.
  Transform at(double fraction) const;

 private:
  struct Parts {
    DVec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};
    glm::dmat3 stretch{1};  // symmetric, and definite: positive, or negative in a mirrored space
  };
  static Parts decompose(const Transform& t);

  TransformPair ends_;
  bool moves_ = false;
  Parts start_, end_;  // if it moves
};

}  // namespace pbrt
