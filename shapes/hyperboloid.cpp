// What a segment sweeps as it turns about the z axis.

#include "core/plugin/plugin.h"
#include "core/plugin/swept_segment.h"

namespace pbrt {

class Hyperboloid final : public SweptSegment {
 public:
  explicit Hyperboloid(Params& p)
      : Hyperboloid(p, p.point("p1", {0, 0, 0}, "one end of the rod, in scene units"),
                    p.point("p2", {1, 1, 1}, "its other end, in scene units")) {}

 private:
  Hyperboloid(Params& p, const Point3& p1, const Point3& p2) : SweptSegment(p1, p2, Sweep(p)) {
    if (!isFinite(p1)) p.fail("p1", "is not finite");
    if (!isFinite(p2)) p.fail("p2", "is not finite");
    if (p1.z == p2.z) p.fail("p2", "must differ from p1 in z: a flat ring is a disk");
    if (p1.x == 0 && p1.y == 0 && p2.x == 0 && p2.y == 0)
      p.fail("p2", "lies on the z axis, as p1 does: nothing is swept");
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::Hyperboloid, "hyperboloid",
            "a cooling tower: what a slanting rod sweeps as it turns about the z axis")
