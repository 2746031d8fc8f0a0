#pragma once
// Makes frames: a fluid moves, surfels follow its surface, and are drawn.

#include <optional>

#include "core/base/image.h"
#include "look.h"
#include "shapes/metaballs/surfels/atom_field.h"
#include "shapes/metaballs/surfels/draw.h"
#include "tools/particles/motion/motion.h"

namespace pbrt {

// What a frame took, and how good it is.
struct FrameFigures {
  int frame = 0;
  std::size_t atoms = 0, surfels = 0;
  // Milliseconds on the clock of the stages: the fluid, its field, the surfels, the discs made
  // ready, drawn, shaded, and the file.
  double motion = 0, field = 0, step = 0, discs = 0, draw = 0, shade = 0, write = 0;
  double cpu = 0;                  // of all threads from `field` to `shade`
  std::optional<double> coverage;  // share of the surface that some disc covers; if there is one
  surfels::Simulation::Report report;

  // From the atoms to the picture: what frames a second are counted by.
  double made() const { return field + step + discs + draw + shade; }
};

class Animation {
 public:
  // `motion` must outlive it. `settle`: steps at the first frame, for the surfels to spread.
  Animation(motion::Motion& motion, const PinholeCamera& camera, const Look& look, Point2i size,
            const surfels::Simulation::Settings& settings, int settle);

  // Goes on to a frame, and draws it if `image` is not null: sets R, G and B, and if `allChannels`
  // A (1 where there is a surface), Z (its distance), and N.X, .Y, .Z (its normal).
  // Numbers should rise by one. Throws what Motion::frame() throws.
  FrameFigures make(int number, bool allChannels, Image* image);

  std::span<const surfels::Surfel> surfels() const { return simulation_.surfels(); }

 private:
  // Neighbouring pixels, the rays through them, and where in seen_ is what they see.
  struct Block {
    Bounds2i pixels;
    surfels::Beam beam;
    std::size_t first = 0;

    std::size_t rays() const {
      return static_cast<std::size_t>(pixels.width()) * static_cast<std::size_t>(pixels.height());
    }
  };

  void shade(bool allChannels, Image& image) const;

  motion::Motion& motion_;
  PinholeCamera camera_;
  Shader shader_;
  Point2i size_;
  int settle_;
  motion::Fluid fluid_;
  surfels::AtomField field_;
  surfels::Simulation simulation_;
  surfels::Discs discs_;
  std::vector<Block> blocks_;
  std::vector<surfels::Fragment> seen_;
};

}  // namespace pbrt
