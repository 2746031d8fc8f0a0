#pragma once
// The field of all atoms, anywhere, for those who ask beside the rays.

#include "shapes/metaballs/cells.h"

namespace pbrt::metaballs {

// The atoms are kept in a tree of the boxes about their supports, 8 to a leaf: a question takes the
// logarithm of their number, and the atoms whose supports hold the place. Two numbers and some for
// each atom; nothing is copied.
class WholeField final : public ImplicitField {
 public:
  // `field` must outlive it. `cells` must not be empty; they give the bounds.
  WholeField(const Field& field, const Cells& cells);

  Bounds3 bounds() const override { return bounds_; }
  FieldPoint at(const DPoint3& p) const override;
  FieldRange over(const DPoint3& lo, const DPoint3& hi) const override;
  glm::dmat3 hessian(const DPoint3& p) const override;

 private:
  void sort(std::size_t node, std::size_t first, std::size_t last);
  // Calls visit(list) until all atoms were in a list that reach the box, and others.
  template <class Visit>
  void visitReaching(const DPoint3& lo, const DPoint3& hi, const Visit& visit) const;

  const Field& field_;
  Bounds3 bounds_;
  std::vector<std::uint32_t> order_;  // the numbers of the atoms, by their leaves
  std::vector<Bounds3> tree_;  // a heap of boxes: node k is over its children 2 k + 1 and 2 k + 2
};

}  // namespace pbrt::metaballs
