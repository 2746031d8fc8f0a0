#pragma once
// The generations of the scene format, and what differs between them: one table for each
// difference.

#include <optional>
#include <string>
#include <vector>

#include "core/parse/directive.h"
#include "core/plugin/kind.h"

namespace pbrt {

enum class Dialect : std::uint8_t { v1 = 1, v2 = 2, v3 = 3 };

std::optional<Dialect> dialectByName(std::string_view name);  // "v1", "v2", "v3"
std::string_view dialectName(Dialect dialect);

struct DetectedDialect {
  Dialect dialect = Dialect::v2;
  Location where;      // the tell-tale; nowhere if there was none
  std::string reason;  // in words
};
// The first statement that only one generation has decides; without one it is v2.
DetectedDialect detectDialect(const std::vector<Directive>& scene);

// What a generation uses where the scene file says nothing.
struct DialectDefaults {
  std::string filter, sampler, integrator, camera, material;
  Point2i resolution{0};
};
const DialectDefaults& dialectDefaults(Dialect dialect);

// The default parameters of a plug-in where they differ from the plug-in's own, which are v3's.
const ParamList& parameterDefaults(Dialect dialect, PluginKind kind, const std::string& name);

// Changes parameters of a plug-in that mean something else in a generation to what they mean here:
// the maxdepth of pbrt-v1's integrators counts mirrors, that of the later ones rays; that of path
// in v1 and v2 leaves out the first scattering.
void translateParameters(Dialect dialect, PluginKind kind, const std::string& name,
                         ParamList& params);

// A name under which a plug-in is known to scene files, and the one that it has here.
struct Alias {
  PluginKind kind;
  std::string_view name, target;
  bool exact;  // false: a stand-in that gives a similar picture; worth a warning
};
const Alias* findAlias(PluginKind kind, std::string_view name);

}  // namespace pbrt
