#include "outrider/io/camera/photo.hpp"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>

#include "map/image.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_pixels_per_byte = 32;  ///< detection takes 40 bytes a pixel

struct EndDecoder {
  void operator()(void* decoder) const { tjDestroy(decoder); }
};

Outcome<CameraImage> from_jpeg(std::string_view bytes, const std::string& name) {
  const std::unique_ptr<void, EndDecoder> decoder(tjInitDecompress());
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, sampling = 0, colours = 0;
  const auto damaged = [&] {
    return bad_input(
        fmt::format("its JPEG data is damaged ({}); save it anew", tjGetErrorStr2(decoder.get())), name);
  };
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &sampling, &colours) != 0) {
    return damaged();
  }
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  const std::size_t pixels = columns * rows;  // none where the header is cut: decoding says so
  if (auto size = check_image_size(columns, rows, name); pixels > 0 && !size) return pass_on(size);
  if (auto size = check_expansion(pixels, bytes.size(), most_pixels_per_byte, name); !size)
    return pass_on(size);
  CameraImage image{width, height, std::vector<std::uint8_t>(pixels)};
  if (tjDecompress2(decoder.get(), data, bytes.size(), image.values.data(), width, width, height, TJPF_GRAY,
                    TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0) {
    return damaged();
  }
  return image;
}

}  // namespace

Outcome<CameraImage> photo_from_bytes(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\xFF\xD8\xFF")) return from_jpeg(bytes, name);
  if (!is_image(bytes))
    return bad_input("it is no image that is read: PNG, JPEG or PGM; convert it to one of them", name);
  auto image = image_from_bytes(bytes, name);
  if (!image) return pass_on(image);
  if (auto size = check_expansion(image->values.size(), bytes.size(), most_pixels_per_byte, name); !size)
    return pass_on(size);
  return CameraImage{image->width, image->height, std::move(image->values)};
}

Outcome<CameraImage> load_photo(const std::string& path) {
  const auto bytes = read_file(path);
  if (!bytes) return pass_on(bytes);
  return photo_from_bytes(*bytes, path);
}

std::string to_png(const CameraImage& image) {
  PngReader png;
  png.header.width = static_cast<png_uint_32>(image.width);
  png.header.height = static_cast<png_uint_32>(image.height);
  png.header.format = PNG_FORMAT_GRAY;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.header);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&png.header, bytes.data(), &size, 0, image.values.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

}  // namespace outrider
