#include "core/plugin/lafortune_material.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The coefficients, fitted to measurements, are pbrt-v1's.
class Felt final : public LafortuneMaterial {
 public:
  explicit Felt(Params& p) : LafortuneMaterial(p, kFit) {}

 private:
  static constexpr LafortuneFit kFit{{0.025865F, 0.025865F, 0.025865F},
                                     {{{{-0.304075F, -0.304075F, -0.304075F},
                                        {-0.065992F, -0.065992F, -0.065992F},
                                        {3.047892F, 3.047892F, 3.047892F}},
                                       {{-0.749561F, -0.749561F, -0.749561F},
                                        {-1.167929F, -1.167929F, -1.167929F},
                                        {6.931827F, 6.931827F, 6.931827F}},
                                       {{1.004921F, 1.004921F, 1.004921F},
                                        {-0.205529F, -0.205529F, -0.205529F},
                                        {94.117332F, 94.117332F, 94.117332F}}}}};
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Felt, "felt",
            "dark felt, as it was measured: brightest against the light")
