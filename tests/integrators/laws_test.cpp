// Every integrator that can be found obeys the laws of integrators.

#include "tests/law_sets.h"
#include "tools/laws/parameters.h"

namespace pbrt::test {
namespace {

class IntegratorLaws : public testing::TestWithParam<LawCase> {};

TEST_P(IntegratorLaws, Hold) {
  const LawCase& c = GetParam();
  std::vector<ParamList> sets = {{},
                                 {text("lightsamplestrategy", "power")},
                                 {text("strategy", "weighted")},
                                 {integers("maxdepth", {1})},
                                 {text("red", "nx"), text("blue", "dpdu")},
                                 {flag("cossample", false)},
                                 {number("stepsize", 0.3F)}};
  const laws::Declared declared(c.subject);
  std::erase_if(sets, [&](const ParamList& set) { return !declared.has(set); });
  obeyWithEach(c, sets);
}

INSTANTIATE_TEST_SUITE_P(Every, IntegratorLaws, testing::ValuesIn(lawCases(PluginKind::integrator)),
                         nameOf);

}  // namespace
}  // namespace pbrt::test
