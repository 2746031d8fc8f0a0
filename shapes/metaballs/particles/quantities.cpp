#include "quantities.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "shapes/files/scanner.h"

namespace pbrt::particles {

using files::lowered;

namespace {

using enum Quantity;

struct Name {
  std::string_view name;
  Quantity quantity;
};
constexpr Name kNames[] = {{"p", position},    {"position", position}, {"points", position},
                           {"radius", radius}, {"pscale", radius},     {"cd", color},
                           {"color", color},   {"colour", color},      {"rgb", color},
                           {"v", velocity},    {"velocity", velocity}, {"strength", strength}};

struct Letters {
  std::array<std::string_view, 3> names;
  Quantity quantity;
};
constexpr Letters kComponents[] = {{{"x", "y", "z"}, position},
                                   {{"red", "green", "blue"}, color},
                                   {{"r", "g", "b"}, color},
                                   {{"vx", "vy", "vz"}, velocity}};

std::optional<Quantity> named(std::string_view lower) {
  for (const auto& [name, quantity] : kNames)
    if (name == lower) return quantity;
  return {};
}

// Also one component of a vector, as other programs export it: Points:0, P.x, Cd_r, v[2].
std::optional<Slot> slotOf(std::string_view lower) {
  for (const auto& [names, quantity] : kComponents)
    for (std::uint8_t i = 0; i < 3; ++i)
      if (names[i] == lower) return Slot{quantity, i};
  const std::optional<Quantity> whole = named(lower);
  if (whole && components(*whole) == 1) return Slot{*whole, 0};

  const std::size_t mark = lower.find_first_of(":._[");
  if (mark == lower.npos) return {};
  const std::optional<Quantity> vector = named(lower.substr(0, mark));
  std::string_view letter = lower.substr(mark + 1);
  if (lower[mark] == '[' && letter.ends_with(']')) letter.remove_suffix(1);
  if (!vector || components(*vector) != 3 || letter.size() != 1) return {};
  for (const std::string_view letters : {"012", *vector == color ? "rgb" : "xyz"})
    if (const std::size_t i = letters.find(letter); i != letters.npos)
      return Slot{*vector, static_cast<std::uint8_t>(i)};
  return {};
}

template <class Use>
void with(Particles& particles, Quantity quantity, Use use) {
  switch (quantity) {
    case position:
      return use(particles.positions);
    case radius:
      return use(particles.radii);
    case color:
      return use(particles.colors);
    case velocity:
      return use(particles.velocities);
    case strength:
      return use(particles.strengths);
  }
}

}  // namespace

Columns columnsOf(std::span<const std::string> names, const Input& input) {
  std::vector<std::string> lower;
  for (const std::string& name : names) lower.push_back(lowered(name));
  const auto has = [&](std::string_view name) {
    return std::find(lower.begin(), lower.end(), name) != lower.end();
  };
  // The letter r alone is a radius, with g and b a colour.
  const bool redGreenBlue = has("r") && has("g") && has("b");

  Columns columns;
  for (const std::string& name : lower) {
    std::optional<Slot> slot = slotOf(name);
    if (name == "r" && !redGreenBlue) slot = Slot{radius, 0};
    if (std::find(columns.begin(), columns.end(), slot) != columns.end()) slot.reset();
    columns.push_back(slot);
  }

  for (const Quantity q : {position, color, velocity}) {
    const auto isOf = [q](const std::optional<Slot>& slot) { return slot && slot->quantity == q; };
    if (std::count_if(columns.begin(), columns.end(), isOf) == 3) continue;
    if (q == position)
      input.fail(fmt::format("has no positions: x, y and z are not among its columns ({})",
                             fmt::join(names, ", ")));
    std::replace_if(columns.begin(), columns.end(), isOf, std::nullopt);
  }
  return columns;
}

std::optional<Quantity> quantityOf(std::string_view name, std::size_t numbers) {
  const std::optional<Quantity> quantity = named(lowered(name));
  if (!quantity) return {};
  const std::size_t needed = components(*quantity);
  if (numbers == needed || (needed == 3 && numbers == 4 && quantity != velocity)) return quantity;
  return {};
}

void allocate(Particles& particles, Quantity quantity, std::size_t count) {
  with(particles, quantity, [count](auto& values) { values.resize(count); });
}

void allocate(Particles& particles, const Columns& columns, std::size_t count) {
  for (const std::optional<Slot>& slot : columns)
    if (slot) allocate(particles, slot->quantity, count);
}

Target target(Particles& particles, Slot slot) {
  Target to;
  to.stride = components(slot.quantity);
  with(particles, slot.quantity, [&](auto& values) {
    if (!values.empty()) to.first = reinterpret_cast<float*>(values.data()) + slot.component;
  });
  return to;
}

}  // namespace pbrt::particles
