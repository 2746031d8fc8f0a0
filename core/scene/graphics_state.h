#pragma once
// The transforms that the statements of a scene act on.

#include <map>
#include <string>

#include "core/parse/directive.h"
#include "core/scene/factory.h"

namespace pbrt {

// The current transformation matrix and those that have names.
class TransformState {
 public:
  // Carries out a directive that only concerns transforms; false if it is another one.
  // Throws Error for a transform that cannot be undone, or a name that is not there.
  bool apply(const Directive& d, Dialect dialect, const Reporter& report);

  const Transform& current() const { return current_; }
  void setCurrent(const Transform& t) { current_ = t; }
  const Transform& base() const { return base_; }
  // Moves all into another space: `base` maps to it from the present one. It is what Identity means
  // from here on, and becomes the current transform.
  void setBase(const Transform& base);
  void name(const std::string& name, const Transform& t) { named_[name] = t; }

 private:
  void set(const Transform& t, const Directive& d);

  Transform base_;
  Transform current_;
  std::map<std::string, Transform> named_;
  bool active_ = true;  // ActiveTransform: whether the start of the shutter is among the current
  bool warned_ = false;
};

}  // namespace pbrt
