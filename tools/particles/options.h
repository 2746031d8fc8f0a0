#pragma once
// The command line of pbrt-particles.

#include <CLI/CLI.hpp>
#include <optional>

#include "look.h"
#include "tools/particles/motion/motion.h"

namespace pbrt {

struct ParticleOptions {
  std::string files, motion = "dam";
  int atoms = 1500;
  std::size_t particles = 16384;
  std::string frames, size = "512x512";
  std::string out, stats;
  int settle = 30, threads = 0;
  std::uint64_t seed = 0;
  std::optional<double> fps;
  std::string kernel{metaballs::kKernels[0]};
  std::optional<float> radius, threshold;
  float radiusScale = 4;
  std::vector<float> eye, look, up{0, 1, 0};
  double fov = 40;
  std::vector<float> color, background;
  bool quiet = false;
};

void defineOptions(CLI::App& app, ParticleOptions& o);

// All that follow throw Error, Failure::usage.

struct FrameRange {
  int first = 1, last = 1;
};
// "1-120", or "7" for one; empty: all that the motion has, or 120 if that has no end.
FrameRange readFrames(const std::string& text, const motion::Motion& motion);
// "512x512".
Point2i readSize(const std::string& text);
std::size_t readCount(const ParticleOptions& o);

std::unique_ptr<motion::Motion> openMotion(const ParticleOptions& o);
View viewOf(const ParticleOptions& o, const motion::Motion& motion, Point2i size);
Look lookOf(const ParticleOptions& o);

}  // namespace pbrt
