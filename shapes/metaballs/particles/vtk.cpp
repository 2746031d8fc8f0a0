// Legacy VTK files ("VTK File Formats", Kitware; the VTK User's Guide, 11th edition, chapter 19).
// Binary numbers are big-endian.

#include <fmt/format.h>

#include "formats.h"
#include "quantities.h"
#include "shapes/files/scanner.h"

namespace pbrt::particles {

using files::Field, files::Scanner, files::lowered;

namespace {

class VtkReader {
 public:
  explicit VtkReader(const Input& input) : input_(input), scanner_(input) {}
  Particles read();

 private:
  struct Type {
    NumberType number = NumberType::float32;
    bool bits = false;  // eight to a byte
  };

  void readHeader();
  void readSection(std::string_view keyword);
  bool readTopology(std::string_view keyword);
  bool readAttribute(std::string_view keyword);
  void readScalars();
  void readLookupTable();
  void readField();
  void readMetadata();
  Type readType();
  // `tuples` times `numbers` of a type; kept, if they are of a quantity.
  void readArray(Type type, std::size_t tuples, std::size_t numbers,
                 std::optional<Quantity> quantity = {});
  // The same for an attribute of points or cells by its name.
  void readNamedArray(std::string_view name, Type type, std::size_t tuples, std::size_t numbers);
  std::string_view peek() const;

