// Every filter that can be found obeys the laws of filters: tools/laws/filter_laws.cpp.

#include "tests/every_law.h"

namespace pbrt::test {
namespace {

std::vector<laws::Subject> forms(const PluginInfo& filter) {
  return {{&filter, {}, {.hasSteps = std::string_view(filter.name) == "box"}}};
}

INSTANTIATE_TEST_SUITE_P(Filters, EveryLaw, testing::ValuesIn(everyLaw(PluginKind::filter, forms)),
                         EveryLaw::name);

}  // namespace
}  // namespace pbrt::test
