// The weight falls linearly to zero.

#include "core/plugin/plugin.h"

namespace pbrt {

class TriangleFilter final : public Filter {
 public:
  explicit TriangleFilter(Params& p)
      : Filter({p.positive("xwidth", 2, "half its width", "pixels"),
                p.positive("ywidth", 2, "half its height", "pixels")}) {}

  float evaluate(Vec2 p) const override {
    const Vec2 rest = glm::max(radius() - glm::abs(p), Vec2(0));
    return rest.x * rest.y;
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Filter, pbrt::TriangleFilter, "triangle",
            "weights that fall evenly to zero: simple and soft")
