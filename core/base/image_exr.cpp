#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <openexr.h>

#include <cerrno>
#include <system_error>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/image_format.h"

namespace pbrt {

namespace {

// Imath multiplies row vectors from the left, GLM column vectors from the right, and each keeps
// the images of the axes side by side: the matrix of the same map has the same 16 numbers in the
// same order.
template <class To, class From>
To sameMap(const From& m) {
  To result;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) result[i][j] = static_cast<float>(m[i][j]);
  return result;
}

Imath::Box2i boxOf(const Bounds2i& b) {
  return {{b.lo.x, b.lo.y}, {b.hi.x - 1, b.hi.y - 1}};
}

struct InsertAttribute {
  Imf::Header& header;
  const std::string& name;

  void operator()(int v) const { header.insert(name, Imf::IntAttribute(v)); }
  void operator()(float v) const { header.insert(name, Imf::FloatAttribute(v)); }
  void operator()(double v) const { header.insert(name, Imf::DoubleAttribute(v)); }
  void operator()(const std::string& v) const { header.insert(name, Imf::StringAttribute(v)); }
  void operator()(const glm::dmat4& v) const {
    header.insert(name, Imf::M44fAttribute(sameMap<Imath::M44f>(v)));
  }
};

// Sets `to` if the attribute holds a T.
template <class T, class Convert>
bool take(const Imf::Attribute& from, ImageAttribute& to, Convert convert) {
  const auto* typed = dynamic_cast<const Imf::TypedAttribute<T>*>(&from);
  if (typed) to = convert(typed->value());
  return typed != nullptr;
}

std::map<std::string, ImageAttribute> attributesOf(const Imf::Header& header) {
  std::map<std::string, ImageAttribute> result;
  const auto same = [](const auto& v) { return v; };
  for (auto it = header.begin(); it != header.end(); ++it) {
    ImageAttribute value;
    if (take<int>(it.attribute(), value, same) || take<float>(it.attribute(), value, same) ||
        take<double>(it.attribute(), value, same) ||
        take<std::string>(it.attribute(), value, same) ||
        take<Imath::M44f>(it.attribute(), value, sameMap<glm::dmat4, Imath::M44f>))
      result.emplace(it.name(), std::move(value));
  }
  return result;
}

// OpenEXR over a C stream, so that each failed write is known with its reason.
class OutStream : public Imf::OStream {
 public:
  explicit OutStream(std::FILE* file) : OStream(""), file_(file) {}

  void write(const char* bytes, int count) override {
    const auto size = static_cast<std::size_t>(count);
    check(std::fwrite(bytes, 1, size, file_) == size);
  }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(ftello(file_)); }
  void seekp(std::uint64_t position) override {
    check(fseeko(file_, static_cast<off_t>(position), SEEK_SET) == 0);
  }
  // Throws if anything failed: OpenEXR keeps to itself what its destructor met.
  void check() const {
    if (error_ != 0) throw std::runtime_error(std::generic_category().message(error_));
  }

 private:
  void check(bool done) {
    if (!done) error_ = errno;
    check();
  }

  std::FILE* file_;
  int error_ = 0;
};

// OpenEXR over the bytes of a file, which must outlive it.
class InStream : public Imf::IStream {
 public:
  InStream(const std::string& name, std::string_view bytes)
      : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char* to, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (at_ > bytes_.size() || size > bytes_.size() - at_)
      throw std::runtime_error("it ends too early");
    bytes_.copy(to, size, at_);
    at_ += size;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

// The C++ reader makes room for an attribute before it looks whether the file is that long: a few
// bytes ask for 2 GiB. The C reader looks first. It may go on after an error, but tells it.
void checkHeader(const std::string& name, std::string_view bytes) {
  struct Probe {
    std::string_view bytes;
    std::string error;  // the first
  } probe{bytes, {}};
  exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
  options.user_data = &probe;
  options.size_fn = [](exr_const_context_t, void* user) {
    return static_cast<std::int64_t>(static_cast<Probe*>(user)->bytes.size());
  };
  options.read_fn = [](exr_const_context_t, void* user, void* to, std::uint64_t size,
                       std::uint64_t offset, exr_stream_error_func_ptr_t) {
    const std::string_view all = static_cast<Probe*>(user)->bytes;
    if (offset > all.size()) return std::int64_t{-1};
    return static_cast<std::int64_t>(all.copy(static_cast<char*>(to), size, offset));
  };
  options.error_handler_fn = [](exr_const_context_t context, exr_result_t, const char* message) {
    void* user = nullptr;
    if (exr_get_user_data(context, &user) != EXR_ERR_SUCCESS) return;
    if (auto& error = static_cast<Probe*>(user)->error; error.empty()) error = message;
  };
  exr_context_t file = nullptr;
  exr_start_read(&file, name.c_str(), &options);
  exr_finish(&file);
  if (!probe.error.empty()) throw std::runtime_error(probe.error);
}

}  // namespace

void encodeExr(std::FILE* to, const Image& image) {
  const Imath::Box2i window = boxOf(image.window);
  Imf::Header header(boxOf({Point2i(0), image.resolution}), window);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 1;  // three times as fast, a few per cent larger
  for (const auto& [name, value] : image.attributes)
    std::visit(InsertAttribute{header, name}, value);

  Imf::FrameBuffer pixels;
  for (std::size_t i = 0; i < image.names.size(); ++i) {
    header.channels().insert(image.names[i], Imf::Channel(Imf::FLOAT));
    pixels.insert(image.names[i], Imf::Slice::Make(Imf::FLOAT, image.channels[i].data(), window));
  }
  OutStream stream(to);
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(pixels);
    file.writePixels(image.window.height());
  }
  stream.check();
}

Image readExr(const std::filesystem::path& path) try {
  const std::string bytes = readFile(path);
  checkHeader(path.string(), bytes);
  InStream stream(path.string(), bytes);
  Imf::InputFile file(stream, 0);
  const Imf::Header& header = file.header();
  const Imath::Box2i& window = header.dataWindow();
  const Imath::Box2i& display = header.displayWindow();

  Image image;
  const Point2i corner(display.min.x, display.min.y);
  image.window = {Point2i(window.min.x, window.min.y) - corner,
                  Point2i(window.max.x + 1, window.max.y + 1) - corner};
  image.resolution = Point2i(display.max.x + 1, display.max.y + 1) - corner;
  image.attributes = attributesOf(header);

  const std::size_t count = static_cast<std::size_t>(image.window.width()) * image.window.height();
  Imf::FrameBuffer pixels;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
      throw std::runtime_error(fmt::format("channel \"{}\" is subsampled", it.name()));
    image.names.emplace_back(it.name());
  }
  // The densest codec, DWA of a constant, comes near this.
  constexpr std::size_t kMostValuesPerByte = 1U << 14U;
  checkRoom(count * image.names.size(), bytes.size(), kMostValuesPerByte);
  for (const std::string& name : image.names) {
    auto& channel = image.channels.emplace_back(count);
    pixels.insert(name, Imf::Slice::Make(Imf::FLOAT, channel.data(), window));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(window.min.y, window.max.y);
  return image;
} catch (const Error&) {
  throw;
} catch (const std::exception& error) {
  // OpenEXR names the file in most of its messages, but not in all.
  const std::string what = reasonOf(error);
  const std::string name = path.string();
  throw Error(
      what.find(name) != std::string::npos ? what : fmt::format("cannot read {}: {}", name, what),
      Failure::io);
}

}  // namespace pbrt
