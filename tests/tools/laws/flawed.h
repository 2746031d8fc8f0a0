#pragma once
// Classes of a test's own before the laws, which must find what is wrong with them.

#include <gmock/gmock.h>

#include <atomic>
#include <set>
#include <thread>

#include "tests/laws.h"
#include "tools/laws/allocations.h"

namespace pbrt::test {

// A class of the test as a plug-in.
template <class Interface, class Class, class ColourClass = void>
const PluginInfo& own() {
  static const PluginInfo info = [] {
    PluginInfo plugin{};
    plugin.kind = kindOf<Interface>;
    plugin.name = "own";
    plugin.summary = "of the test";
    plugin.create = createPlugin<Interface, Class>;
    if constexpr (!std::is_void_v<ColourClass>)
      plugin.createSpectrum = createPlugin<Texture<Spectrum>, ColourClass>;
    return plugin;
  }();
  return info;
}

struct Flaw {
  const PluginInfo* plugin;
  std::string law, says;  // `says`: what one of its findings has to hold
};

// What the law of this name says of a plug-in. Fails the test if there is no such law.
inline laws::Judge judged(const laws::Subject& subject, std::string_view name) {
  laws::Judge judge;
  const auto all = laws::lawsOf(subject.plugin->kind);
  const auto law = std::ranges::find(all, name, &laws::Law::name);
  if (law == all.end())
    ADD_FAILURE() << "there is no law " << name;
  else
    law->check(subject, judge);
  return judge;
}

// Its first finding; empty if it holds.
inline std::string finding(const laws::Subject& subject, std::string_view law) {
  const laws::Judge judge = judged(subject, law);
  return judge.failures() == 0 ? "" : judge.findings()[0];
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
    const laws::Judge judge = judged(subject, law.name);
    EXPECT_THAT(judge.findings(), testing::IsEmpty()) << law.name;
    EXPECT_TRUE(judge.trials() > 0 || !judge.skipped().empty()) << law.name;
  }
}

// A number that other threads change, without being a data race.
class Shared {
 public:
  explicit Shared(float x = 0) : x_(x) {}
  // What is written is read back, if nobody else writes meanwhile. On a busy machine others come to
  // it only if this thread lets them.
  float through(float x) const {
    x_ = x;
    std::this_thread::yield();
    return x_;
  }
  // Another one for every call.
  float next() const { return x_.fetch_add(1); }

 private:
  mutable std::atomic<float> x_;
};

}  // namespace pbrt::test
