#include "core/scene/graphics_state.h"

#include <fmt/format.h>

namespace pbrt {

void TransformState::set(const Transform& t, const Directive& d) {
  if (!t.invertible())
    throw Error(d.where, fmt::format("{} gives a transform that cannot be undone (it flattens "
                                     "space, or its numbers are too large)",
                                     directiveName(d.kind)));
  if (active_) current_ = t;
}

void TransformState::setBase(const Transform& base) {
  current_ = base_ = base;
  for (auto& entry : named_) entry.second = base * entry.second;
}

bool TransformState::apply(const Directive& d, Dialect dialect, const Reporter& report) {
  using enum DirectiveKind;
  const auto& x = d.numbers;
  const DVec3 first(x[0], x[1], x[2]);
  switch (d.kind) {
    case Identity:
      set(base_, d);
      return true;
    case Translate:
      set(current_ * Transform::translate(first), d);
      return true;
    case Scale:
      set(current_ * Transform::scale(first), d);
      return true;
    case Rotate: {
      const DVec3 axis(x[1], x[2], x[3]);
      if (axis == DVec3(0)) throw Error(d.where, "Rotate needs an axis other than 0 0 0");
      set(current_ * Transform::rotate(x[0], axis), d);
      return true;
    }
    case LookAt: {
      const DPoint3 look(x[3], x[4], x[5]);
      const DVec3 up(x[6], x[7], x[8]);
      if (first == look)
        throw Error(d.where, "LookAt: the eye and the point looked at are the same");
      const DVec3 side = glm::cross(up, look - first);
      if (!(lengthSquared(side) > 1e-24 * lengthSquared(up) * lengthSquared(look - first)))
        throw Error(d.where, "LookAt: the up vector lies along the viewing direction (or is zero)");
      set(current_ * Transform::lookAt(first, look, up, dialect == Dialect::v1), d);
      return true;
    }
    case DirectiveKind::Transform:
    case ConcatTransform: {
      glm::dmat4 m;
      for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = x[i];
      if (x[3] != 0 || x[7] != 0 || x[11] != 0 || x[15] != 1)
        throw Error(d.where, fmt::format("{}: every fourth number must be 0, the last one 1 "
                                         "(projections belong to the camera)",
                                         directiveName(d.kind)));
      set((d.kind == ConcatTransform ? current_ : base_) * pbrt::Transform(m), d);
      return true;
    }
    case CoordinateSystem:
      named_[d.words.at(0)] = current_;
      return true;
    case CoordSysTransform: {
      const auto found = named_.find(d.words.at(0));
      if (found == named_.end())
        throw Error(d.wordsWhere.at(0), fmt::format("there is no coordinate system \"{}\"{}",
                                                    d.words[0], didYouMeanKey(d.words[0], named_)));
      set(found->second, d);
      return true;
    }
    case ActiveTransform:
      active_ = d.words.at(0) != "EndTime";
      if (d.words[0] != "All" && !warned_ && report) {
        warned_ = true;
        report(diagnose(Severity::warning, d.where,
                        "motion blur is not there yet: the start of the shutter is shown"));
      }
      return true;
    case TransformTimes:
      return true;  // says when, and nothing moves yet
    default:
      return false;
  }
}

}  // namespace pbrt
