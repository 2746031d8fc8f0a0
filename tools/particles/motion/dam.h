#pragma once
// A column of water that breaks down in a tank of glass.

#include "tools/particles/motion/drops.h"
#include "tools/particles/motion/water.h"

namespace pbrt::motion {

class Dam final : public Endless {
 public:
  Dam(int atoms, double fps);

  Bounds3 bounds() const override;
  Water& water() { return water_; }

 private:
  void frameAfter(int step, Fluid& out) override;
  Water fill() const;

  int atoms_;
  float spacing_;
  Water water_;
  int steps_ = 0;  // that the water has gone
};

}  // namespace pbrt::motion
