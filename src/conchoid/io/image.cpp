#include "conchoid/io/image.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {

void Image::set(int x, int y, const Color& color) {
  const auto bytes = to_bytes(color);
  std::copy(bytes.begin(), bytes.end(), pixel(x, y));
}

void Image::blend(int x, int y, const Color& color, double coverage) {
  if (x < 0 || y < 0 || x >= width || y >= height || !(coverage > 0)) return;
  const auto bytes = to_bytes(color);
  std::uint8_t* p = pixel(x, y);
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = static_cast<std::uint8_t>(std::lround(p[i] + std::min(coverage, 1.0) * (bytes[i] - p[i])));
}

void write_png(const std::filesystem::path& path, const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  const auto encode = [&](void* memory, png_alloc_size_t& size) {
    if (!png_image_write_to_memory(&header, memory, &size, 0, image.rgb.data(), 0, nullptr))
      throw ComputationError(path.string() + ": the picture could not be encoded (" + header.message + ")");
  };
  png_alloc_size_t size = 0;
  encode(nullptr, size);
  std::string bytes(size, '\0');
  encode(bytes.data(), size);
  AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(size));
  file.commit();
}

}  // namespace conchoid
