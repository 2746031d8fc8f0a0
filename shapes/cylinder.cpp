// A cylinder about the z axis, without lids.

#include "core/plugin/plugin.h"
#include "core/plugin/swept_segment.h"

namespace pbrt {

class Cylinder final : public SweptSegment {
 public:
  explicit Cylinder(Params& p)
      : Cylinder(p, p.positive("radius", 1, "radius", "scene units"),
                 p.number("zmin", -1, "height where it begins", "scene units"),
                 p.number("zmax", 1, "height where it ends", "scene units")) {}

 private:
  Cylinder(Params& p, float radius, float a, float b)
      : SweptSegment({radius, 0, std::min(a, b)}, {radius, 0, std::max(a, b)}, Sweep(p)) {
    if (a == b) p.fail("zmax", "must differ from zmin");
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::Cylinder, "cylinder", "a round tube without lids, or a part of it")
