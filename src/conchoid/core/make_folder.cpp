#include "conchoid/core/make_folder.hpp"

#include <fmt/format.h>

#include "conchoid/core/error.hpp"

namespace conchoid {

void make_folder(const std::filesystem::path& folder, std::string_view option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw InputError(fmt::format("{}: the folder cannot be made ({}); name another with {}", folder.string(),
                                 error ? error.message() : "a file bears its name", option));
}

}  // namespace conchoid
