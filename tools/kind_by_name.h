#pragma once
// Kinds of plug-ins as people write them.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/plugin/kind.h"

namespace pbrt {

// "shape" or "shapes". Throws Error, Failure::usage, with "did you mean", if there is no such kind.
inline PluginKind kindByName(const std::string& name) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i) {
    const auto kind = static_cast<PluginKind>(i);
    if (name == kindName(kind) || name == kindFolder(kind)) return kind;
    names.emplace_back(kindName(kind));
  }
  throw Error(fmt::format("there is no kind of plug-in \"{}\" (it is one of {}){}", shown(name),
                          fmt::join(names, ", "), didYouMean(name, names)),
              Failure::usage);
}

}  // namespace pbrt
