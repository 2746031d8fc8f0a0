#include "core/plugin/medium_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// Density a exp(-b h) at the height h over the corner p0.
class Exponential final : public Medium {
 public:
  Exponential(Params& p, const Setup& setup)
      : Exponential(p, setup, readMedium(p), readMediumBox(p)) {}

 private:
  Exponential(Params& p, const Setup& setup, const MediumParams& medium, const MediumBox& box)
      : Medium(setup, medium.g, box.lo, box.hi), unit_(medium.unit) {
    unit_ = unit_ * p.nonNegative("a", 1, "density at the height of p0");
    b_ = p.number("b", 1, "how fast it falls: by the factor exp(-b) in a unit of height");
    up_ = DVec3(p.vector("updir", {0, 1, 0}, "what is up"));
    if (!(lengthSquared(up_) > 0)) p.fail("updir", "must not be 0 0 0");
    up_ = glm::normalize(up_);

    // The greatest density of a cell is at one of its corners.
    const glm::ivec3 n = b_ == 0 ? glm::ivec3(1) : glm::ivec3(8);
    const DVec3 size = (box.hi - box.lo) / DVec3(n);
    std::vector<Cell> cells;
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) {
          double greatest = 0;
          for (int corner = 0; corner < 8; ++corner) {
            const DVec3 at(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
            greatest = std::max(greatest, density(box.lo + at * size));
          }
          cells.push_back({static_cast<float>(greatest) * unit_.extinction(), b_ == 0});
        }
    setCells(n, std::move(cells), !isBlack(unit_.emission));
  }

  double density(const DPoint3& p) const { return std::exp(-b_ * glm::dot(p - lo(), up_)); }

  MediumPoint properties(const DPoint3& p) const override {
    return unit_ * static_cast<float>(density(p));
  }

  MediumPoint unit_;
  double b_ = 1;
  DVec3 up_{0, 1, 0};
};

}  // namespace pbrt

PBRT_PLUGIN(Medium, pbrt::Exponential, "exponential",
            "haze in a box whose density falls exponentially with the height")
