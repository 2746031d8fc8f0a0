#pragma once
// Indices of refraction of real materials, by the wavelength in nm.

#include <array>
#include <span>
#include <string_view>

namespace pbrt {

struct OpticalConstants {
  double nm = 0;
  double eta = 0;
  double k = 0;  // the imaginary part of the index
};

struct Metal {
  std::string_view name;  // the chemical symbols
  std::span<const OpticalConstants> constants;
};

struct Glass {
  std::string_view name;
  std::array<double, 3> b{}, c{};  // of Sellmeier's equation

  double index(double nm) const;
};

extern const std::span<const Metal> kMetals;
extern const std::span<const Glass> kGlasses;

// MgO (Stephens and Malitson 1952), and the extraordinary ray in TiO2 as rutile (DeVore 1951). Both
// are clear: k is 0.
double magnesiaIndex(double nm);
double rutileIndex(double nm);

}  // namespace pbrt
