// Who may include whom, read from the sources themselves: base <- api <- plugin <- parse <- scene
// <- tools, plug-ins see the first three, each heavy library has one user, and only commands
// print.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using Strings = std::vector<std::string>;

bool startsWithAny(std::string_view text, const Strings& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return text.starts_with(prefix); });
}

const Strings kPluginFolders{"shapes/", "integrators/", "samplers/", "filters/", "cameras/",
                             "lights/", "materials/",   "textures/", "volumes/"};

struct Rule {
  std::string who;  // files whose path starts so
  Strings what;     // may include paths that start so, and headers of their own folder
};

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all = [] {
    Strings below;
    std::vector<Rule> list;
    for (const char* layer : {"base", "api", "plugin", "parse", "scene"}) {
      below.push_back("core/"s + layer + "/");
      list.push_back({below.back(), below});
    }
    list[3].what.push_back("parse/scene.");  // made by flex and bison in the build folder
    // Surfels are a library that a command and an integrator have in common.
    list.push_back({"tools/particles/", {"core/", "tools/", "shapes/metaballs/"}});
    list.push_back({"tools/", {"core/", "tools/"}});
    const Strings ofPlugins{"core/base/", "core/api/", "core/plugin/"};
    const auto addPlugins = [&](const std::string& folder, const Strings& more) {
      list.push_back({folder, ofPlugins});
      list.back().what.insert(list.back().what.end(), more.begin(), more.end());
    };
    addPlugins("integrators/surfaceparticles/", {"shapes/metaballs/surfels/"});
    addPlugins("shapes/metaballs/surfels/", {"shapes/metaballs/"});
    for (const std::string& folder : kPluginFolders) addPlugins(folder, {folder + "files/"});
    return list;
  }();
  return all;
}

// A library whose headers start so has these users alone.
const std::vector<Rule>& libraries() {
  static const std::vector<Rule> all{
      {"embree", {"core/scene/accel"}},
      {"dlfcn.h", {"core/plugin/loader.cpp", "core/plugin/culprit.cpp"}},
      {"tbb/", {"core/scene/", "core/base/parallel."}},
      {"oneapi/", {"core/scene/", "core/base/parallel."}},
      {"Imf", {"core/base/image"}},
      {"Imath", {"core/base/image"}},
      {"OpenEXR/", {"core/base/image"}},
      {"png.h", {"core/base/image"}},
      {"zlib.h", {"core/base/file.cpp"}},
      {"jpeglib.h", {"textures/imagemap/jpeg.cpp"}},
      {"CLI/", {"tools/"}},
  };
  return all;
}

// `std::cout << ...` and its like in a line of code.
bool prints(std::string_view code) {
  for (const std::string_view word :
       {"std::cout", "std::cerr", "std::clog", "printf(", "puts(", "fmt::print", "perror("})
    for (auto at = code.find(word); at != code.npos; at = code.find(word, at + 1)) {
      const bool otherName =
          at > 0 && (std::isalnum(static_cast<unsigned char>(code[at - 1])) || code[at - 1] == '_');
      // snprintf and vsnprintf write to memory; fprintf and fputs do not.
      if (!otherName || code[at - 1] == 'f') return true;
    }
  return false;
}

// Whether an include names a file beside the one that includes it, or, in the folder of one
// plug-in, below it.
bool inFolderOf(std::string_view path, std::string_view included) {
  const auto folder = [](std::string_view p) { return p.substr(0, p.rfind('/') + 1); };
  const bool ofOnePlugin = std::ranges::count(path, '/') > 1 && !path.starts_with("core/");
  return folder(included).empty() || folder(included) == folder(path) ||
         (ofOnePlugin && folder(included).starts_with(folder(path)));
}

// What is wrong with a file, one sentence each.
Strings complaints(const std::string& path, const std::string& text) {
  const auto rule = std::find_if(rules().begin(), rules().end(),
                                 [&](const Rule& r) { return path.starts_with(r.who); });
  Strings result;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    line = line.substr(0, line.find("//"));
    const auto complain = [&](const std::string& what) {
      result.push_back(path + ":" + std::to_string(number + 1) + ": " + what);
    };

    if (prints(line) && !path.starts_with("tools/")) complain("prints; only tools/ may");
    const std::size_t hash = line.find_first_not_of(' ');
    if (hash == line.npos || !line.substr(hash).starts_with("#include")) continue;
    const std::size_t open = line.find_first_of("\"<", hash);
    const std::size_t close = line.find_first_of("\">", open + 1);
    if (open == line.npos || close == line.npos) continue;
    const std::string name(line.substr(open + 1, close - open - 1));

    if (line[open] == '<') {
      for (const auto& [library, users] : libraries())
        if (name.starts_with(library) && !startsWithAny(path, users))
          complain("<" + name + "> belongs to " + users.front());
    } else if (rule == rules().end() ||
               (!startsWithAny(name, rule->what) && !inFolderOf(path, name))) {
      complain("may not include \"" + name + "\"");
    } else if (name.ends_with(".cpp")) {
      complain("includes a source file");
    }
  }
  return result;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The tree's own sources, as paths from its root, without tests.
