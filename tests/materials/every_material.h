#pragma once
// Every material that can be found, with every set of parameters below whose names it knows.

#include <fmt/format.h>

#include "tests/materials/scattering.h"

namespace pbrt::test {

inline std::vector<ParamList> parameterSets() {
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

// Whether its highlights are wide enough for cells of a few degrees.
inline bool broad(const std::string& name, const ParamList& set) {
  if (name == "metal" && set.empty()) return false;
  for (const Param& p : set) {
    if (p.type != ParamType::number) continue;
    const float x = std::get<std::vector<float>>(p.values)[0];
    if (p.name.ends_with("roughness") && (x < 0.1F || x > 10)) return false;
    // Facets of glass spread refracted light by little.
    if (p.name == "index" && x > 1 && x < 1.3F) return false;
  }
  return true;
}

// Glass has no such facets.
inline bool isBlinn(const ParamList& set) {
  return std::ranges::any_of(set, [](const Param& p) {
    return p.type == ParamType::string &&
           std::get<std::vector<std::string>>(p.values)[0] == "blinn";
  });
}

template <class Check>
void forEveryMaterial(Check check) {
  const auto names = loader().available(PluginKind::material);
  ASSERT_GE(names.size(), 5U);
  for (const std::string& name : names) {
    if (name == "mix") continue;  // nothing of its own: see mix_test.cpp
    std::vector<Declaration> declared;
    Params describing = Params::describing(name, declared);
    create<Material>(loader().open(PluginKind::material, name), describing, {});
    for (const ParamList& set : parameterSets()) {
      bool known = name != "glass" || !isBlinn(set);
      std::string label = name;
      for (const Param& p : set) {
        label += fmt::format(" {}", p.name);
        if (p.type == ParamType::number)
          label += fmt::format("={}", std::get<std::vector<float>>(p.values)[0]);
        known &= std::any_of(declared.begin(), declared.end(),
                             [&](const Declaration& d) { return d.name == p.name; });
      }
      if (!known) continue;
      SCOPED_TRACE(label);
      const Scattering bsdf(name, set);
      check(name, set, *bsdf.operator->());
    }
  }
}

}  // namespace pbrt::test
