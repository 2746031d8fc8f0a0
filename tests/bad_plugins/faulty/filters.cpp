// A pixel wide; fails by the x of the place.

#include "fault.h"

namespace pbrt {

class FaultyFilter final : public Filter {
 public:
  explicit FaultyFilter(Params& p) : Filter(Vec2(0.5F)), fault_(p) {}
  float evaluate(Vec2 p) const override { return fault_.number(p.x); }

 private:
  Fault fault_;
};

}  // namespace pbrt

PBRT_PLUGIN(Filter, pbrt::FaultyFilter, "faulty", "a filter that fails")
