// Every volume that can be found obeys the laws of volumes: tools/laws/volume_laws.cpp.

#include "tests/every_law.h"

namespace pbrt::test {
namespace {

// For media of some kind or other: plain ones; grids with steps in their densities, and the same
// opaque in red and clear in blue; a grid of one density that glows here and there; one of colours.
std::vector<ParamList> mediumParams() {
  const ParamList sigmas = {rgb("sigma_a", 0.2F, 0.4F, 0.1F), rgb("sigma_s", 0.3F, 0.9F, 2),
                            rgb("Le", 1, 0.5F, 0.25F)};
  const std::vector<float> densities = {0.5F, 0, 3, 1, 0.1F, 0, 0, 8, 1, 2, 0.3F, 0.7F};
  ParamList boxed = sigmas, grid = sigmas, colours;
  ParamList unlike = {rgb("sigma_a", 60, 0.5F, 0), rgb("sigma_s", 30, 0.5F, 0)};
  ParamList flames = {rgb("sigma_a", 0.2F, 0.4F, 0.1F)};
  boxed.push_back(points("p0", {0, 0, 0}));
  for (ParamList* list : {&grid, &unlike})
    list->push_back(value(ParamType::number, "density", densities));
  flames.push_back(value(ParamType::number, "density", std::vector<float>(densities.size(), 2)));
  flames.push_back(value(ParamType::number, "Lescale", densities));
  flames.push_back(value(ParamType::number, "temperature",
                         {900, 3000, 0, 2000, 2500, 0, 0, 1800, 2200, 3000, 4000, 1500}));
  for (ParamList* list : {&grid, &unlike, &flames, &colours})
    for (const auto& [name, n] : {std::pair("nx", 2), std::pair("ny", 3), std::pair("nz", 2)})
      list->push_back(integers(name, {n}));
  std::vector<float> flat;
  for (const float d : densities) flat.insert(flat.end(), {d, 2 * d, 0.5F + d});
  for (const char* name : {"sigma_a", "sigma_s", "Le"})
    colours.push_back(value(ParamType::rgb, name, flat));
  return {boxed, grid, unlike, flames, colours};
}

// Those that a volume takes.
std::vector<laws::Subject> forms(const PluginInfo& volume) {
  std::vector<laws::Subject> forms;
  for (const ParamList& list : mediumParams())
    if (const laws::Subject form{&volume, list, {}}; laws::accepts<Medium>(form, {}))
      forms.push_back(form);
  return forms;
}

INSTANTIATE_TEST_SUITE_P(Volumes, EveryLaw, testing::ValuesIn(everyLaw(PluginKind::volume, forms)),
                         EveryLaw::name);

TEST(Volumes, AreAllTriedAndEndWithTheirBox) {
  std::size_t tried = 0;
  for (const std::string& name : loader().available(PluginKind::volume)) {
    const auto all = forms(loader().open(PluginKind::volume, name));
    EXPECT_FALSE(all.empty()) << name;
    for (const laws::Subject& form : all) EXPECT_TRUE(form.make<Medium>()->bounded()) << name;
    tried += all.size();
  }
  EXPECT_GE(tried, 9U);
}

}  // namespace
}  // namespace pbrt::test
