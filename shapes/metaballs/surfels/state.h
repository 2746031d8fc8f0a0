#pragma once
// What a simulation keeps from step to step, and the parts of a step.

#include <cstdint>

#include "shapes/metaballs/surfels/landing.h"
#include "shapes/metaballs/surfels/neighbours.h"
#include "shapes/metaballs/surfels/repulsion.h"

namespace pbrt::surfels {

class Simulation::State {
 public:
  explicit State(const Settings& settings) : settings_(settings) {}

  void step(const MovingField& field, double dt);

  std::span<const Surfel> surfels() const { return surfels_; }
  const Report& report() const { return report_; }

 private:
  // What carries a surfel on in the next step.
  struct Motion {
    DVec3 flow{};     // of the fluid
    DVec3 lag{};      // how far the fluid there has gone ahead
    float push[3]{};  // by its neighbours, in reaches
    float value = 0;  // f
    // Surfels within the reach, itself among them, averaged over neighbours and some steps. Zero
    // where it was set anew.
    float crowding = 0;
  };

  // simulation.cpp
  void carry(const MovingField& field, double dt);
  Landing carried(const Bounds3& within, double dt, std::size_t i) const;
  void place(std::size_t i, const Landing& landing);
  void sort();
  void push(double extent);
  void shape(const MovingField& field);
  // spread.cpp
  std::size_t partner(std::size_t i) const;
  Landing beside(std::size_t i, Landing at) const;
  std::vector<Landing> look(const MovingField& field, std::size_t places);
  void setAnew(const MovingField& field);
  void set(std::size_t i, const Landing& landing);
  bool closeHoles(const MovingField& field);
  bool moveCrowded(const Landing& place);
  void guessReach(double least);

  Settings settings_;
  std::vector<Surfel> surfels_, surfelsBefore_;
  std::vector<Motion> motions_, motionsBefore_;
  std::vector<Landing> landings_;
  std::vector<DVec3> lags_;
  std::vector<float> crowding_;  // that of each surfel after the last step
  std::vector<Repulsion> repulsions_;
  std::vector<std::uint32_t> lost_;  // surfels that are not on the surface
  Neighbours neighbours_;
  double reach_ = 0;          // of the coming step
  float evenness_ = 0;        // after the last step
  std::uint64_t steps_ = 0;   // begun
  std::uint64_t looked_ = 0;  // number of the next seed
  Report report_;
};

}  // namespace pbrt::surfels