Strings sources() {
  Strings paths;
  Strings folders = kPluginFolders;
  folders.insert(folders.end(), {"core/", "tools/"});
  for (const std::string& folder : folders) {
    const fs::path root = fs::path(PBRT_SOURCE_DIR) / folder;
    if (!fs::exists(root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      static const std::set<std::string> suffixes{".h", ".cpp", ".l", ".y"};
      if (suffixes.contains(entry.path().extension()))
        paths.push_back(fs::relative(entry.path(), PBRT_SOURCE_DIR).generic_string());
    }
  }
  return paths;
}

TEST(Layering, HoldsInTheWholeTree) {
  const Strings paths = sources();
  EXPECT_GT(paths.size(), 30U) << "the tree was not found";
  for (const std::string& path : paths)
    for (const std::string& complaint :
         complaints(path, contents(fs::path(PBRT_SOURCE_DIR) / path)))
      ADD_FAILURE() << complaint;
}

TEST(Layering, TheRulesTellRightFromWrong) {
  const auto wrong = [](const char* path, const char* text) {
    return !complaints(path, text).empty();
  };
  EXPECT_FALSE(wrong("core/base/a.h", "#include <vector>\n#include \"core/base/b.h\"\n"));
  EXPECT_TRUE(wrong("core/base/a.h", "\n#include \"core/api/b.h\"\n"));
  EXPECT_TRUE(wrong("core/api/a.h", "#include \"core/plugin/b.h\""));
  EXPECT_TRUE(wrong("core/parse/a.h", "  #include \"core/scene/b.h\""));
  EXPECT_FALSE(wrong("core/scene/a.h", "#include \"core/parse/b.h\""));
  EXPECT_TRUE(wrong("core/scene/a.h", "#include \"tools/b.h\""));
  EXPECT_TRUE(wrong("core/scene/a.h", "#include \"shapes/b.h\""));
  EXPECT_FALSE(wrong("tools/a.cpp", "#include \"b.h\""));
  EXPECT_FALSE(wrong("tools/a.cpp", "#include \"core/scene/b.h\"\nfmt::print(\"x\");"));
  EXPECT_FALSE(wrong("shapes/a.cpp", "#include \"core/plugin/plugin.h\""));
  EXPECT_TRUE(wrong("shapes/a.cpp", "#include \"core/scene/film.h\""));
  EXPECT_TRUE(wrong("shapes/a.cpp", "#include \"lights/b.h\""));
  EXPECT_TRUE(wrong("shapes/a.cpp", "#include \"shapes/b.cpp\""));
  EXPECT_TRUE(wrong("shapes/a.cpp", "#include \"shapes/metaballs/b.h\""));
  EXPECT_FALSE(wrong("shapes/metaballs/a.cpp", "#include \"shapes/files/b.h\""));
  EXPECT_TRUE(wrong("lights/a.cpp", "#include \"shapes/files/b.h\""));
  EXPECT_FALSE(wrong("shapes/metaballs/a.cpp", "#include \"shapes/metaballs/b.h\""));
  EXPECT_FALSE(wrong("shapes/metaballs/a.cpp", "#include \"shapes/metaballs/c/b.h\""));
  EXPECT_TRUE(wrong("core/scene/film.cpp", "#include <embree3/rtcore.h>"));
  EXPECT_FALSE(wrong("core/scene/accel.cpp", "#include <embree3/rtcore.h>"));
  EXPECT_TRUE(wrong("core/scene/film.cpp", "#include <dlfcn.h>"));
  EXPECT_TRUE(wrong("shapes/a.cpp", "#include <tbb/parallel_for.h>"));
  EXPECT_TRUE(wrong("core/scene/film.cpp", "#include <ImfHeader.h>"));
  EXPECT_TRUE(wrong("core/base/error.cpp", "std::cerr << 1;"));
  EXPECT_TRUE(wrong("core/base/error.cpp", "  fprintf(stderr, \"\");"));
  EXPECT_TRUE(wrong("core/base/error.cpp", "printf(\"\");"));
  EXPECT_FALSE(wrong("core/base/error.cpp", "std::snprintf(text, 3, \"\");  // no std::cout"));
}

}  // namespace
