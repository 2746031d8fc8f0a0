// Compiled several times, each time wrong in one way.

#include "core/plugin/plugin.h"

extern "C" void nowhereDefined();

namespace {

using pbrt::PluginInfo;
using pbrt::PluginKind;

#ifdef MISSING_SYMBOL
void* create(pbrt::Params&, const void*) {
  nowhereDefined();
  return nullptr;
}
#else
void* create(pbrt::Params&, const void*) {
  return nullptr;
}
#endif

[[maybe_unused]] PluginInfo describe() {
  PluginInfo info{pbrt::kAbiVersion,
                  pbrt::compiledFingerprint(),
                  PluginKind::filter,
                  PLUGIN_NAME,
                  "",
                  create,
                  nullptr};
#if defined(OTHER_ABI)
  ++info.abi;
#elif defined(OTHER_LAYOUT)
  ++info.layout;
#elif defined(OTHER_KIND)
  info.kind = PluginKind::shape;
#elif defined(OTHER_NAME)
  info.name = "misnamed";
#endif
  return info;
}

}  // namespace

#ifdef NO_ENTRY
PBRT_PLUGIN_EXPORT const PluginInfo* other_function() {
#else
PBRT_PLUGIN_EXPORT const PluginInfo* pbrt_plugin() {
#endif
#ifdef RETURNS_NOTHING
  return nullptr;
#else
  static const PluginInfo info = describe();
  return &info;
#endif
}
