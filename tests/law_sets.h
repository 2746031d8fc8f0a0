#pragma once
// Plug-ins of the build, each with several sets of parameters, before the laws of their kind.

#include <fmt/format.h>

#include <algorithm>

#include "tests/laws.h"

namespace pbrt::test {

// One for every plug-in of the kind and every law, the parameters still to come.
inline std::vector<LawCase> lawCases(PluginKind kind) {
  std::vector<LawCase> cases;
  for (const std::string& name : loader().available(kind))
    for (const laws::Law& law : laws::lawsOf(kind)) {
      std::string test = fmt::format("{}_{}", name, law.name);
      std::ranges::replace(test, '-', '_');
      cases.push_back({test, {&loader().open(kind, name), {}, {}}, &law});
    }
  return cases;
}

inline std::string nameOf(const testing::TestParamInfo<LawCase>& c) {
  return c.param.name;
}

// Those of the sets whose names the plug-in all knows.
template <class Interface>
std::vector<ParamList> known(const PluginInfo& plugin, const std::vector<ParamList>& sets) {
  std::vector<Declaration> declared;
  Params describing = Params::describing(plugin.name, declared);
  create<Interface>(plugin, describing, {});
  std::vector<ParamList> all;
  std::ranges::copy_if(sets, std::back_inserter(all), [&](const ParamList& set) {
    return std::ranges::all_of(set, [&](const Param& p) {
      return std::ranges::find(declared, p.name, &Declaration::name) != declared.end();
    });
  });
  return all;
}

// "roughness=0.2 distribution=beckmann"
inline std::string label(const ParamList& set) {
  std::string text;
  for (const Param& p : set)
    text += fmt::format(
        "{}{}={}", text.empty() ? "" : " ", p.name,
        std::visit([](const auto& v) { return fmt::format("{}", fmt::join(v, ",")); }, p.values));
  return text;
}

// Skipped only if the law has nothing to say of any set.
inline void obeyWithEach(LawCase c, const std::vector<ParamList>& sets) {
  ASSERT_FALSE(sets.empty());
  std::string skipped;
  bool applied = false;
  for (const ParamList& set : sets) {
    SCOPED_TRACE(label(set));
    c.subject.params = set;
    laws::Judge judge;
    c.law->check(c.subject, judge);
    for (const std::string& finding : judge.findings()) ADD_FAILURE() << finding;
    EXPECT_EQ(judge.failures(), 0U) << c.law->promise;
    if (judge.skipped().empty())
      applied = true;
    else
      skipped = judge.skipped();
  }
  if (!applied) GTEST_SKIP() << skipped;
}

}  // namespace pbrt::test
