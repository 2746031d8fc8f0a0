#include "core/scene/graphics_state.h"

#include <fmt/format.h>

namespace pbrt {

template <class Change>
void TransformState::change(const Directive& d, Change change) {
  const auto apply = [&](Transform& t) {
    t = change(t);
    if (!t.invertible())
      throw Error(d.where, fmt::format("{} gives a transform that cannot be undone (it flattens "
                                       "space, or its numbers are too large)",
                                       directiveName(d.kind)));
  };
  if (current_.startActive) apply(current_.transform.start);
  if (current_.endActive) apply(current_.transform.end);
}

void TransformState::setBase(const Transform& base) {
  current_ = {base, true, true};
  base_ = base;
  for (auto& entry : named_) entry.second = base * entry.second;
}

// Translation and stretch go linearly from end to end, and the rotation at even speed: so does each
// part between its own ends. Cut out it is the same motion, and as long as one.
TransformPair TransformState::inFrame(const TransformPair& motion) const {
  if (!frame_ || !motion.moves()) return motion;
  const AnimatedTransform way(motion);
  const double start = times_.start, length = double{times_.end} - start;
  const auto at = [&](float since) { return way.at((frame_->time + since - start) / length); };
  return {at(frame_->open), at(frame_->close)};
}

MotionTimes TransformState::times() const {
  if (!frame_) return times_;
  const MotionTimes open = {std::max(static_cast<float>(times_.start - frame_->time), frame_->open),
                            std::min(static_cast<float>(times_.end - frame_->time), frame_->close)};
  return open.start < open.end ? open : MotionTimes();  // nothing moves
}

bool TransformState::apply(const Directive& d, Dialect dialect) {
  using enum DirectiveKind;
  const auto& x = d.numbers;
  const DVec3 first(x[0], x[1], x[2]);
  const auto append = [&](const pbrt::Transform& t) {
    change(d, [&](const pbrt::Transform& current) { return current * t; });
  };
  const auto replace = [&](const pbrt::Transform& t) {
    change(d, [&](const pbrt::Transform&) { return t; });
  };
  switch (d.kind) {
    case Identity:
      replace(base_);
      return true;
    case Translate:
      append(Transform::translate(first));
      return true;
    case Scale:
      append(Transform::scale(first));
      return true;
    case Rotate: {
      const DVec3 axis(x[1], x[2], x[3]);
      if (axis == DVec3(0)) throw Error(d.where, "Rotate needs an axis other than 0 0 0");
      append(Transform::rotate(x[0], axis));
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
      append(Transform::lookAt(first, look, up, dialect == Dialect::v1));
      return true;
    }
    case DirectiveKind::Transform:
    case ConcatTransform: {
      glm::dmat4 m;
      for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = x[i];
      // Exporters leave rounding there.
      const auto is = [](double value, double wanted) { return std::abs(value - wanted) < 1e-6; };
      for (int c = 0; c < 4; ++c)
        if (is(m[c][3], c == 3)) m[c][3] = c == 3;
      if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
        throw Error(d.where, fmt::format("{}: every fourth number must be 0, the last one 1 "
                                         "(projections belong to the camera)",
                                         directiveName(d.kind)));
      if (d.kind == ConcatTransform)
        append(pbrt::Transform(m));
      else
        replace(base_ * pbrt::Transform(m));
      return true;
    }
    case CoordinateSystem:
      named_[d.words.at(0)] = current_.transform;
      return true;
    case CoordSysTransform: {
      const auto found = named_.find(d.words.at(0));
      if (found == named_.end())
        throw Error(d.wordsWhere.at(0),
                    fmt::format("there is no coordinate system \"{}\"{}", shown(d.words[0]),
                                didYouMeanKey(d.words[0], named_)));
      current_.transform = found->second;  // both, whatever is active
      return true;
    }
    case ActiveTransform:
      current_.startActive = d.words.at(0) != "EndTime";
      current_.endActive = d.words[0] != "StartTime";
      return true;
    case TransformTimes:
      times_ = {static_cast<float>(x[0]), static_cast<float>(x[1])};
      if (!(times_.start < times_.end && std::isfinite(times_.end - times_.start)))
        throw Error(d.where, "TransformTimes: the first time must be before the second");
      return true;
    default:
      return false;
  }
}

}  // namespace pbrt
