#include "textures/imagemap/jpeg.h"

#include <fmt/format.h>

#include <csetjmp>
#include <cstdio>
// After cstdio, which it needs.
#include <jpeglib.h>
// After jpeglib.h, which it needs.
#include <jerror.h>

#include "core/base/error.h"
#include "core/base/file.h"

namespace pbrt {

namespace {

// What libjpeg calls back to, and what its calls may not unwind past.
struct JpegReader {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf end{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  std::vector<JSAMPLE> pixels;

  JpegReader() = default;
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
};

void onError(j_common_ptr jpeg) {
  auto& reader = *static_cast<JpegReader*>(jpeg->client_data);
  jpeg->err->format_message(jpeg, reader.message.data());
  std::longjmp(reader.end, 1);
}
// Junk between markers does no harm; what is lost does.
void onWarning(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR &&
      code != JWRN_ADOBE_XFORM && code != JWRN_BOGUS_PROGRESSION)
    onError(jpeg);
}

// The two halves of reading. They hold nothing that has a destructor: errors jump out of them.
bool readHeader(JpegReader& r, const std::string& bytes) {
  if (setjmp(r.end)) return false;
  r.jpeg.client_data = &r;
  jpeg_create_decompress(&r.jpeg);
  jpeg_mem_src(&r.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&r.jpeg, TRUE);
  // Four inks become colours by the profile of a printer, which libjpeg does not do.
  r.jpeg.out_color_space = r.jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&r.jpeg);
  return true;
}
bool readRows(JpegReader& r) {
  if (setjmp(r.end)) return false;
  const std::size_t row = std::size_t{r.jpeg.output_width} * r.jpeg.output_components;
  while (r.jpeg.output_scanline < r.jpeg.output_height) {
    JSAMPROW to = &r.pixels[row * r.jpeg.output_scanline];
    jpeg_read_scanlines(&r.jpeg, &to, 1);
  }
  jpeg_finish_decompress(&r.jpeg);
  return true;
}

Image decode(const std::string& bytes) {
  JpegReader r;
  r.jpeg.err = jpeg_std_error(&r.errors);
  r.errors.error_exit = onError;
  r.errors.emit_message = onWarning;
  if (!readHeader(r, bytes)) throw std::runtime_error(r.message.data());

  const Point2i size(r.jpeg.output_width, r.jpeg.output_height);
  const int channels = r.jpeg.output_components;
  // A block of 64 values may take less than a bit in a progressive file.
  Image image = blankImage(size, channels, bytes.size(), std::size_t{1} << 12U);
  r.pixels.resize(image.channels[0].size() * static_cast<std::size_t>(channels));
  if (!readRows(r)) throw std::runtime_error(r.message.data());

  image.encoded = true;
  const JSAMPLE* from = r.pixels.data();
  for (std::size_t i = 0; i < image.channels[0].size(); ++i)
    for (auto& channel : image.channels) channel[i] = *from++ / 255.F;
  return image;
}

}  // namespace

Image readJpeg(const std::filesystem::path& file) {
  const std::string bytes = readFile(file);
  try {
    return decode(bytes);
  } catch (const std::exception& error) {
    throw Error(fmt::format("cannot read {}: {}", file.string(), reasonOf(error)), Failure::io);
  }
}

}  // namespace pbrt
