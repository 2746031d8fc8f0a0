#pragma once
// Puts the plug-ins of the build to the laws of their kind.

#include "tests/support.h"
#include "tools/laws/laws.h"

namespace pbrt::test {

// A plug-in of the build, made with parameters, before a law.
struct LawCase {
  std::string name;  // of the test: letters, digits and _
  laws::Subject subject;
  const laws::Law* law = nullptr;
};

inline void PrintTo(const LawCase& c, std::ostream* out) {
  *out << c.subject.plugin->name << ": " << c.law->promise;
}

inline void obey(const laws::Subject& subject, const laws::Law& law) {
  laws::Judge judge;
  law.check(subject, judge);
  for (const std::string& finding : judge.findings()) ADD_FAILURE() << finding;
  EXPECT_LE(judge.failures(), 0U) << law.promise;
  if (!judge.skipped().empty()) GTEST_SKIP() << judge.skipped();
}

}  // namespace pbrt::test
