// Every material that can be found obeys the laws of materials: tools/laws/material_laws.cpp.

#include "tests/every_law.h"
#include "tests/materials/material_sets.h"

namespace pbrt::test {
namespace {

bool isBlinn(const ParamList& set) {
  return std::ranges::any_of(set, [](const Param& p) {
    return p.type == ParamType::string &&
           std::get<std::vector<std::string>>(p.values)[0] == "blinn";
  });
}

std::vector<laws::Subject> forms(const PluginInfo& material) {
  const std::string_view name = material.name;
  if (name == "mix") return {};  // nothing of its own: see mix_test.cpp
  std::vector<ParamList> sets = materialSets();
  if (name == "glass") std::erase_if(sets, isBlinn);  // it has no such facets
  laws::Traits traits;
  // As in pbrt, it is up to the user that the parts of these add up to no more than one.
  if (name == "shinymetal" || name == "uber") traits.albedo = 2;
  return subjects<Material>(material, sets, traits);
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryLaw,
                         testing::ValuesIn(everyLaw(PluginKind::material, forms)), EveryLaw::name);

}  // namespace
}  // namespace pbrt::test
