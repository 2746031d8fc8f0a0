#pragma once
// The transforms that the statements of a scene act on.

#include <map>
#include <string>

#include "core/base/animated_transform.h"
#include "core/parse/directive.h"
#include "core/scene/factory.h"

namespace pbrt {

// The current transformation matrix, at the start and at the end of a motion, and those that have
// names.
class TransformState {
 public:
  // What AttributeBegin and TransformBegin save.
  struct Current {
    TransformPair transform;
    bool startActive = true, endActive = true;  // ActiveTransform: which of the two change
  };

  // Carries out a directive that only concerns transforms; false if it is another one.
  // Throws Error for a transform that cannot be undone, or a name that is not there.
  bool apply(const Directive& d, Dialect dialect);

  const TransformPair& current() const { return current_.transform; }
  const Current& save() const { return current_; }
  void restore(const Current& saved) { current_ = saved; }
  const Transform& base() const { return base_; }
  // Moves all into another space: `base` maps to it from the present one. It is what Identity means
  // from here on, and becomes the current transform.
  void setBase(const Transform& base);
  void name(const std::string& name, const TransformPair& t) { named_[name] = t; }
  const MotionTimes& times() const { return times_; }

 private:
  // Applies `change`, Transform to Transform, to the active ones of the current two.
  template <class Change>
  void change(const Directive& d, Change change);

  Transform base_;
  Current current_;
  std::map<std::string, TransformPair> named_;
  MotionTimes times_;
};

}  // namespace pbrt
