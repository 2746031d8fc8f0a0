#include "core/base/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "core/base/control_groups.h"
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

std::size_t ownLimit(__rlimit_resource_t resource) {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur
                                                                             : kNoLimit;
}

}  // namespace

std::size_t controlGroupMemory(const fs::path& root) {
  std::size_t least = kNoLimit;
  for (const fs::path& group : controlGroups("memory", root))
    for (const char* name : {"memory.max", "memory.limit_in_bytes"})  // of versions 2 and 1
      least = std::min(least, limitIn(group / name));
  return least;
}

std::size_t memoryLimit() {
  static const std::size_t limit = [] {
    const auto machine = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                         static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return std::min({machine, controlGroupMemory(), ownLimit(RLIMIT_AS), ownLimit(RLIMIT_DATA)});
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
