// Every integrator that can be found obeys the laws of integrators: tools/laws/integrator_laws.cpp.

#include "tests/every_law.h"

namespace pbrt::test {
namespace {

// Those of these that it takes; one for volumes adds to another.
std::vector<laws::Subject> forms(const PluginInfo& integrator) {
  const auto surface = make<Integrator>("directlighting");
  std::vector<laws::Subject> forms;
  for (const ParamList& list : std::vector<ParamList>{{},
                                                      {text("lightsamplestrategy", "power")},
                                                      {text("strategy", "weighted")},
                                                      {integers("maxdepth", {1})},
                                                      {text("red", "nx"), text("blue", "dpdu")},
                                                      {flag("cossample", false)},
                                                      {number("stepsize", 0.3F)}})
    if (const laws::Subject form{&integrator, list, {}};
        laws::accepts<Integrator>(form, {}, {surface->sampling()}))
      forms.push_back(form);
  return forms;
}

INSTANTIATE_TEST_SUITE_P(Integrators, EveryLaw,
                         testing::ValuesIn(everyLaw(PluginKind::integrator, forms)),
                         EveryLaw::name);

}  // namespace
}  // namespace pbrt::test
