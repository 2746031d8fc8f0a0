// Grey; fails by the x of the point.

#include "fault.h"

namespace pbrt {

template <class T>
class FaultyTexture final : public Texture<T> {
 public:
  explicit FaultyTexture(Params& p) : fault_(p) {}
  T evaluate(const SurfaceInteraction& at) const override {
    return T(0.5F * fault_.number(at.p.x));
  }

 private:
  Fault fault_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::FaultyTexture, "faulty", "a texture that fails")
