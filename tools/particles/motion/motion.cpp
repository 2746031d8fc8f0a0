#include "tools/particles/motion/motion.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "tools/particles/motion/drops.h"

namespace pbrt::motion {

const std::vector<std::string>& motionNames() {
  static const std::vector<std::string> names{"dam", "split", "ring"};
  return names;
}

std::unique_ptr<Motion> makeMotion(const std::string& name, int atoms, double fps) {
  if (atoms < 100 || atoms > 1'000'000)
    throw Error(fmt::format("{} atoms: a motion has from 100 to a million", atoms), Failure::usage);
  checkFrameRate(fps);
  if (name == "dam") return makeDam(atoms, fps);
  if (name == "split") return makeSplit(atoms, fps);
  if (name == "ring") return makeRing(atoms, fps);
  throw Error(fmt::format("there is no motion \"{}\" (it is one of {}){}", shown(name),
                          fmt::join(motionNames(), ", "), didYouMean(name, motionNames())),
              Failure::usage);
}

void checkFrameRate(double fps) {
  if (!(fps >= 1e-3 && fps <= 1e6))
    throw Error(fmt::format("{} frames a second: from 0.001 to a million are possible", fps),
                Failure::usage);
}

}  // namespace pbrt::motion
