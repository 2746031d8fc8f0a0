#pragma once
// Holds the crossings that cells and roots name against those of the oracle.

#include <cstdio>
#include <string>

#include "shapes/metaballs/roots.h"
#include "tests/shapes/metaballs/oracle.h"

namespace pbrt::metaballs::test {

struct Tally {
  std::uint64_t rays = 0, hits = 0;
  std::uint64_t touches = 0;  // neither answer is wrong, see judge
  std::uint64_t missed = 0, wrong = 0;
  std::uint64_t loose = 0;  // the right crossing, but farther off than rounding at the place tells
  std::uint64_t split = 0;  // first crossing and occlusion do not say the same
  std::vector<float> errors;  // |t - oracle| |d| over the smallest support that holds the point
  Effort effort;

  bool good() const { return missed == 0 && wrong == 0 && split == 0; }
  void add(const Tally& other) {
    rays += other.rays, hits += other.hits, touches += other.touches, loose += other.loose;
    missed += other.missed, wrong += other.wrong, split += other.split;
    errors.insert(errors.end(), other.errors.begin(), other.errors.end());
    effort.floats += other.effort.floats, effort.doubles += other.effort.doubles;
  }
  double quantile(double q) {
    if (errors.empty()) return 0;
    const auto at =
        errors.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(errors.size() - 1));
    std::ranges::nth_element(errors, at);
    return *at;
  }
  static void printHeader() {
    std::printf("%-24s %8s %8s %7s %6s %6s %6s %6s  %s\n", "set", "rays", "hits", "touches",
                "missed", "false", "split", "loose", "|dt|/h 50%, 99.9%, max");
  }
  void print(const std::string& name) {
    std::printf("%-24s %8ju %8ju %7ju %6ju %6ju %6ju %6ju  %.1e %.1e %.1e\n", name.c_str(),
                std::uintmax_t{rays}, std::uintmax_t{hits}, std::uintmax_t{touches},
                std::uintmax_t{missed}, std::uintmax_t{wrong}, std::uintmax_t{split},
                std::uintmax_t{loose}, quantile(0.5), quantile(0.999), quantile(1));
    std::fflush(stdout);
  }
};

// All digits of a ray, to find it again.
inline std::string digits(const ObjectRay& ray) {
  char text[200];
  std::snprintf(text, sizeof text, "o %a %a %a d %a %a %a", ray.o.x, ray.o.y, ray.o.z, ray.d.x,
                ray.d.y, ray.d.z);
  return text;
}

// Our answer for a ray against the oracle's.
//
// Rounding hides crossings: doubles cannot tell f from 0 where |f| <= tolerance(t), the rounding of
// the field's sum and what that of a point o + t d does to each of its terms. Two crossings are one
// if |f| stays below the tolerance between them, or (loose) if they are closer than 1e-9 supports
// and sixteen times the rounding of the point: what is lost in between is no more. By the rules of
// roots.h a touch of that kind may be named, and a crossing that the ray starts on need not be.
class Judge {
 public:
  Judge(const Blocks& blocks, const ObjectRay& ray)
      : ray_(ray), speed_(glm::length(ray.d)), oracle_(blocks, ray) {}

  // `ours`: the first crossing as found; `occluded`: whether there was said to be any. Adds to the
  // tally; true if they are right.
  bool operator()(const std::optional<double>& ours, bool occluded, Tally& tally) {
    ++tally.rays;
    const bool split = occluded != ours.has_value();
    tally.split += split;

    auto truth = oracle_.first();
    tally.hits += truth.has_value();
    bool passed = false;
    while (truth && !(ours && (same(*truth, *ours) || close(*truth, *ours))) &&
           (truth->touch || within(ray_.tMin, *truth))) {
      truth = after(*truth);
      passed = true;
    }
    if (ours && !(*ours > ray_.tMin && *ours <= ray_.tMax)) {
      ++tally.wrong;
      return false;
    }
    if (!ours && !truth) {
      tally.touches += passed;
    } else if (ours && truth && (same(*truth, *ours) || close(*truth, *ours))) {
      tally.loose += !same(*truth, *ours);
      const Quad error =
          abs(*ours - truth->t) * speed_ / oracle_.scale(static_cast<double>(truth->t)).radius;
      tally.errors.push_back(static_cast<float>(error));
    } else if (ours && (!truth || *ours < truth->t)) {
      const bool touch = abs(oracle_.value(*ours)) <= tolerance(*ours);
      ++(touch ? tally.touches : tally.wrong);
      return touch && !split;
    } else {
      ++tally.missed;
      return false;
    }
    return !split;
  }

 private:
  // Of the point at t, in doubles: 2^-44 of the support as the search ends, and o + t d to 4
  // epsilon of its terms. That four times: a touch is where the ends of a bound lie on either side
  // of zero, over a piece of the ray that is as long again.
  double blur(double t) const {
    const DVec3 reach = glm::abs(ray_.o) + std::abs(t) * glm::abs(ray_.d);
    const double radius = oracle_.scale(t).radius;
    return 16 * kEpsilon * (reach.x + reach.y + reach.z) +
           (std::isfinite(radius) ? 0x1p-44 * radius : 0);
  }
  double tolerance(double t) const {
    const Oracle::Scale s = oracle_.scale(t);
    return (64 + s.atoms) * kEpsilon * (1 + s.weight) + oracle_.swing(t, blur(t));
  }
  // |f| <= tolerance from t0 to t1.
  bool within(Quad t0, Quad t1) {
    const double e =
        std::max(tolerance(static_cast<double>(t0)), tolerance(static_cast<double>(t1)));
    return abs(oracle_.value(t0)) <= e && !oracle_.first(t0, t1, e) && !oracle_.first(t0, t1, -e);
  }
  bool same(Quad truth, double ours) {
    return abs(truth - ours) * speed_ <= blur(ours) ||
           within(std::min<Quad>(truth, ours), std::max<Quad>(truth, ours));
  }
  bool close(Quad truth, double ours) const {
    const double h = oracle_.scale(static_cast<double>(truth)).radius;
    return abs(truth - ours) * speed_ <= 1e-9 * h + 16 * blur(ours);
  }
  // The next crossing once the field has left zero.
  std::optional<Root> after(Quad t) {
    const double e = tolerance(static_cast<double>(t));
    Quad left = ray_.tMax;
    bool leaves = false;
    for (const double level : {e, -e})
      if (const auto at = oracle_.first(t, left, level)) {
        left = at->t;
        leaves = true;
      }
    return leaves ? oracle_.first(left, ray_.tMax) : std::nullopt;
  }

  ObjectRay ray_;
  double speed_;
  Oracle oracle_;
};

}  // namespace pbrt::metaballs::test
