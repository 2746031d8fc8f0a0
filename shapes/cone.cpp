// A cone about the z axis: a circle at z = 0, the tip above it; without a lid.

#include "core/plugin/plugin.h"
#include "core/plugin/swept_segment.h"

namespace pbrt {

class Cone final : public SweptSegment {
 public:
  explicit Cone(Params& p)
      : SweptSegment({p.positive("radius", 1, "radius at z = 0", "scene units"), 0, 0},
                     {0, 0, p.positive("height", 1, "of the tip", "scene units")}, Sweep(p)) {}
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::Cone, "cone", "a cone without a lid, or a part of it")
