#pragma once
// `pbrt-plugin check`: puts a plug-in to the laws of its kind.

#include <CLI/CLI.hpp>

#include "tools/laws/law.h"

namespace pbrt {

struct CheckOptions {
  std::string file;
  std::string parameters;         // as a scene gives them
  std::vector<std::string> laws;  // empty: all
  double timeout = 60;            // for each law, in seconds
  bool list = false, quiet = false;
  laws::Traits traits;
};

// Adds the subcommand, whose words land in `o`.
CLI::App* addCheck(CLI::App& app, CheckOptions& o);

// 0 if the plug-in obeys all laws, 1 if not. Throws Error if it cannot be put to them.
int check(const CheckOptions& o);

}  // namespace pbrt
