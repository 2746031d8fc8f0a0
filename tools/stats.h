#pragma once
// What --stats tells.

#include <string>

#include "core/plugin/loader.h"
#include "core/scene/render.h"
#include "core/scene/scene.h"

namespace pbrt {

// Seconds on a clock that never goes back.
double now();
// Seconds that all threads of the process have computed.
double cpuSeconds();

struct Times {
  double start = now();
  double cpuBefore = cpuSeconds();  // above all to link the program
  double build = 0;     // how long plug-ins, objects and trees took; the parser the rest
  double ready = 0;     // when the first ray could be traced,
  double rendered = 0;  // the picture was there,
  double written = 0;   // and in its files
};

// Lines of text, with a blank before what belongs to the line above. Uses up the scene, as what its
// parts hold of the memory shows when they are freed.
std::string stats(std::unique_ptr<Scene> scene, const PluginLoader& loader,
                  const RenderControl& control, std::uint32_t samples, const Times& t);

}  // namespace pbrt
