#pragma once
// One parameter as the scene file gives it: `"float radius" [2]`.

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/error.h"

namespace pbrt {

enum class ParamType : std::uint8_t {
  boolean,
  integer,
  number,
  point2,
  vector2,
  point3,
  vector3,
  normal,
  rgb,
  xyz,
  blackbody,
  spectrum,
  string,
  texture
};

// The name a scene file uses for a type ("float", "rgb", ...).
std::string_view typeName(ParamType type);

struct Param {
  ParamType type = ParamType::number;
  std::string name;
  Location where;       // the quoted declaration
  Location valueWhere;  // the value or the bracketed list
  // floats: number, point2 ... normal, rgb, xyz, blackbody, spectrum (as given, flat)
  // ints: integer, boolean (0 or 1)
  // strings: string, texture, and spectrum given by name or file
  std::variant<std::vector<float>, std::vector<int>, std::vector<std::string>> values;
};

// Its numbers as floats. It has floats or ints.
std::vector<float> numbersOf(const Param& param);

using ParamList = std::vector<Param>;

}  // namespace pbrt
