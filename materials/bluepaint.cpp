#include "core/plugin/lafortune_material.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The coefficients are pbrt-v1's. The Program of Computer Graphics at Cornell, which measured the
// paint, lists nearly the same for the one in Lafortune et al. 1997.
class BluePaint final : public LafortuneMaterial {
 public:
  explicit BluePaint(Params& p) : LafortuneMaterial(p, kFit) {}

 private:
  static constexpr LafortuneFit kFit{{0.3094F, 0.39667F, 0.70837F},
                                     {{{{0.870567F, 0.857255F, 0.670982F},
                                        {0.803624F, 0.77429F, 0.586674F},
                                        {21.820103F, 18.597755F, 7.472717F}},
                                       {{-0.451218F, -0.406681F, -0.477976F},
                                        {0.023123F, 0.017625F, 0.227295F},
                                        {2.774499F, 2.581499F, 3.677653F}},
                                       {{-1.031545F, -1.029426F, -1.026588F},
                                        {0.706734F, 0.69653F, 0.687715F},
                                        {66.89906F, 63.767912F, 57.489181F}}}}};
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::BluePaint, "bluepaint", "light blue house paint, as it was measured")
