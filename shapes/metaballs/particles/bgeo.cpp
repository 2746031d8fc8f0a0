// Houdini's classic binary geometry, format version 5, as its "HDK_Geometry_classic" documents it:
// big-endian; a header of counts, the definitions of the point attributes, then a record of 32-bit
// numbers a point: x y z w and the attributes. What follows the points is not looked at.

#include <fmt/format.h>

#include "formats.h"
#include "quantities.h"

namespace pbrt::particles {

using files::Field, files::load;

namespace {

class BgeoReader {
 public:
  explicit BgeoReader(const Input& input)
      : input_(input), p_(input.bytes().data()), end_(p_ + input.bytes().size()) {}
  Particles read();

 private:
  struct Attribute {
    Quantity quantity = Quantity::position;
    std::size_t offset = 0;  // in the record of a point
    NumberType type = NumberType::float32;
  };

  const char* take(std::size_t bytes);
  template <class T>
  T next() {
    return load<T>(take(sizeof(T)), std::endian::big);
  }
  std::size_t count();
  void readAttribute();

  const Input& input_;
  const char* p_;
  const char* end_;
  std::size_t recordSize_ = 0;
  std::vector<Attribute> attributes_;
};

const char* BgeoReader::take(std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(end_ - p_))
    input_.failAtByte(end_, "the file ends here, too early");
  p_ += bytes;
  return p_ - bytes;
}

std::size_t BgeoReader::count() {
  const auto n = next<std::int32_t>();
  if (n < 0) input_.failAtByte(p_ - 4, fmt::format("{} is not a count", n));
  return static_cast<std::size_t>(n);
}

void BgeoReader::readAttribute() {
  const auto length = next<std::uint16_t>();
  const std::string_view name(take(length), length);
  const std::size_t numbers = next<std::uint16_t>();
  switch (const auto type = next<std::int32_t>(); type) {
    case 0:               // floats
    case 1:               // integers
    case 5:               // a vector, to be transformed with the points
      take(4 * numbers);  // defaults
      if (const auto quantity = quantityOf(name, numbers))
        attributes_.push_back(
            {*quantity, recordSize_, type == 1 ? NumberType::int32 : NumberType::float32});
      break;
    case 4:  // numbers of strings
      for (std::size_t n = count(); n > 0; --n) take(next<std::uint16_t>());
      break;
    default:
      input_.failAtByte(p_ - 4, fmt::format("the attribute \"{}\" is of type {}, which is not read",
                                            name.substr(0, 40), type));
  }
  recordSize_ += 4 * numbers;
}

Particles BgeoReader::read() {
  if (input_.bytes().starts_with("\x7FNSJ") || input_.bytes().starts_with('['))
    input_.fail(
        "is Houdini's newer .bgeo (JSON), which is not read; save it as .bhclassic or .ply");
  if (!input_.bytes().starts_with("BgeoV"))
    input_.fail("is not a .bgeo file: it does not begin with \"BgeoV\"");
  take(5);
  if (const auto version = next<std::int32_t>(); version != 5)
    input_.failAtByte(p_ - 4, fmt::format("is of version {}; only version 5 is read", version));
  const std::size_t points = count();
  take(3 * 4);  // how many primitives, groups of points, groups of primitives
  const std::size_t attributes = count();
  take(3 * 4);  // attributes of vertices, of primitives, of all

  attributes_.push_back({Quantity::position, 0});
  recordSize_ = 4 * sizeof(float);
  for (std::size_t i = 0; i < attributes; ++i) readAttribute();
  if (points > static_cast<std::size_t>(end_ - p_) / recordSize_)
    input_.failAtByte(p_, fmt::format("{} points of {} bytes should follow, but {} bytes are left",
                                      points, recordSize_, end_ - p_));

  Particles particles;
  for (const Attribute& a : attributes_) allocate(particles, a.quantity, points);
  std::vector<Field> fields;
  for (const Attribute& a : attributes_)
    for (std::uint8_t i = 0; i < components(a.quantity); ++i)
      fields.push_back({a.offset + 4 * i, a.type, target(particles, {a.quantity, i})});
  copyRecords(p_, recordSize_, points, std::endian::big, fields);
  return particles;
}

}  // namespace

Particles readBgeo(const Input& input) {
  return BgeoReader(input).read();
}

}  // namespace pbrt::particles
