#include "core/plugin/lafortune_material.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The coefficients, fitted to measurements, are pbrt-v1's.
class Clay final : public LafortuneMaterial {
 public:
  explicit Clay(Params& p) : LafortuneMaterial(p, kFit) {}

 private:
  static constexpr LafortuneFit kFit{{0.383626F, 0.260749F, 0.274207F},
                                     {{{{-1.089701F, -1.102701F, -1.107603F},
                                        {-1.354682F, -2.714801F, -1.569866F},
                                        {17.968505F, 11.024489F, 21.270282F}},
                                       {{-0.733381F, -0.79332F, -0.848206F},
                                        {0.676108F, 0.679314F, 0.726031F},
                                        {8.219745F, 9.055139F, 11.261951F}},
                                       {{-1.010548F, -1.012378F, -1.011263F},
                                        {0.910783F, 0.885239F, 0.892451F},
                                        {152.912795F, 141.937171F, 201.046802F}}}}};
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Clay, "clay", "clay, as it was measured")
