#include <string>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/io/image.hpp"
#include "conchoid/io/picture_module.hpp"

namespace conchoid {

void write_png(const std::filesystem::path& path, const Image& image) {
  std::string bytes;
  const auto encode = module_function<EncodePng>(kPictureModule, "conchoid_encode_png", "pictures");
  try {
    encode(image, bytes);
  } catch (const ComputationError& error) {
    throw ComputationError(path.string() + ": the picture could not be encoded (" + error.what() + ")");
  }
  AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

}  // namespace conchoid
