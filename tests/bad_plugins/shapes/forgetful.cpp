// Declares a parameter that it does not read.

#include "core/plugin/plugin.h"

namespace {

class Forgetful final : public pbrt::MeshShape {
 public:
  explicit Forgetful(pbrt::Params& p) {
    if (p.describing()) p.number("size", 1, "of the triangle");
    mesh_.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh_.indices = {0, 1, 2};
  }
};

}  // namespace

PBRT_PLUGIN(Shape, Forgetful, "forgetful", "a triangle of one size")
