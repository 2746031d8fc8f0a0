#pragma once
// Every plug-in of a kind before every law of its kind: one test each.

#include <functional>

#include "tests/laws.h"
#include "tools/laws/parameters.h"

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
    if (subjects.empty()) continue;
    for (const laws::Law& law : laws::lawsOf(kind)) {
      std::string name = plugin + "_" + std::string(law.name);
      std::ranges::replace(name, '-', '_');
      cases.push_back({name, subjects, &law});
    }
  }
  return cases;
}

// The plug-in with each of those sets of parameters whose names it all knows.
template <class Interface>
std::vector<laws::Subject> subjects(const PluginInfo& plugin, const std::vector<ParamList>& sets,
                                    laws::Traits traits = {}) {
  const laws::Declared<Interface> declared({&plugin, {}, {}});
  std::vector<laws::Subject> all;
  for (const ParamList& set : sets)
    if (declared.has(set)) all.push_back({&plugin, set, traits});
  return all;
}

// "roughness=0.2 distribution=beckmann"
inline std::string label(const ParamList& params) {
  std::vector<std::string> words;
  for (const Param& p : params)
    words.push_back(std::visit(
        [&](const auto& v) { return fmt::format("{}={}", p.name, fmt::join(v, ",")); }, p.values));
  return fmt::format("{}", fmt::join(words, " "));
}

class EveryLaw : public testing::TestWithParam<EveryLawCase> {
 public:
  static std::string name(const testing::TestParamInfo<EveryLawCase>& test) {
    return test.param.name;
  }
};

// Skipped only if the law has nothing to say of any form.
TEST_P(EveryLaw, IsObeyed) {
  const auto& [name, subjects, law] = GetParam();
  std::string skipped;
  bool applied = false;
  for (const laws::Subject& subject : subjects) {
    SCOPED_TRACE(label(subject.params));
    laws::Judge judge;
    law->check(subject, judge);
    for (const std::string& finding : judge.findings()) ADD_FAILURE() << finding;
    EXPECT_EQ(judge.failures(), 0U) << law->promise;
    applied |= judge.skipped().empty();
    skipped = judge.skipped();
  }
  if (!applied) GTEST_SKIP() << skipped;
}

}  // namespace pbrt::test
