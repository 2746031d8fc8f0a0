// Every texture that can be found obeys the laws of textures: tools/laws/texture_laws.cpp.

#include "tests/command.h"
#include "tests/every_law.h"

namespace pbrt::test {
namespace {

std::vector<laws::Subject> forms(const PluginInfo& texture) {
  std::vector<ParamList> sets = {{},
                                 {text("mapping", "spherical")},
                                 {text("mapping", "cylindrical")},
                                 {text("mapping", "planar")},
                                 {integers("dimension", {3})}};
  static const Folder folder;
  if (std::string_view(texture.name) == "imagemap") {
    folder.write("a.pfm", "Pf 3 2 -1\n" + std::string(24, '?'));  // 0.7471
    for (ParamList& set : sets) set.push_back(text("filename", (folder.path() / "a.pfm").string()));
  }
  return subjects<Texture<Spectrum>>(texture, sets, {.finiteAtAnySize = true});
}

INSTANTIATE_TEST_SUITE_P(Textures, EveryLaw,
                         testing::ValuesIn(everyLaw(PluginKind::texture, forms)), EveryLaw::name);

}  // namespace
}  // namespace pbrt::test
