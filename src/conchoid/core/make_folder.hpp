#pragma once

#include <filesystem>
#include <string_view>

namespace conchoid {

/// The folder, with those it lies in, if it is not there. Throws InputError that names it and the option to name another with.
void make_folder(const std::filesystem::path& folder, std::string_view option);

}  // namespace conchoid
