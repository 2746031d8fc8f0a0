#pragma once
// What a particle can have, by which names files call it, and where its numbers go.

#include <optional>
#include <span>

#include "particles.h"
#include "shapes/files/input.h"
#include "shapes/files/records.h"

namespace pbrt::particles {

using files::Input, files::NumberType, files::Target;

enum class Quantity : std::uint8_t { position, radius, color, velocity, strength };

constexpr std::uint8_t components(Quantity q) {
  return q == Quantity::radius || q == Quantity::strength ? 1 : 3;
}

// One number of a particle.
struct Slot {
  Quantity quantity = Quantity::position;
  std::uint8_t component = 0;
  friend bool operator==(const Slot&, const Slot&) = default;
};

// A column for each name: the number it holds, or nothing that we read. Case is free. A quantity
// of which a component is missing is not read; positions must be there.
using Columns = std::vector<std::optional<Slot>>;
Columns columnsOf(std::span<const std::string> names, const Input& input);

// What an array of this name holds if it has so many numbers a particle; a fourth number of a
// colour or position (opacity, weight) is allowed.
std::optional<Quantity> quantityOf(std::string_view name, std::size_t numbers);

// Makes room for `count` particles.
void allocate(Particles& particles, Quantity quantity, std::size_t count);
void allocate(Particles& particles, const Columns& columns, std::size_t count);

// Where one number of every particle goes. Valid until the next allocation.
Target target(Particles& particles, Slot slot);

}  // namespace pbrt::particles
