// Every sample within the filter's reach counts the same.

#include "core/plugin/plugin.h"

namespace pbrt {

class BoxFilter final : public Filter {
 public:
  explicit BoxFilter(Params& p)
      : Filter({p.positive("xwidth", 0.5F, "half its width", "pixels"),
                p.positive("ywidth", 0.5F, "half its height", "pixels")}) {}

  float evaluate(Vec2 p) const override {
    return std::abs(p.x) <= radius().x && std::abs(p.y) <= radius().y ? 1.F : 0.F;
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Filter, pbrt::BoxFilter, "box",
            "the plain mean of the samples in a pixel: fine patterns turn into false ones")
