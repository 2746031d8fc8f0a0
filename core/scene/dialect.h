#pragma once
// The generations of the scene format: which of them a scene is written for, and what each uses
// where the scene says nothing. Names that differ are in translation.h.

#include <optional>
#include <string>
#include <vector>

#include "core/parse/directive.h"
#include "core/plugin/kind.h"

namespace pbrt {

enum class Dialect : std::uint8_t { v1 = 1, v2 = 2, v3 = 3, v4 = 4 };

std::optional<Dialect> dialectByName(std::string_view name);  // "v1" ... "v4"
std::string_view dialectName(Dialect dialect);

struct DetectedDialect {
  Dialect dialect = Dialect::v2;
  Location where;      // the statement that told; nowhere if there was none
  std::string reason;  // in words
};

// Finds out which generation a scene is written for. Each statement leaves those that could have
// it; one that none of those left could have tells nothing, as real files mix.
class DialectDetector {
 public:
  void look(const Directive& d);
  // Whether only one is left: no further statement changes that.
  bool decided() const { return (left_ & (left_ - 1)) == 0; }
  // Of a scene that is complete. Without WorldEnd it is v4 if it can be; what is left open is v2
  // before v3.
  DetectedDialect result() const;

 private:
  std::uint8_t left_ = 0b1111;  // bit i: v(i + 1)
  bool world_ = false, worldEnd_ = false;
  Location where_;
  std::string told_;  // the statement that left the fewest
};

// The plug-in that a MakeNamedMaterial or MakeNamedMedium statement names; empty if it names none.
std::string namedType(const Directive& d);

// Of a whole scene.
DetectedDialect detectDialect(const std::vector<Directive>& scene);

// What a generation uses where the scene file says nothing.
struct DialectDefaults {
  std::string filter, sampler, integrator, camera, material;
  Point2i resolution{0};
};
const DialectDefaults& dialectDefaults(Dialect dialect);

// The default parameters of a plug-in, by the name that the scene file uses, where they differ from
// the plug-in's own, which are v3's.
const ParamList& parameterDefaults(Dialect dialect, PluginKind kind, const std::string& name);

}  // namespace pbrt
