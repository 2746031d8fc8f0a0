#pragma once
// Plug-ins with a flaw each, and the laws that must find it.

#include <set>

#include "tests/laws.h"
#include "tools/laws/allocations.h"

namespace pbrt::test {

// A plug-in of a class that is in no shared object.
template <class Interface, class Class>
const PluginInfo* pluginOf() {
  static const PluginInfo info{
      {}, kindOf<Interface>, "flawed", "only for tests", createPlugin<Interface, Class>, nullptr};
  return &info;
}

struct Flaw {
  const PluginInfo* plugin;
  std::string law, says;  // `says`: what one of its findings has to hold
};

inline laws::Judge judged(const laws::Subject& subject, std::string_view name) {
  laws::Judge judge;
  for (const laws::Law& law : laws::lawsOf(subject.plugin->kind))
    if (law.name == name) law.check(subject, judge);
  return judge;
}

// Every flaw is found, and there is one for every law.
inline void expectFound(PluginKind kind, const std::vector<Flaw>& flaws) {
  std::set<std::string_view> tried;
  for (const Flaw& flaw : flaws) {
    tried.insert(flaw.law);
    if (flaw.law == "allocates-nothing" && !laws::countsAllocations()) continue;
    const laws::Judge judge = judged({flaw.plugin}, flaw.law);
    const std::string findings = fmt::format("{}", fmt::join(judge.findings(), "\n"));
    EXPECT_GT(judge.failures(), 0U) << flaw.law << ": " << flaw.says << judge.skipped();
    EXPECT_NE(findings.find(flaw.says), std::string::npos) << flaw.says << ": " << findings;
  }
  for (const laws::Law& law : laws::lawsOf(kind)) EXPECT_TRUE(tried.contains(law.name)) << law.name;
}

// The same without the flaw obeys them all.
inline void expectGood(const laws::Subject& subject) {
  for (const laws::Law& law : laws::lawsOf(subject.plugin->kind)) {
    SCOPED_TRACE(law.name);
    laws::Judge judge;
    law.check(subject, judge);
    for (const std::string& finding : judge.findings()) ADD_FAILURE() << finding;
  }
}

}  // namespace pbrt::test
