#include "reading.h"

#include <fmt/format.h>

#include "core/base/file.h"
#include "status_line.h"

namespace pbrt {

void parse(Parser& parser, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (file == "-")
      parser.text("<stdin>", readFile("/dev/stdin", FileKind::any));
    else
      parser.file(file);
  }
}

int judge(const Options& o) {
  const std::size_t errors = o.reports->errors();
  if (errors == 0) return 0;
  printError(
      fmt::format("{} error{}{}", errors, errors == 1 ? "" : "s",
                  o.permissive ? " passed over: the picture is not what the scene asks for" : ""));
  return o.permissive ? 0 : static_cast<int>(Failure::scene);
}

Reporter includes(const Options& o) {
  return o.build.permissive ? o.build.report : Reporter();
}

}  // namespace pbrt
