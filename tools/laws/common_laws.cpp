// The laws of every plug-in, whatever its kind: what it says of its parameters is true.

#include <cstdlib>
#include <set>
#include <sstream>

#include "laws.h"
#include "making.h"

namespace pbrt::laws {
namespace {

std::string messageOf(const Error& error) {
  return error.diagnostics().empty() ? error.what() : error.diagnostics().front().message;
}

void isMade(const Subject& subject, Judge& judge) {
  Params reader(subject.plugin->name, {}, {&subject.params});
  make(*subject.plugin, reader);
  reader.refuseUnread();
  judge.expect(true, "");
}

void describesItself(const Subject& subject, Judge& judge) {
  judge.expect(!std::string_view(subject.plugin->summary).empty(),
               "its summary, the last word of PBRT_PLUGIN, is empty");
  std::vector<Declaration> found;
  Params reader = Params::describing(subject.plugin->name, found);
  try {
    make(*subject.plugin, reader);
  } catch (const Error& error) {
    judge.fail("with no values, as --describe makes it, it fails ({}): ask Params::describing()",
               messageOf(error));
  }
  std::set<std::string> names;
  for (const Declaration& d : found) {
    judge.expect(!d.name.empty() && d.name.find_first_of(" \t\"") == d.name.npos,
                 "a scene cannot give a parameter the name \"{}\"", d.name);
    judge.expect(names.insert(d.name).second, "\"{}\" is declared twice", d.name);
    judge.expect(!d.meaning.empty(), "\"{}\" has no meaning", d.name);
  }
}

// A list of the default of a declaration; empty, which most readers take for absent, if it has
// none.
Param defaultOf(const Declaration& d) {
  const std::string value = d.defaultValue == "-" ? "" : d.defaultValue;
  const auto is = [&](std::string_view type) { return d.type.starts_with(type); };
  Param p{ParamType::number, d.name, {}, {}, std::vector<float>()};
  if (is("string")) {
    p.type = ParamType::string;
    p.values = std::vector<std::string>();
    if (value.size() >= 2) p.values = std::vector{value.substr(1, value.size() - 2)};
    return p;
  }
  if (is("bool") || is("integer")) {
    p.type = is("bool") ? ParamType::boolean : ParamType::integer;
    p.values = std::vector<int>();
    if (!value.empty())
      p.values = std::vector{is("bool") ? int{value == "true"} : std::stoi(value)};
    return p;
  }
  for (const auto& [name, type] : {std::pair{"point3", ParamType::point3},
                                   {"vector3", ParamType::vector3},
                                   {"point2", ParamType::point2},
                                   {"normal", ParamType::normal},
                                   {"rgb", ParamType::rgb}})
    if (is(name)) p.type = type;
  std::istringstream in(value);
  std::vector<float> numbers;
  for (std::string word; in >> word;) numbers.push_back(std::strtof(word.c_str(), nullptr));
  // A colour that is told by one number is grey.
  if (p.type == ParamType::rgb && numbers.size() == 1) numbers.resize(3, numbers[0]);
  p.values = std::move(numbers);
  return p;
}

bool canBeMade(const Subject& subject, const ParamList& params) {
  try {
    Params reader(subject.plugin->name, {}, {&params});
    make(*subject.plugin, reader);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// Each declared parameter in turn is given its default, besides the others that are needed.
void readsWhatItDeclares(const Subject& subject, Judge& judge) {
  const ParamList none;
  const bool bare = canBeMade(subject, none);
  const ParamList& others = bare ? none : subject.params;
  for (const Declaration& d : declarationsOf(*subject.plugin)) {
    if (std::ranges::any_of(others, [&](const Param& p) { return p.name == d.name; })) continue;
    const ParamList more{defaultOf(d)};
    Params reader(subject.plugin->name, {}, {&others, &more});
    bool accepted = true;
    std::string complaint;
    try {
      make(*subject.plugin, reader);
    } catch (const Error& error) {
      accepted = false;
      complaint = messageOf(error);
    }
    judge.expect(!accepted || reader.unread(1).empty(),
                 "it declares \"{}\", but does not read it when it is made", d.name);
    const bool hasDefault = !d.defaultValue.empty() && d.defaultValue != "-";
    judge.expect(accepted || !bare || !hasDefault,
                 "\"{}\" is said to be {} by default, but with this value given it fails: {}",
                 d.name, d.defaultValue, complaint);
  }
}

void namesWhatItNeeds(const Subject& subject, Judge& judge) {
  const ParamList none;
  try {
    Params reader(subject.plugin->name, {}, {&none});
    make(*subject.plugin, reader);
    judge.expect(true, "");
  } catch (const Error& error) {
    const std::string complaint = messageOf(error);
    const auto declared = declarationsOf(*subject.plugin);
    judge.expect(std::ranges::any_of(declared,
                                     [&](const Declaration& d) {
                                       return complaint.find('"' + d.name + '"') != complaint.npos;
                                     }),
                 "with no parameters it fails, and names none that it needs: {}", complaint);
  }
}

constexpr Law kLaws[] = {
    {kMade, "It can be made with these parameters, and reads them all.", isMade},
    {"describes-itself", "It has a summary, and each parameter a name of its own and a meaning.",
     describesItself},
    {"reads-what-it-declares", "Each parameter that it declares is read, and takes its default.",
     readsWhatItDeclares},
    {"names-what-it-needs", "With no parameters it is made, or the error names one that it needs.",
     namesWhatItNeeds},
};

}  // namespace

std::span<const Law> commonLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
