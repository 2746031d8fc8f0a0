// Every light that can be found obeys the laws of lights: tools/laws/light_laws.cpp.

#include "core/base/rng.h"
#include "tests/every_law.h"
#include "tests/lights/pictures.h"

namespace pbrt::test {
namespace {

std::vector<laws::Subject> forms(const PluginInfo& light) {
  static const Folder folder;
  Rng rng(9);
  std::vector<float> values(24 * 12);
  for (float& v : values) v = rng.uniform() < 0.05F ? 30 : rng.uniform();
  const std::string picture = greyPicture(folder, "a.exr", 24, values);
  return subjects<Light>(
      light,
      {{}, {flag("twosided", true)}, {text("mapname", picture)}, {text("falloff", "smoothstep")}});
}

INSTANTIATE_TEST_SUITE_P(Lights, EveryLaw, testing::ValuesIn(everyLaw(PluginKind::light, forms)),
                         EveryLaw::name);

}  // namespace
}  // namespace pbrt::test