  const Input& input_;
  Scanner scanner_;
  int version_ = 0;
  bool binary_ = false;
  bool ofPoints_ = false;    // whose attributes are being read
  std::size_t entries_ = 0;  // of which there are so many
  Particles particles_;
};

void VtkReader::readHeader() {
  constexpr std::string_view kMagic = "# vtk DataFile Version ";
  const std::string_view first = scanner_.line();
  if (!first.starts_with(kMagic) || first.size() == kMagic.size())
    input_.fail("is not a legacy VTK file: it does not begin with \"# vtk DataFile Version\"");
  version_ = first[kMagic.size()] - '0';
  scanner_.line();  // a title
  const std::string_view format = scanner_.word();
  binary_ = lowered(format) == "binary";
  if (!binary_ && lowered(format) != "ascii")
    scanner_.fail(format, "the third line must be ASCII or BINARY");
}

// The next word, which may also be the beginning of binary data.
std::string_view VtkReader::peek() const {
  Scanner ahead = scanner_;
  return ahead.atEnd() ? std::string_view() : ahead.word();
}

VtkReader::Type VtkReader::readType() {
  using enum NumberType;
  static constexpr std::pair<std::string_view, NumberType> kTypes[] = {
      {"char", int8},          {"unsigned_char", uint8},
      {"short", int16},        {"unsigned_short", uint16},
      {"int", int32},          {"unsigned_int", uint32},
      {"long", int64},         {"unsigned_long", uint64},
      {"vtktypeint64", int64}, {"vtktypeuint64", uint64},
      {"vtkidtype", int32},    {"float", float32},
      {"double", float64},     {"bit", uint8}};
  const std::string_view word = scanner_.word();
  const std::string lower = lowered(word);
  for (const auto& [name, type] : kTypes)
    if (name == lower) return {type, name == "bit"};
  scanner_.fail(word, fmt::format("arrays of \"{}\" are not read", word.substr(0, 40)));
}

void VtkReader::readArray(Type type, std::size_t tuples, std::size_t numbers,
                          std::optional<Quantity> quantity) {
  if (binary_) scanner_.endLine();
  // Text: a digit and white space each, but at the end.
  const std::size_t size = binary_ ? sizeOf(type.number) : 2;
  const std::size_t room = (scanner_.left() + !binary_) / size * (type.bits ? 8 : 1);
  if (numbers > 0 && tuples > room / numbers) {
    const std::string message =
        fmt::format("{} times {} numbers should follow, but {} bytes are left", tuples, numbers,
                    scanner_.left());
    if (binary_) input_.failAtByte(scanner_.position(), message);
    scanner_.fail({scanner_.position(), scanner_.position()}, message);
  }
  if (numbers == 0) return;
  std::vector<Field> fields;
  if (quantity && !type.bits) {
    allocate(particles_, *quantity, tuples);
    for (std::uint8_t i = 0; i < components(*quantity); ++i) {
      fields.push_back({i * size, type.number, target(particles_, {*quantity, i})});
      if (quantity == Quantity::color) fields.back().to.scale = colorScale(type.number);
    }
  }
  if (binary_) {
    copyRecords(scanner_.position(), numbers * size, tuples, std::endian::big, fields);
    scanner_.skip(type.bits ? (tuples * numbers + 7) / 8 : tuples * numbers * size);
  } else {
    for (std::size_t t = 0; t < tuples; ++t)
      for (std::size_t i = 0; i < numbers; ++i) {
        const double value = scanner_.number();
        if (i < fields.size()) fields[i].to.store(t, static_cast<float>(value));
      }
  }
}

void VtkReader::readNamedArray(std::string_view name, Type type, std::size_t tuples,
                               std::size_t numbers) {
  std::optional<Quantity> quantity = quantityOf(name, numbers);
  if (!ofPoints_ || quantity == Quantity::position) quantity.reset();
  if (quantity && tuples != entries_)
    scanner_.fail(name, fmt::format("has {} values for {} points", tuples, entries_));
  readArray(type, tuples, numbers, quantity);
}

// Lists of points, which particles do not need.
bool VtkReader::readTopology(std::string_view keyword) {
  if (keyword == "cell_types") {
    const std::size_t cells = scanner_.count();
    readArray({NumberType::int32}, cells, 1);
    return true;
  }
  static constexpr std::string_view kLists[] = {"vertices", "lines", "polygons", "triangle_strips",
                                                "cells"};
  if (std::find(std::begin(kLists), std::end(kLists), keyword) == std::end(kLists)) return false;
  const std::size_t lists = scanner_.count();
  const std::size_t numbers = scanner_.count();
  if (version_ < 5) {
    readArray({NumberType::int32}, numbers, 1);
    return true;
  }
  for (const auto& [name, count] :
       {std::pair("offsets", lists), std::pair("connectivity", numbers)}) {
    const std::string_view word = scanner_.word();
    if (lowered(word) != name) scanner_.fail(word, fmt::format("{} should follow", name));
    const Type type = readType();
    readArray(type, count, 1);
  }
  return true;
}

void VtkReader::readScalars() {
  const std::string_view name = scanner_.word();
  const Type type = readType();
  const std::size_t numbers = scanner_.atLineEnd() ? 1 : scanner_.count();
  if (lowered(peek()) == "lookup_table") {
    scanner_.word();
    scanner_.word();  // its name
  }
  readNamedArray(name, type, entries_, numbers);
}

void VtkReader::readField() {
  scanner_.word();  // its name
  for (std::size_t n = scanner_.count(); n > 0; --n) {
    std::string_view name = scanner_.word();
    if (name == "METADATA") {  // of the array before
      readMetadata();
      name = scanner_.word();
    }
    const std::size_t numbers = scanner_.count();
    const std::size_t tuples = scanner_.count();
    readNamedArray(name, readType(), tuples, numbers);
  }
}

// Up to an empty line.
void VtkReader::readMetadata() {
  scanner_.endLine();
  while (scanner_.left() > 0 && !scanner_.line().empty()) {
  }
}

bool VtkReader::readAttribute(std::string_view keyword) {
  static constexpr std::pair<std::string_view, std::size_t> kFixed[] = {
      {"vectors", 3},    {"normals", 3},      {"tensors", 9},   {"tensors6", 6},
      {"global_ids", 1}, {"pedigree_ids", 1}, {"edge_flags", 1}};
  for (const auto& [name, numbers] : kFixed)
    if (name == keyword) {
      const std::string_view array = scanner_.word();
      readNamedArray(array, readType(), entries_, numbers);
      return true;
    }
  if (keyword == "scalars") {
    readScalars();
  } else if (keyword == "texture_coordinates") {
    const std::string_view array = scanner_.word();
    const std::size_t numbers = scanner_.count();
    readNamedArray(array, readType(), entries_, numbers);
  } else if (keyword == "color_scalars") {
    // Bytes in binary files, numbers from 0 to 1 in text.
    const std::string_view array = scanner_.word();
    const std::size_t numbers = scanner_.count();
    readNamedArray(array, {binary_ ? NumberType::uint8 : NumberType::float32}, entries_, numbers);
  } else if (keyword == "lookup_table") {
    scanner_.word();  // its name
    const std::size_t colors = scanner_.count();
    readArray({binary_ ? NumberType::uint8 : NumberType::float32}, colors, 4);
  } else {
    return false;
  }
  return true;
}

void VtkReader::readSection(std::string_view word) {
  const std::string keyword = lowered(word);
  if (keyword == "dataset") {
    const std::string_view kind = scanner_.word();
    if (const std::string k = lowered(kind); k != "polydata" && k != "unstructured_grid")
      scanner_.fail(kind, "only POLYDATA and UNSTRUCTURED_GRID are read");
  } else if (keyword == "points") {
    if (!particles_.positions.empty()) scanner_.fail(word, "these are the second points");
    const std::size_t points = scanner_.count();
    readArray(readType(), points, 3, Quantity::position);
  } else if (keyword == "point_data" || keyword == "cell_data") {
    ofPoints_ = keyword == "point_data";
    entries_ = scanner_.count();
    if (ofPoints_ && entries_ != particles_.positions.size())
      scanner_.fail(word, fmt::format("data of {} points, but there are {}", entries_,
                                      particles_.positions.size()));
  } else if (keyword == "field") {
    readField();
  } else if (keyword == "metadata") {
    readMetadata();
  } else if (!readTopology(keyword) && !readAttribute(keyword)) {
    scanner_.fail(word, fmt::format("\"{}\" begins no part of a VTK file", word.substr(0, 40)));
  }
}

Particles VtkReader::read() {
  readHeader();
  while (!scanner_.atEnd()) readSection(scanner_.word());
  return std::move(particles_);
}

}  // namespace

Particles readVtk(const Input& input) {
  return VtkReader(input).read();
}

}  // namespace pbrt::particles
