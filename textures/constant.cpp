#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Constant final : public Texture<T> {
 public:
  explicit Constant(Params& p) {
    if constexpr (std::is_same_v<T, float>)
      value_ = p.number("value", 1, "the value everywhere");
    else
      value_ = p.spectrum("value", Spectrum(1), "the value everywhere");
  }

  T evaluate(const SurfaceInteraction& /*at*/) const override { return value_; }

 private:
  T value_{};
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Constant, "constant", "the same value everywhere")
