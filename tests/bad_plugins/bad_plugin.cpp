// Compiled several times, each time wrong in one way.

#include <cstdlib>

#include "core/plugin/plugin.h"
#include "nowhere.h"

namespace {

using pbrt::PluginInfo;
using pbrt::PluginKind;

#ifdef ENDS_THE_PROCESS
[[gnu::constructor]] void runsWhenOpened() {
  std::abort();
}
#endif

void* create(pbrt::Params&, const void*) {
#if defined(MISSING_SYMBOL) || defined(MISSING_LIBRARY)
  nowhere::defined(1);
#endif
  return nullptr;
}

consteval PluginInfo describe() {
  PluginInfo info{{}, PluginKind::filter, PLUGIN_NAME, "", create, nullptr};
#if defined(NO_STAMP)
  info.stamp.magic = {};
#elif defined(OTHER_ABI)
  ++info.stamp.abi;
#elif defined(OTHER_LAYOUT)
  ++info.stamp.layout;
#elif defined(OTHER_KIND)
  info.kind = PluginKind::shape;
#elif defined(OTHER_NAME)
  info.name = "misnamed";
#endif
  return info;
}

constexpr PluginInfo kInfo = describe();

}  // namespace

#ifdef NO_ENTRY
PBRT_PLUGIN_EXPORT const PluginInfo* other_function() {
#else
PBRT_PLUGIN_EXPORT const PluginInfo* pbrt_plugin() {
#endif
#if defined(RETURNS_NOTHING)
  // Its stamp is in the file none the less.
  static const PluginInfo* volatile unused = &kInfo;
  return unused ? nullptr : &kInfo;
#elif defined(OTHER_ANSWER)
  static PluginInfo other = kInfo;
  ++other.stamp.abi;
  return &other;
#else
return &kInfo;
#endif
}
