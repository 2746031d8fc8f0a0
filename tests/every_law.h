#pragma once
// Every plug-in of a kind before every law of its kind: one test each.

#include <functional>

#include "tests/laws.h"

namespace pbrt::test {

// A law and a plug-in in the forms in which it is tried.
struct EveryLawCase {
  std::string name;  // of the test
  std::vector<laws::Subject> subjects;
  const laws::Law* law = nullptr;
};

inline void PrintTo(const EveryLawCase& c, std::ostream* out) {
  *out << c.law->promise;
}

// `forms`: the parameters and traits of a plug-in, by its name.
inline std::vector<EveryLawCase> everyLaw(
    PluginKind kind, const std::function<std::vector<laws::Subject>(const PluginInfo&)>& forms) {
  std::vector<EveryLawCase> cases;
  for (const std::string& plugin : loader().available(kind)) {
    const std::vector<laws::Subject> subjects = forms(loader().open(kind, plugin));
    for (const laws::Law& law : laws::lawsOf(kind)) {
      std::string name = plugin + "_" + std::string(law.name);
      std::ranges::replace(name, '-', '_');
      cases.push_back({name, subjects, &law});
    }
  }
  return cases;
}

class EveryLaw : public testing::TestWithParam<EveryLawCase> {
 public:
  static std::string name(const testing::TestParamInfo<EveryLawCase>& test) {
    return test.param.name;
  }
};

TEST_P(EveryLaw, IsObeyed) {
  for (const laws::Subject& subject : GetParam().subjects) obey(subject, *GetParam().law);
}

}  // namespace pbrt::test
