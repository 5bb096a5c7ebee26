#pragma once

#include "conchoid/sim/scene.hpp"
#include "conchoid/sim/toml_table.hpp"

namespace conchoid {

/// Whole content of a text file. Throws InputError when it cannot be read.
std::string read_text_file(const std::filesystem::path& path);

/// The scene in a parsed file; tables and keys that do not belong to scenes are not looked at.
Scene scene_from(const TomlTable& file, const std::string& name, const std::filesystem::path& folder);

/// Throws InputError, at `key` of `table`, if neither the scene nor its built-in model has a region of that
/// name.
void require_region(const Scene& scene, const std::string& region, const TomlTable& table,
                    std::string_view key);

}  // namespace conchoid
