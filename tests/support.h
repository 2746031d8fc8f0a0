#pragma once
// What many tests need: plug-ins by name, made from parameters written in C++.

#include <gtest/gtest.h>

#include <initializer_list>

#include "core/plugin/loader.h"

namespace pbrt::test {

inline Param value(ParamType type, std::string name, std::vector<float> v) {
  return {type, std::move(name), {}, {}, std::move(v)};
}
inline Param number(std::string name, float v) {
  return value(ParamType::number, std::move(name), {v});
}
inline Param points(std::string name, std::vector<float> v) {
  return value(ParamType::point3, std::move(name), std::move(v));
}
inline Param rgb(std::string name, float r, float g, float b) {
  return value(ParamType::rgb, std::move(name), {r, g, b});
}
inline Param integers(std::string name, std::vector<int> v) {
  return {ParamType::integer, std::move(name), {}, {}, std::move(v)};
}
inline Param flag(std::string name, bool v) {
  return {ParamType::boolean, std::move(name), {}, {}, std::vector<int>{v ? 1 : 0}};
}
inline Param text(std::string name, std::string v) {
  return {ParamType::string, std::move(name), {}, {}, std::vector<std::string>{std::move(v)}};
}

// The plug-ins of the build under test; never closed.
inline PluginLoader& loader() {
  static PluginLoader l({PBRT_BUILD_DIR "/lib/pbrt"});
  return l;
}

// A plug-in object made as a scene would make it. Throws Error for bad parameters, unread ones
// included.
template <class Interface>
std::unique_ptr<Interface> make(const std::string& name, const ParamList& list = {},
                                const typename Interface::Setup& setup = {}) {
  const PluginInfo& plugin = loader().open(kindOf<Interface>, name);
  Params params(name, {}, {&list});
  auto object = create<Interface>(plugin, params, setup);
  params.refuseUnread();
  return object;
}

}  // namespace pbrt::test
