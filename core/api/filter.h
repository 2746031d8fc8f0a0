#pragma once
// Reconstruction filters.

#include "core/base/math.h"

namespace pbrt {

class Filter {
 public:
  struct Setup {};

  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;
  virtual ~Filter();

  // The weight of a sample that lies p pixels off the pixel's centre; zero beyond radius().
  // Even in x and in y. Its scale is free: the film divides by the sum of weights.
  virtual float evaluate(Vec2 p) const = 0;
  Vec2 radius() const { return radius_; }

 protected:
  explicit Filter(Vec2 radius) : radius_(radius) {}

 private:
  Vec2 radius_;
};

}  // namespace pbrt
