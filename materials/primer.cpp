#include "core/plugin/lafortune_material.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The coefficients, fitted to measurements, are pbrt-v1's.
class Primer final : public LafortuneMaterial {
 public:
  explicit Primer(Params& p) : LafortuneMaterial(p, kFit) {}

 private:
  static constexpr LafortuneFit kFit{{0.11823F, 0.121218F, 0.133209F},
                                     {{{{-0.399286F, -1.033473F, -1.058104F},
                                        {0.167504F, 0.009545F, -0.068002F},
                                        {2.466633F, 7.637253F, 8.117645F}},
                                       {{-1.041861F, -1.100108F, -1.087779F},
                                        {0.014375F, -0.198147F, -0.053605F},
                                        {7.993722F, 29.446268F, 41.98899F}},
                                       {{-1.098605F, -0.379883F, -0.449038F},
                                        {-0.14511F, 0.159127F, 0.173224F},
                                        {31.899719F, 2.372852F, 2.636161F}}}}};
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Primer, "primer", "grey primer paint, as it was measured")
