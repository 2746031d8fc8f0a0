#pragma once
// What surfels look like: a coloured, shiny skin under a key light and a sky. Linear light.

#include <optional>
#include <span>

#include "shapes/metaballs/surfels/draw.h"
#include "view.h"

namespace pbrt {

struct Look {
  Vec3 color{0.03F, 0.25F, 0.45F};  // of the skin, where light leaves it
  Vec3 sky{0.75F, 0.85F, 1};  // from the top of the picture: lights the skin, and is seen behind it
  Vec3 ground{0.16F, 0.16F, 0.17F};
  std::optional<Vec3> background;  // one colour that is seen behind the skin, in place of the sky
};

class Shader {
 public:
  Shader(const Look& look, const PinholeCamera& camera);

  // What the pixels of a row see from `x` on, y below: sets as many values of each of out[0..2],
  // the red, green and blue of the first pixel.
  void shade(int x, int y, std::span<const surfels::Fragment> seen, float* const out[3]) const;

 private:
  PinholeCamera camera_;
  Vec3 toKey_;
  // What comes from a direction: the horizon's light, and more of the sky's as it rises. The same
  // of what is behind the skin.
  Vec3 color_, horizon_, rise_, horizonBehind_, riseBehind_;
};

}  // namespace pbrt
