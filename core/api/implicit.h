#pragma once
// Implicit surfaces: where a field is zero.

#include "core/base/bounds.h"
#include "core/base/range.h"

namespace pbrt {

// A field f at a point.
struct FieldPoint {
  double value = 0;
  DVec3 gradient{};
};

// All that a field and its gradient may be over a box, rounding included.
struct FieldRange {
  Range value;
  Range gradient[3];
};

// All that a field and its derivative by s may be along a line o + s u.
struct LineRange {
  Range value;
  Range slope;
};

// A function f of object space: zero on the surface, above zero inside. Its unit is its own: only
// its sign and its zeros count. Const and thread-safe; nothing here allocates or throws.
//
// Ranges hold what f is for all real points of a box, and what at() computes. They must shrink to
// the value as the box shrinks to a point; the better they are, the fewer looks a ray takes. Where
// f has no value there is no surface, and at() gives NaN. A range that is not known is
// Range::all(). Gradients are bounded only over boxes in which f has a value everywhere, is
// continuous, and is as steep as that at most; where f has a kink, they hold those of both sides.
class ImplicitField {
 public:
  virtual ~ImplicitField();

  // Not empty, and finite. The surface ends where it leaves this box, which may leave it open.
  virtual Bounds3 bounds() const = 0;
  virtual FieldPoint at(const DPoint3& p) const = 0;
  virtual FieldRange over(const DPoint3& lo, const DPoint3& hi) const = 0;

  // Over all points whose coordinates are within `error` of those of o + s u. By default, that over
  // the box that holds them.
  virtual LineRange along(const DPoint3& o, const DVec3& u, const Range& s, double error) const;
  // Column i is the derivative of the gradient along axis i. By default, from differences over
  // 2^-17 of the bounds: good for curvature, not for proofs.
  virtual glm::dmat3 hessian(const DPoint3& p) const;
};

}  // namespace pbrt
