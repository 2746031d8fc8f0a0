// The PLY format (G. Turk, "The PLY Polygon File Format", 1994).

#include <fmt/format.h>

#include <cmath>

#include "formats.h"
#include "records.h"
#include "scanner.h"

namespace pbrt::particles {
namespace {

struct Property {
  std::string name;
  NumberType type = NumberType::float32;
  std::optional<NumberType> lengthType;  // of a list
  std::optional<Target> to;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  bool hasLists() const;
  std::size_t smallestRow(bool ascii) const;  // bytes, where every list is empty
};

bool Element::hasLists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const Property& p) { return p.lengthType.has_value(); });
}

std::size_t Element::smallestRow(bool ascii) const {
  if (ascii) return 2 * properties.size();  // a digit and white space
  std::size_t size = 0;
  for (const Property& p : properties) size += sizeOf(p.lengthType.value_or(p.type));
  return size;
}

class PlyReader {
 public:
  explicit PlyReader(const Input& input) : input_(input), scanner_(input) {}
  Particles read();

 private:
  void readHeader();
  void readProperty();
  NumberType readType();
  void checkRoom(const Element& element) const;
  void prepare(Element& vertices);
  void readBody(const Element& element);
  void readRow(const Element& element, std::size_t row);
  double next(NumberType type);
  std::size_t listLength(NumberType type);
  [[noreturn]] void fail(const char* at, const std::string& message) const;

  const Input& input_;
  Scanner scanner_;
  bool ascii_ = true;
  std::endian order_ = std::endian::little;
  std::vector<Element> elements_;
  Particles particles_;
};

NumberType PlyReader::readType() {
  using enum NumberType;
  static constexpr std::pair<std::string_view, NumberType> kTypes[] = {
      {"char", int8},     {"int8", int8},       {"uchar", uint8},    {"uint8", uint8},
      {"short", int16},   {"int16", int16},     {"ushort", uint16},  {"uint16", uint16},
      {"int", int32},     {"int32", int32},     {"uint", uint32},    {"uint32", uint32},
      {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64}};
  const std::string_view word = scanner_.word();
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  scanner_.fail(word, fmt::format("\"{}\" is not a type of PLY", word.substr(0, 40)));
}

void PlyReader::readProperty() {
  Property property;
  Scanner afterKeyword = scanner_;
  if (afterKeyword.word() == "list") {
    scanner_ = afterKeyword;
    property.lengthType = readType();
  }
  property.type = readType();
  property.name = scanner_.word();
  elements_.back().properties.push_back(std::move(property));
}

void PlyReader::readHeader() {
  if (scanner_.line() != "ply") input_.fail("is not a PLY file: it does not begin with \"ply\"");
  bool hasFormat = false;
  while (true) {
    const std::string_view word = scanner_.word();
    if (word == "end_header") {
      if (!hasFormat) scanner_.fail(word, "the header says no format");
      return scanner_.endLine();
    }
    if (word == "comment" || word == "obj_info") {
      scanner_.line();
      continue;
    }
    if (word == "format") {
      const std::string_view format = scanner_.word();
      ascii_ = format == "ascii";
      if (format == "binary_big_endian")
        order_ = std::endian::big;
      else if (!ascii_ && format != "binary_little_endian")
        scanner_.fail(format,
                      "the format must be ascii, binary_little_endian or binary_big_endian");
      scanner_.word();  // the version, 1.0 for ever
      hasFormat = true;
    } else if (word == "element") {
      Element& element = elements_.emplace_back();
      element.name = scanner_.word();
      element.count = scanner_.count();
    } else if (word == "property" && !elements_.empty()) {
      readProperty();
    } else {
      scanner_.fail(word,
                    "a line of the header begins with format, element, property, comment, "
                    "obj_info or end_header");
    }
    scanner_.endLine();
  }
}

// Binary data have no lines.
void PlyReader::fail(const char* at, const std::string& message) const {
  if (ascii_) input_.failAtText({at, at}, message);
  input_.failAtByte(at, message);
}

double PlyReader::next(NumberType type) {
  if (ascii_) return scanner_.number();
  if (scanner_.left() < sizeOf(type)) fail(scanner_.position(), "the file ends here, too early");
  const double value = loadNumber(scanner_.position(), type, order_);
  scanner_.skip(sizeOf(type));
  return value;
}

std::size_t PlyReader::listLength(NumberType type) {
  const char* at = scanner_.position();
  const double length = next(type);
  if (!(length >= 0 && length <= 0x1p32 && length == std::floor(length)))
    fail(at, fmt::format("a list cannot have {} entries", length));
  return static_cast<std::size_t>(length);
}

void PlyReader::readRow(const Element& element, std::size_t row) {
  for (const Property& property : element.properties)
    if (property.lengthType) {
      for (std::size_t n = listLength(*property.lengthType); n > 0; --n) next(property.type);
    } else {
      const double value = next(property.type);
      if (property.to) property.to->store(row, static_cast<float>(value));
    }
  if (ascii_) scanner_.endLine();
}

void PlyReader::readBody(const Element& element) {
  const std::size_t size = element.smallestRow(ascii_);
  if (size == 0) return;
  if (ascii_ || element.hasLists()) {
    for (std::size_t row = 0; row < element.count; ++row) readRow(element, row);
    return;
  }
  std::vector<Field> fields;
  std::size_t offset = 0;
  for (const Property& property : element.properties) {
    if (property.to) fields.push_back({offset, property.type, *property.to});
    offset += sizeOf(property.type);
  }
  copyRecords(scanner_.position(), size, element.count, order_, fields);
  scanner_.skip(element.count * size);
}

// Throws if the file cannot hold as many rows as its header says.
void PlyReader::checkRoom(const Element& element) const {
  const std::size_t size = element.smallestRow(ascii_);
  const std::size_t left = scanner_.left() + ascii_;  // the last line may lack its end
  if (size > 0 && element.count > left / size)
    fail(scanner_.position(),
         fmt::format("{} times \"{}\", of at least {} bytes, should follow, but {} bytes are left",
                     element.count, element.name, size, scanner_.left()));
}

// Finds what the properties of the particles mean. Lists mean nothing.
void PlyReader::prepare(Element& vertices) {
  std::vector<std::string> names;
  for (const Property& p : vertices.properties) names.push_back(p.lengthType ? "" : p.name);
  const Columns columns = columnsOf(names, input_);
  allocate(particles_, columns, vertices.count);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i]) {
      Property& p = vertices.properties[i];
      p.to = target(particles_, *columns[i]);
      if (columns[i]->quantity == Quantity::color) p.to->scale = colorScale(p.type);
    }
}

Particles PlyReader::read() {
  readHeader();
  for (Element& element : elements_) {
    const bool wanted = element.name == "vertex";
    checkRoom(element);
    if (wanted) prepare(element);
    readBody(element);
    if (wanted) return std::move(particles_);
  }
  input_.fail("has no element \"vertex\"");
}

}  // namespace

Particles readPly(const Input& input) {
  return PlyReader(input).read();
}

}  // namespace pbrt::particles
