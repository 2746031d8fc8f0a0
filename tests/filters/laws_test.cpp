// Every filter that can be found obeys the laws of filters.

#include "tests/law_sets.h"

namespace pbrt::test {
namespace {

class FilterLaws : public testing::TestWithParam<LawCase> {};

TEST_P(FilterLaws, Hold) {
  LawCase c = GetParam();
  c.subject.traits.hasSteps = c.subject.plugin->name == std::string("box");
  obeyWithEach(c, {{}});
}

INSTANTIATE_TEST_SUITE_P(Every, FilterLaws, testing::ValuesIn(lawCases(PluginKind::filter)),
                         nameOf);

}  // namespace
}  // namespace pbrt::test
