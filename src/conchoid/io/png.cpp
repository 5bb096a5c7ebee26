#include <png.h>

#include <string>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/io/image.hpp"

namespace conchoid {

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
