#include "core/plugin/params.h"

#include <fmt/format.h>

#include <array>
#include <cstring>

namespace pbrt {

namespace {

// An integer is a number; every other type is taken as written.
constexpr std::array kNumber{ParamType::number, ParamType::integer};
constexpr std::array kInteger{ParamType::integer};
constexpr std::array kBoolean{ParamType::boolean};
constexpr std::array kString{ParamType::string};
constexpr std::array kPoint2{ParamType::point2, ParamType::vector2, ParamType::number};
constexpr std::array kVector3{ParamType::vector3, ParamType::point3, ParamType::normal};

std::string show(const Vec3& v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

}  // namespace

Params::Params(std::string what, Location where, std::vector<const ParamList*> lists,
               TextureLibrary* textures, Reporter report, const ParamList* defaults)
    : what_(std::move(what)),
      where_(where),
      defaults_(defaults),
      textures_(textures),
      report_(std::move(report)) {
  for (const ParamList* list : lists) uses_.push_back({list, std::vector<bool>(list->size())});
}

Params Params::describing(std::string what, std::vector<Declaration>& declarations) {
  Params p(std::move(what), {}, {});
  p.declarations_ = &declarations;
  return p;
}

void Params::declare(const std::string& name, std::string_view type, std::string fallback,
                     std::string_view meaning, std::string_view unit) {
  known_.push_back(name);
  if (declarations_)
    declarations_->push_back(
        {name, std::string(type), std::move(fallback), std::string(meaning), std::string(unit)});
}

// The value to use for a name, or null. Of the same name twice in one list the last one counts, as
// in every pbrt; one that another list hides counts as read.
const Param* Params::find(const std::string& name, std::span<const ParamType> types,
                          std::string_view wanted) {
  const Param* found = nullptr;
  for (Use& use : uses_) {
    const Param* here = nullptr;
    for (std::size_t i = 0; i < use.list->size(); ++i)
      if ((*use.list)[i].name == name) {
        use.read[i] = true;
        here = &(*use.list)[i];
      }
    if (!found) found = here;
  }
  if (!found && defaults_)
    for (const Param& p : *defaults_)
      if (p.name == name) found = &p;
  if (found && std::find(types.begin(), types.end(), found->type) == types.end())
    fail(name, fmt::format("has type \"{}\" but must be \"{}\"", typeName(found->type), wanted));
  return found;
}

bool Params::available(const std::string& name) const {
  const auto isNamed = [&](const Param& p) { return p.name == name; };
  return has(name) || (defaults_ && std::any_of(defaults_->begin(), defaults_->end(), isNamed));
}

template <class V>
std::vector<V> Params::list(const std::string& name, std::span<const ParamType> types,
                            std::string_view type, std::string_view meaning,
                            std::string_view unit) {
  declare(name, type, "-", meaning, unit);
  const Param* p = find(name, types, type);
  if (!p) return {};
  if constexpr (std::is_same_v<V, int>) {
    return std::get<std::vector<int>>(p->values);
  } else if constexpr (std::is_same_v<V, float>) {
    return numbersOf(*p);
  } else {
    const auto& flat = std::get<std::vector<float>>(p->values);
    constexpr std::size_t n = sizeof(V) / sizeof(float);
    if (flat.size() % n)
      fail(name, fmt::format("has {} numbers, which is not a multiple of {}", flat.size(), n));
    // One copy, as there may be millions.
    std::vector<V> values(flat.size() / n);
    if (!values.empty()) std::memcpy(values.data(), flat.data(), flat.size() * sizeof(float));
    return values;
  }
}

namespace {

// The only value of a parameter that stands for one.
template <class V>
V single(const Params& params, const Param& p) {
  const std::vector<float> flat = numbersOf(p);
  constexpr std::size_t n = sizeof(V) / sizeof(float);
  if (flat.size() != n)
    params.fail(p.name,
                fmt::format("needs {} number{}, not {}", n, n == 1 ? "" : "s", flat.size()));
  V value{};
  std::memcpy(&value, flat.data(), sizeof value);
  return value;
}

}  // namespace

float Params::onlyNumber(const Param& p) const {
  return single<float>(*this, p);
}

float Params::number(const std::string& name, float fallback, std::string_view meaning,
                     std::string_view unit) {
  declare(name, "float", fmt::format("{}", fallback), meaning, unit);
  const Param* p = find(name, kNumber, "float");
  return p ? onlyNumber(*p) : fallback;
}

float Params::positive(const std::string& name, float fallback, std::string_view meaning,
                       std::string_view unit) {
  const float v = number(name, fallback, meaning, unit);
  if (!(v > 0)) fail(name, fmt::format("must be above 0, not {}", v));
  return v;
}

float Params::nonNegative(const std::string& name, float fallback, std::string_view meaning,
                          std::string_view unit) {
  const float v = number(name, fallback, meaning, unit);
  if (!(v >= 0)) fail(name, fmt::format("must not be below 0, but is {}", v));
  return v;
}

float Params::inRange(const std::string& name, float fallback, float lo, float hi,
                      std::string_view meaning, std::string_view unit) {
  const float v = number(name, fallback, meaning, unit);
  if (!(v >= lo && v <= hi)) fail(name, fmt::format("must be from {} to {}, not {}", lo, hi, v));
  return v;
}

std::optional<float> Params::optionalNumber(const std::string& name, std::string_view meaning,
                                            std::string_view unit) {
  declare(name, "float", "-", meaning, unit);
  const Param* p = find(name, kNumber, "float");
  if (!p) return {};
  return onlyNumber(*p);
}

int Params::integer(const std::string& name, int fallback, int lo, int hi,
                    std::string_view meaning) {
  declare(name, "integer", fmt::format("{}", fallback), meaning);
  const Param* p = find(name, kInteger, "integer");
  if (!p) return fallback;
  const auto& values = std::get<std::vector<int>>(p->values);
  if (values.size() != 1) fail(name, fmt::format("needs 1 integer, not {}", values.size()));
  if (values[0] < lo || values[0] > hi)
    fail(name, fmt::format("must be from {} to {}, not {}", lo, hi, values[0]));
  return values[0];
}

bool Params::flag(const std::string& name, bool fallback, std::string_view meaning) {
  declare(name, "bool", fallback ? "true" : "false", meaning);
  const Param* p = find(name, kBoolean, "bool");
  if (!p) return fallback;
  const auto& values = std::get<std::vector<int>>(p->values);
  if (values.size() != 1) fail(name, fmt::format("needs 1 bool, not {}", values.size()));
  return values[0] != 0;
}

std::string Params::text(const std::string& name, const std::string& fallback,
                         std::string_view meaning) {
  declare(name, "string", '"' + fallback + '"', meaning);
  const Param* p = find(name, kString, "string");
  if (!p) return fallback;
  const auto& values = std::get<std::vector<std::string>>(p->values);
  if (values.size() != 1) fail(name, fmt::format("needs 1 string, not {}", values.size()));
  return values[0];
}

std::string Params::choice(const std::string& name, std::span<const std::string_view> allowed,
                           std::string_view fallback, std::string_view meaning) {
  std::string value =
      text(name, std::string(fallback), fmt::format("{} ({})", meaning, fmt::join(allowed, ", ")));
  refuseOthers(name, value, allowed);
  return value;
}

std::vector<std::string> Params::choices(const std::string& name,
                                         std::span<const std::string_view> allowed,
                                         std::string_view meaning) {
  declare(name, "string", "-", fmt::format("{} (any of {})", meaning, fmt::join(allowed, ", ")));
  const Param* p = find(name, kString, "string");
  if (!p) return {};
  auto values = std::get<std::vector<std::string>>(p->values);
  for (const std::string& value : values) refuseOthers(name, value, allowed);
  return values;
}

void Params::refuseOthers(const std::string& name, const std::string& value,
                          std::span<const std::string_view> allowed) const {
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
  const std::vector<std::string> names(allowed.begin(), allowed.end());
  fail(name, fmt::format("cannot be \"{}\" (it is one of {}){}", value, fmt::join(names, ", "),
                         didYouMean(value, names)));
}

Point3 Params::point(const std::string& name, const Point3& fallback, std::string_view meaning) {
  declare(name, "point3", show(fallback), meaning);
  const Param* p = find(name, kVector3, "point3");
  return p ? single<Point3>(*this, *p) : fallback;
}

Vec3 Params::vector(const std::string& name, const Vec3& fallback, std::string_view meaning) {
  declare(name, "vector3", show(fallback), meaning);
  const Param* p = find(name, kVector3, "vector3");
  return p ? single<Vec3>(*this, *p) : fallback;
}

std::vector<float> Params::numbers(const std::string& name, std::string_view meaning,
                                   std::string_view unit) {
  return list<float>(name, kNumber, "float", meaning, unit);
}
std::vector<int> Params::integers(const std::string& name, std::string_view meaning) {
  return list<int>(name, kInteger, "integer", meaning);
}
std::vector<Point2> Params::points2(const std::string& name, std::string_view meaning) {
  return list<Point2>(name, kPoint2, "point2", meaning);
}
std::vector<Point3> Params::points(const std::string& name, std::string_view meaning) {
  return list<Point3>(name, kVector3, "point3", meaning);
}
std::vector<Vec3> Params::vectors(const std::string& name, std::string_view meaning) {
  return list<Vec3>(name, kVector3, "vector3", meaning);
}
std::vector<Normal3> Params::normals(const std::string& name, std::string_view meaning) {
  return list<Normal3>(name, kVector3, "normal", meaning);
}

}  // namespace pbrt
