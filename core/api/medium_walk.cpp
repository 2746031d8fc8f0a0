#include "core/api/medium_walk.h"

namespace pbrt {

MediumWalk::MediumWalk(const Medium& medium, const DPoint3& o, const DVec3& w, Interval t)
    : medium_(&medium), o_(medium.toMedium_.point(o)), w_(medium.toMedium_.vector(w)) {
  const std::optional<Interval> within = medium.clip(o, w, t);
  if (!within) return;
  more_ = true;
  stretch_.end = within->begin;
  end_ = within->end;
  if (medium.cells_.size() == 1) {
    crossings_ = DVec3(end_);
    return;
  }
  const DVec3 n(medium.n_);
  const DPoint3 at = (o_ + within->begin * w_ - medium.lo_) / (medium.hi_ - medium.lo_) * n;
  cell_ = glm::ivec3(glm::clamp(glm::floor(at), DVec3(0), n - 1.0));
  for (int i = 0; i < 3; ++i) crossings_[i] = crossing(i);
}

double MediumWalk::crossing(int axis) const {
  if (w_[axis] == 0) return std::numeric_limits<double>::infinity();
  const int face = cell_[axis] + (w_[axis] > 0 ? 1 : 0);
  const double plane =
      medium_->lo_[axis] + (medium_->hi_[axis] - medium_->lo_[axis]) * face / medium_->n_[axis];
  return (plane - o_[axis]) / w_[axis];
}

bool MediumWalk::next() {
  if (!more_) return false;
  const glm::ivec3& n = medium_->n_;
  static_cast<Medium::Cell&>(stretch_) =
      medium_->cells_[(static_cast<std::size_t>(cell_.z) * n.y + cell_.y) * n.x + cell_.x];
  stretch_.begin = stretch_.end;
  const int axis = crossings_.x < crossings_.y ? (crossings_.x < crossings_.z ? 0 : 2)
                                               : (crossings_.y < crossings_.z ? 1 : 2);
  stretch_.end = std::clamp(crossings_[axis], stretch_.begin, end_);
  cell_[axis] += w_[axis] > 0 ? 1 : -1;
  more_ = crossings_[axis] < end_ && cell_[axis] >= 0 && cell_[axis] < n[axis];
  if (more_)
    crossings_[axis] = crossing(axis);
  else
    stretch_.end = end_;
  return true;
}

void MediaWalk::start(const Medium* around, std::span<const Medium* const> regions,
                      const DPoint3& o, const DVec3& w, Interval t) {
  o_ = o;
  w_ = w;
  count_ = 0;
  stretch_.end = t.begin;
  const auto add = [&](const Medium& medium) {
    MediumWalk& walk = room_[count_];
    walk = MediumWalk(medium, o, w, t);
    if (walk.next()) ++count_;
  };
  if (around) add(*around);
  for (const Medium* region : regions) add(*region);
}

bool MediaWalk::next() {
  while (count_ > 0) {
    stretch_.begin = stretch_.end;
    stretch_.end = std::numeric_limits<double>::infinity();
    stretch_.majorant = Spectrum(0);
    stretch_.uniform = true;
    for (std::size_t i = 0; i < count_;) {
      MediumWalk& walk = room_[i];
      bool more = true;
      while (more && !(walk.stretch().end > stretch_.begin)) more = walk.next();
      if (!more) {
        walk = room_[--count_];
        continue;
      }
      const Stretch& s = walk.stretch();
      if (s.begin > stretch_.begin) {
        stretch_.end = std::min(stretch_.end, s.begin);
      } else {
        stretch_.end = std::min(stretch_.end, s.end);
        stretch_.majorant += s.majorant;
        stretch_.uniform = stretch_.uniform && s.uniform;
      }
      ++i;
    }
    if (count_ > 0 && !isBlack(stretch_.majorant)) return true;
  }
  return false;
}

MediumPoint MediaWalk::at(double t) const {
  MediumPoint sum;
  for (const MediumWalk& walk : room_.first(count_)) {
    if (walk.stretch().begin > stretch_.begin || isBlack(walk.stretch().majorant)) continue;
    const MediumPoint m = walk.medium().inside(point(t));
    sum.absorption += m.absorption;
    sum.scattering += m.scattering;
    sum.emission += m.emission;
  }
  return sum;
}

MediaWalk::Scattering MediaWalk::scattering(double t, float u) const {
  Scattering chosen;
  float sum = 0;
  for (const MediumWalk& walk : room_.first(count_)) {
    if (walk.stretch().begin > stretch_.begin || isBlack(walk.stretch().majorant)) continue;
    const Spectrum s = walk.medium().inside(point(t)).scattering;
    const float weight = s.x + s.y + s.z;
    if (!(weight > 0)) continue;
    // One after the other may take the place of those before, which keep their chances
    // (reservoir sampling, Chao 1982); what is left of u is uniform again.
    sum += weight;
    const float chance = weight / sum;
    if (u < chance) {
      chosen = {s / weight, walk.medium().g()};
      u /= chance;
    } else {
      u = (u - chance) / (1 - chance);
    }
  }
  chosen.scattering *= sum;
  return chosen;
}

}  // namespace pbrt
