#include "core/plugin/param.h"

namespace pbrt {

std::string_view typeName(ParamType type) {
  switch (type) {
    case ParamType::boolean:
      return "bool";
    case ParamType::integer:
      return "integer";
    case ParamType::number:
      return "float";
    case ParamType::point2:
      return "point2";
    case ParamType::vector2:
      return "vector2";
    case ParamType::point3:
      return "point3";
    case ParamType::vector3:
      return "vector3";
    case ParamType::normal:
      return "normal";
    case ParamType::rgb:
      return "rgb";
    case ParamType::xyz:
      return "xyz";
    case ParamType::blackbody:
      return "blackbody";
    case ParamType::spectrum:
      return "spectrum";
    case ParamType::string:
      return "string";
    case ParamType::texture:
      return "texture";
  }
  return "";
}

std::vector<float> numbersOf(const Param& param) {
  if (const auto* ints = std::get_if<std::vector<int>>(&param.values))
    return {ints->begin(), ints->end()};
  return std::get<std::vector<float>>(param.values);
}

}  // namespace pbrt
