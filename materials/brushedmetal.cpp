#include "core/plugin/lafortune_material.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The coefficients, fitted to measurements, are pbrt-v1's. By them alone it would send back 1.6
// times the light that comes at 82 degrees; LafortuneModel takes that back.
class BrushedMetal final : public LafortuneMaterial {
 public:
  explicit BrushedMetal(Params& p) : LafortuneMaterial(p, kFit) {}

 private:
  static constexpr LafortuneFit kFit{Spectrum(0),
                                     {{{{-1.11854F, -1.11845F, -1.11999F},
                                        {1.01272F, 1.01469F, 1.01942F},
                                        {15.8708F, 15.6489F, 15.4571F}},
                                       {{-1.05334F, -1.06409F, -1.08378F},
                                        {0.69541F, 0.662178F, 0.626672F},
                                        {111.267F, 88.9222F, 65.2179F}},
                                       {{-1.01684F, -1.01635F, -1.01529F},
                                        {1.00132F, 1.00112F, 1.00108F},
                                        {180.181F, 184.152F, 195.773F}}}}};
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::BrushedMetal, "brushedmetal", "brushed metal, as it was measured")
