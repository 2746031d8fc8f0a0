#pragma once
// Lines through media, and what theory says about light on them.

#include <functional>

#include "core/api/medium_walk.h"
#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt::test {

// Media of every plug-in, with each of these lists of parameters that it takes: plain ones; grids
// with steps in their densities, and the same opaque in red and clear in blue; a grid of one
// density that glows here and there.
struct MediumOfTest {
  std::string name;
  std::unique_ptr<Medium> medium;
};

inline std::vector<MediumOfTest> everyMedium(const Medium::Setup& setup) {
  const ParamList sigmas = {rgb("sigma_a", 0.2F, 0.4F, 0.1F), rgb("sigma_s", 0.3F, 0.9F, 2),
                            rgb("Le", 1, 0.5F, 0.25F)};
  const std::vector<float> densities = {0.5F, 0, 3, 1, 0.1F, 0, 0, 8, 1, 2, 0.3F, 0.7F};
  ParamList boxed = sigmas, grid = sigmas, colours;
  ParamList unlike = {rgb("sigma_a", 60, 0.5F, 0), rgb("sigma_s", 30, 0.5F, 0)};
  ParamList flames = {rgb("sigma_a", 0.2F, 0.4F, 0.1F)};
  boxed.push_back(points("p0", {0, 0, 0}));
  for (ParamList* list : {&grid, &unlike})
    list->push_back(value(ParamType::number, "density", densities));
  flames.push_back(value(ParamType::number, "density", std::vector<float>(densities.size(), 2)));
  flames.push_back(value(ParamType::number, "Lescale", densities));
  flames.push_back(value(ParamType::number, "temperature",
                         {900, 3000, 0, 2000, 2500, 0, 0, 1800, 2200, 3000, 4000, 1500}));
  for (ParamList* list : {&grid, &unlike, &flames, &colours})
    for (const auto& [name, n] : {std::pair("nx", 2), std::pair("ny", 3), std::pair("nz", 2)})
      list->push_back(integers(name, {n}));
  std::vector<float> flat;
  for (const float d : densities) flat.insert(flat.end(), {d, 2 * d, 0.5F + d});
  for (const char* name : {"sigma_a", "sigma_s", "Le"})
    colours.push_back(value(ParamType::rgb, name, flat));

  std::vector<MediumOfTest> all;
  for (const std::string& name : loader().available(PluginKind::volume)) {
    const std::size_t before = all.size();
    std::string why;
    for (const ParamList* list : {&boxed, &grid, &unlike, &flames, &colours}) try {
        all.push_back({name, make<Medium>(name, *list, setup)});
      } catch (const Error& error) {
        why += error.what();
      }
    EXPECT_GT(all.size(), before) << name << ": " << why;
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
