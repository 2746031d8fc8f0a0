#include "core/plugin/lafortune_material.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The coefficients, fitted to measurements, are pbrt-v1's.
class Skin final : public LafortuneMaterial {
 public:
  explicit Skin(Params& p) : LafortuneMaterial(p, kFit) {}

 private:
  static constexpr LafortuneFit kFit{{0.428425F, 0.301341F, 0.331054F},
                                     {{{{-1.131747F, -1.016939F, -0.966018F},
                                        {-1.209182F, -1.462488F, -1.222419F},
                                        {6.421658F, 3.699932F, 3.524889F}},
                                       {{-0.54657F, -0.643533F, -0.638934F},
                                        {0.380123F, 0.410559F, 0.437367F},
                                        {3.685044F, 4.266495F, 4.539742F}},
                                       {{-0.998888F, -1.020153F, -1.027479F},
                                        {0.857998F, 0.703913F, 0.573625F},
                                        {64.208486F, 63.919687F, 43.809866F}}}}};
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Skin, "skin", "human skin, as it was measured")
