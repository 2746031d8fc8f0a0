#include "core/base/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "core/base/error.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// A file that holds a number of bytes, or "max"; it need not be there.
std::size_t limitIn(const fs::path& file) {
  std::size_t bytes = kNoLimit;
  std::ifstream in(file);
  return in >> bytes ? bytes : kNoLimit;
}

// A group is held to the limits of those about it, too. In a container the path may be that of the
// machine, which cannot be seen there; the container's own group is then the uppermost.
std::size_t leastUpwards(const fs::path& top, fs::path group, const char* name) {
  std::size_t least = limitIn(top / name);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path())
    least = std::min(least, limitIn(top / group / name));
  return least;
}

std::size_t ownLimit(__rlimit_resource_t resource) {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur
                                                                             : kNoLimit;
}

}  // namespace

// Lines of /proc/self/cgroup are "number:controllers:path" (cgroups(7)); version 2 has the number 0
// and names no controllers.
std::size_t controlGroupLimit(const fs::path& root) {
  const fs::path top = root / "sys/fs/cgroup";
  std::size_t least = kNoLimit;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == line.npos ? line.npos : line.find(':', first + 1);
    if (second == line.npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,")
      least = std::min(least, leastUpwards(top, group, "memory.max"));
    else if (controllers.find(",memory,") != controllers.npos)
      least = std::min(least, leastUpwards(top / "memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

std::size_t memoryLimit() {
  static const std::size_t limit = [] {
    const auto machine = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                         static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return std::min({machine, controlGroupLimit(), ownLimit(RLIMIT_AS), ownLimit(RLIMIT_DATA)});
  }();
  return limit;
}

void checkMemory(double bytes, std::string_view what) {
  const auto limit = static_cast<double>(memoryLimit());
  if (!(bytes <= limit))
    throw Error(fmt::format("{} needs {:.1f} GiB of memory; there is room for {:.1f} GiB", what,
                            bytes / 0x1p30, limit / 0x1p30));
}

}  // namespace pbrt
