#pragma once
// Names of plug-ins and parameters that another generation has for what is called differently here:
// one table.

#include <span>

#include "core/scene/dialect.h"

namespace pbrt {

struct Translation {
  PluginKind kind;
  std::string_view name;    // in scene files
  std::string_view of;      // the generations that have it, "v1 v2"
  std::string_view target;  // the plug-in here; empty: there is none
  // Parameters that are called differently, "old new, old new"; a new name of - means that it has
  // no effect here, an old one of * all that are not named.
  std::string_view parameters;
  std::string_view differs;  // how the picture differs, for a warning; empty: it does not
};

std::span<const Translation> translations();
// Null if the name means the same everywhere.
const Translation* findTranslation(PluginKind kind, std::string_view name);

// The parameters of the plug-in that a scene calls `name` which are called otherwise here.
std::vector<std::string> renamedParameters(PluginKind kind, std::string_view name);

// Changes the parameters of the plug-in that a scene calls `name` to what they are called and mean
// here: by the table, and
//  - maxdepth of pbrt-v1's integrators counts mirrors, that of the later ones rays; that of path in
//    v1 and v2 leaves out the first scattering;
//  - v4's gaussian filter has a width, sigma, where ours has alpha = 1 / (2 sigma^2);
//  - v2's imagemap raises what it scaled to the power gamma, a number; ours has an encoding. That
//  of
//    a picture of light (.exr, .pfm) is left alone;
//  - v4 calls the ways in which path chooses lights otherwise.
void translateParameters(Dialect dialect, PluginKind kind, const std::string& name,
                         ParamList& params);

}  // namespace pbrt
