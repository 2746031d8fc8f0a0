// Every sampler that can be found obeys the laws of samplers.

#include "tests/law_sets.h"

namespace pbrt::test {
namespace {

class SamplerLaws : public testing::TestWithParam<LawCase> {};

TEST_P(SamplerLaws, Hold) {
  LawCase c = GetParam();
  c.subject.traits.independentNumbers = c.subject.plugin->name == std::string("random");
  obeyWithEach(c, {{}});
}

INSTANTIATE_TEST_SUITE_P(Every, SamplerLaws, testing::ValuesIn(lawCases(PluginKind::sampler)),
                         nameOf);

}  // namespace
}  // namespace pbrt::test
