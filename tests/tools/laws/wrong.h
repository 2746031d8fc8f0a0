#pragma once
// Classes of a test's own before the laws, which must find what is wrong with them.

#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "tests/laws.h"

namespace pbrt::test {

// What the law of this name says of a plug-in. Fails the test if there is no such law.
inline laws::Judge judged(const PluginInfo& plugin, std::string_view law,
                          laws::Traits traits = {}) {
  laws::Judge judge;
  const auto all = laws::lawsOf(plugin.kind);
  const auto found = std::ranges::find(all, law, &laws::Law::name);
  if (found == all.end())
    ADD_FAILURE() << "there is no law " << law;
  else
    found->check({&plugin, {}, traits}, judge);
  return judge;
}

// Its first finding; empty if it holds.
inline std::string finding(const PluginInfo& plugin, std::string_view law) {
  const laws::Judge judge = judged(plugin, law);
  return judge.failures() == 0 ? "" : judge.findings()[0];
}

inline void expectAllHold(const PluginInfo& plugin) {
  for (const laws::Law& law : laws::lawsOf(plugin.kind)) {
    const laws::Judge judge = judged(plugin, law.name);
    EXPECT_THAT(judge.findings(), testing::IsEmpty()) << law.name;
    EXPECT_TRUE(judge.trials() > 0 || !judge.skipped().empty()) << law.name;
  }
}

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
