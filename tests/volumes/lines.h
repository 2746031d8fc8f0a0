#pragma once
// Lines through media, and what theory says about light on them.

#include <functional>

#include "core/api/medium_walk.h"
#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt::test {

// Media of every plug-in, with whatever parameters it needs; grids have steps in their densities.
struct MediumOfTest {
  std::string name;
  std::unique_ptr<Medium> medium;
};

inline std::vector<MediumOfTest> everyMedium(const Medium::Setup& setup) {
  const ParamList sigmas = {rgb("sigma_a", 0.2F, 0.4F, 0.1F), rgb("sigma_s", 0.3F, 0.9F, 2),
                            rgb("Le", 1, 0.5F, 0.25F)};
  const std::vector<float> densities = {0.5F, 0, 3, 1, 0.1F, 0, 0, 8, 1, 2, 0.3F, 0.7F};
  ParamList boxed = sigmas, grid = sigmas, colours;
  boxed.push_back(points("p0", {0, 0, 0}));
  grid.push_back(value(ParamType::number, "density", densities));
  for (ParamList* list : {&grid, &colours})
    for (const auto& [name, n] : {std::pair("nx", 2), std::pair("ny", 3), std::pair("nz", 2)})
      list->push_back(integers(name, {n}));
  std::vector<float> flat;
  for (const float d : densities) flat.insert(flat.end(), {d, 2 * d, 0.5F + d});
  for (const char* name : {"sigma_a", "sigma_s", "Le"})
    colours.push_back(value(ParamType::rgb, name, flat));

  std::vector<MediumOfTest> all;
  for (const std::string& name : loader().available(PluginKind::volume)) {
    std::unique_ptr<Medium> medium;
    std::string why;
    for (const ParamList* list : {&boxed, &grid, &colours}) try {
        medium = make<Medium>(name, *list, setup);
        break;
      } catch (const Error& error) {
        why += error.what();
      }
    EXPECT_TRUE(medium) << name << ": " << why;
    if (medium) all.push_back({name, std::move(medium)});
  }
  return all;
}

// A straight way of some length.
struct Way {
  DPoint3 o{};
  DVec3 w{};
  double length = 0;
};

// What happens to light that comes along a way to its start, by quadrature in double.
struct Theory {
  DVec3 transmittance{1}, scattered{0}, emitted{0};  // exp(-tau); of sigma_s and of Le behind it
};

inline Theory theory(const Medium& medium, const Way& way, int steps = 20000) {
  Theory t;
  const double h = way.length / steps;
  for (int i = 0; i < steps; ++i) {
    const MediumPoint m = medium.at(way.o + (i + 0.5) * h * way.w);
    const DVec3 before = t.transmittance;
    t.transmittance *= glm::exp(-DVec3(m.extinction()) * h);
    const DVec3 between = 0.5 * (before + t.transmittance);
    t.scattered += between * DVec3(m.scattering) * h;
    t.emitted += between * DVec3(m.emission) * h;
  }
  return t;
}

}  // namespace pbrt::test
