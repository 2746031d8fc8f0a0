#pragma once
// The parameters with which every material is tried whose names it knows.

#include "tests/support.h"

namespace pbrt::test {

inline std::vector<ParamList> materialSets() {
  const Param alpha = flag("remaproughness", false), blinn = text("distribution", "blinn");
  return {
      {},
      {number("sigma", 20)},
      {number("sigma", 90)},
      {number("roughness", 0)},
      {number("roughness", 1e-6F)},
      {number("roughness", 0.2F)},
      {number("roughness", 1)},
      {number("roughness", 0.2F), text("remapping", "v4")},
      {number("roughness", 0.3F), alpha},
      {number("roughness", 1), alpha},
      {number("roughness", 1e-6F), alpha},
      {number("roughness", 1e30F), alpha},
      {number("uroughness", 0.15F), number("vroughness", 0.6F), alpha},
      {number("uroughness", 0.15F), number("vroughness", 0), alpha},
      {number("uroughness", 0.3F), number("vroughness", 0.3F), alpha, number("index", 2.4F)},
      {number("uroughness", 0.3F), number("vroughness", 0.3F), alpha, number("index", 0.6F)},
      {number("uroughness", 0.3F), number("vroughness", 0.3F), alpha, number("index", 1.0001F)},
      {number("uroughness", 0.3F), number("vroughness", 0.3F), alpha, number("index", 1.1F)},
      {number("uroughness", 0.3F), number("vroughness", 0.1F), blinn},
      {number("roughness", 1e-6F), blinn},
      {number("roughness", 0.1F), blinn},
      {number("roughness", 1), blinn},
      {number("uroughness", 1e-6F), number("vroughness", 1), alpha},
      {number("uroughness", 0.2F), number("vroughness", 0.5F), alpha,
       text("distribution", "beckmann")},
      {number("roughness", 0.3F), text("distribution", "beckmann")},
      {number("roughness", 1e-6F), text("distribution", "beckmann"), alpha},
      {number("roughness", 1e30F), text("distribution", "beckmann"), alpha},
      {number("roughness", 0.3F), number("index", 0.6F), text("distribution", "beckmann"), alpha},
      {number("index", 1)},
      {number("index", 1.0000001F)},
      {number("index", 0.7F)},
      {number("index", 1000)},
      {number("eta", 1), number("thickness", 0)},
      {number("eta", 1.33F), number("thickness", 0), number("roughness", 0.5F)},
      {number("thickness", 1e30F), number("roughness", 0.5F)},
      {number("interface.eta", 1000), number("interface.roughness", 0.5F)},
      {number("interface.roughness", 0.8F), alpha},
      {number("conductor.roughness", 0.3F), alpha},
      {number("conductor.roughness", 0.8F), number("interface.roughness", 0.8F), alpha},
      {rgb("Kd", 0, 0, 0)},
      {rgb("Ks", 0.1F, 0.2F, 0.3F)},
      {rgb("Kd", 0.1F, 0.1F, 0.1F), rgb("Kr", 0.2F, 0.2F, 0.2F), rgb("Kt", 0.5F, 0.5F, 0.5F)},
      {rgb("Kd", 1, 1, 1), rgb("Ks", 1, 1, 1), number("uroughness", 1), number("vroughness", 1),
       alpha},
      {rgb("opacity", 0.2F, 0.5F, 1)},
      {rgb("reflectance", 1, 1, 1), number("roughness", 0)},
      {rgb("reflectance", 1, 1, 1), number("roughness", 0.5F), alpha},
      {rgb("reflectance", 1, 1, 1), number("interface.roughness", 0.2F),
       number("conductor.roughness", 0.5F), alpha},
      {rgb("reflectance", 0.2F, 0.5F, 0.7F), rgb("transmittance", 0.8F, 0.5F, 0.1F)}};
}

}  // namespace pbrt::test
