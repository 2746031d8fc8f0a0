#pragma once
// The transforms that the statements of a scene act on.

#include <map>
#include <optional>
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

  // As inFrame().
  TransformPair current() const { return inFrame(current_.transform); }
  const Current& save() const { return current_; }
  void restore(const Current& saved) { current_ = saved; }
  const Transform& base() const { return base_; }
  // Moves all into another space: `base` maps to it from the present one. It is what Identity means
  // from here on, and becomes the current transform.
  void setBase(const Transform& base);
  void name(const std::string& name, const TransformPair& t) { named_[name] = t; }
  MotionTimes times() const;

  // Only what happens while the shutter is open in a frame that begins at `time` is to be shown.
  // From here on motions are that part of themselves, and times() count from `time`.
  void setFrame(double time, float open, float close) { frame_ = {time, open, close}; }
  // What is to be shown of a motion; without a frame all of it. Throws Error (without a place) if
  // its ends cannot be blended.
  TransformPair inFrame(const TransformPair& motion) const;

 private:
  struct Frame {
    double time = 0;
    float open = 0, close = 0;  // from `time` on; open <= close
  };

  // Applies `change`, Transform to Transform, to the active ones of the current two.
  template <class Change>
  void change(const Directive& d, Change change);

  Transform base_;
  Current current_;
  std::map<std::string, TransformPair> named_;
  MotionTimes times_;
  std::optional<Frame> frame_;
};

}  // namespace pbrt
