// Every sampler that can be found obeys the laws of samplers: tools/laws/sampler_laws.cpp.

#include "tests/every_law.h"

namespace pbrt::test {
namespace {

std::vector<laws::Subject> forms(const PluginInfo& sampler) {
  return {{&sampler, {}, {.independentNumbers = std::string_view(sampler.name) == "random"}}};
}

INSTANTIATE_TEST_SUITE_P(Samplers, EveryLaw,
                         testing::ValuesIn(everyLaw(PluginKind::sampler, forms)), EveryLaw::name);

}  // namespace
}  // namespace pbrt::test
