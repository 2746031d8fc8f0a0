#include "stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

namespace pbrt {

namespace {

// Memory of the process, in bytes, as the kernel counts it page by page.
struct Resident {
  double all = 0;
  double plugins = 0, libraries = 0;  // code and data of files, the program among the libraries
};

Resident resident(const PluginLoader& loader) {
  Resident r;
  std::vector<std::string> files;
  std::error_code gone;
  for (const LoadedPlugin& plugin : loader.opened())
    files.push_back(std::filesystem::canonical(plugin.file, gone));
  std::ifstream maps("/proc/self/smaps");
  double* of = nullptr;  // what the lines are about; null: no file
  for (std::string line; std::getline(maps, line);) {
    const std::size_t colon = line.find(':');
    if (line.compare(0, colon, "Rss") == 0) {
      const double bytes = 1024 * std::stod(line.substr(colon + 1));
      r.all += bytes;
      if (of) *of += bytes;
    } else if (line.find('-') < line.find(' ')) {  // a new range of addresses
      const std::size_t path = line.find('/');
      if (path == line.npos)
        of = nullptr;
      else
        of = std::ranges::count(files, line.substr(path)) ? &r.plugins : &r.libraries;
    }
  }
  return r;
}

// The most that it was so far. (getrusage counts what there was before the program began, too.)
double mostResident() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stod(line.substr(6));
  return 0;
}

std::string memory(std::unique_ptr<Scene> scene, const PluginLoader& loader) {
  const Resident r = resident(loader);
  std::vector<MemoryPart> parts = takeApart(std::move(scene));
  const std::size_t free = parts.size() - 1;  // it comes last
  parts.push_back({"code of plug-ins", r.plugins});
  parts.push_back({"code of pbrt and libraries", r.libraries});
  double rest = r.all;  // stacks, buffers
  for (const MemoryPart& part : parts) rest -= part.bytes;
  if (rest < 0) {  // what is free has pages that were never used
    parts[free].bytes = std::max(parts[free].bytes + rest, 0.0);
    rest = 0;
  }
  parts.push_back({"all else", rest});

  constexpr double kMiB = 1 << 20;
  std::string text = fmt::format("Memory    {:.1f} MiB at most; {:.1f} MiB with the picture:\n",
                                 std::max(mostResident(), r.all) / kMiB, r.all / kMiB);
  for (const MemoryPart& part : parts)
    text += fmt::format("  {:8.1f} {}\n", part.bytes / kMiB, part.name);
  return text;
}

std::string plugins(const PluginLoader& loader) {
  std::size_t available = 0;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i)
    available += loader.available(static_cast<PluginKind>(i)).size();
  std::string text = fmt::format("Plug-ins  {} opened of {}\n", loader.opened().size(), available);
  for (const LoadedPlugin& plugin : loader.opened())
    text += fmt::format("  {}/{} ({:.2f} ms)\n", kindFolder(plugin.info->kind), plugin.info->name,
                        1e3 * plugin.seconds);
  return text;
}

}  // namespace

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string stats(std::unique_ptr<Scene> scene, const PluginLoader& loader,
                  const RenderControl& control, std::uint32_t samples, const Times& t) {
  const double render = t.rendered - t.ready;
  std::string text = fmt::format(
      "Seconds   start {:.3f}, parse {:.3f}, build {:.3f} (ray trees {:.3f}), render {:.3f}, write "
      "{:.3f}\n",
      t.cpuBefore, t.ready - t.start - t.build, t.build, scene->treeSeconds(), render,
      t.written - t.rendered);
  text += fmt::format("Samples   {} per pixel\n", samples);
  text += fmt::format("Rays      {} ({:.2f} Mrays/s), the first after {:.1f} ms\n",
                      control.rays.load(), static_cast<double>(control.rays) / render / 1e6,
                      1e3 * (t.cpuBefore + t.ready - t.start));
  text += fmt::format("Scene     {} shapes, {} lights; seed {}\n", scene->shapes(),
                      scene->lights().size(), scene->seed());
  text += memory(std::move(scene), loader);
  return text + plugins(loader);
}

}  // namespace pbrt
