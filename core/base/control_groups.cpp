#include "core/base/control_groups.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

namespace fs = std::filesystem;

namespace pbrt {

// Lines of /proc/self/cgroup are "number:controllers:path"; version 2 names no controllers. In a
// container the path may be that of the machine, which cannot be seen there; the container's own
// group is then the uppermost.
std::vector<fs::path> controlGroups(std::string_view controller, const fs::path& root) {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& top, const fs::path& group) {
    for (fs::path part = group.relative_path(); !part.empty(); part = part.parent_path())
      folders.push_back(top / part);
    folders.push_back(top);
  };
  const fs::path mounted = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == line.npos ? line.npos : line.find(':', first + 1);
    if (second == line.npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    if (controllers.empty()) {
      add(mounted, group);
      add(mounted / "unified", group);  // beside version 1
    } else if (fmt::format(",{},", controllers).find(fmt::format(",{},", controller)) !=
               std::string::npos) {
      add(mounted / controller, group);
    }
  }
  return folders;
}

}  // namespace pbrt
