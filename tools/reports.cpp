#include "reports.h"

#include <fmt/format.h>

#include "status_line.h"

namespace pbrt {

void Reports::add(const Diagnostic& d) {
  const std::size_t count = ++counts_[static_cast<std::size_t>(d.severity)];
  if (d.severity < least_ || count > kMostShown + 1) return;
  if (count <= kMostShown)
    printError(format(d));
  else
    printError(fmt::format("... more {}s are not shown",
                           d.severity == Severity::error ? "error" : "warning"));
}

}  // namespace pbrt
