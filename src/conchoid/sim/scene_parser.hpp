#pragma once

#include <set>

#include "conchoid/sim/scene.hpp"
#include "conchoid/sim/toml_table.hpp"

namespace conchoid {

/// Whole content of a text file. Throws InputError when it cannot be read.
std::string read_text_file(const std::filesystem::path& path);

/// The file that `key` names. Throws InputError when it is not there. @param folder  of the scene
std::filesystem::path existing_file(const TomlTable& table, std::string_view key,
                                    const std::filesystem::path& folder);
/// One of the files that `key` names.
std::filesystem::path existing_file(const TomlTable& table, std::string_view key, const std::string& name,
                                    const std::filesystem::path& folder);

/// Throws InputError for a key that does not belong to the table's kind.
/// @param name  of the table, for messages; @param kinds_of_key  keys that belong to some kinds only
void require_keys_of_kind(
    const TomlTable& table, std::string_view name, const std::string& kind,
    const std::vector<std::pair<std::string_view, std::set<std::string>>>& kinds_of_key);

/// The factors of the field [material.KEY] or [[material.KEY]] (material_keys.cpp).
std::vector<FieldFactor> read_material_field(const TomlTable& material, std::string_view key,
                                             const std::filesystem::path& folder);

/// Keys of a table that exclude each other: exactly one must be there. Returns it.
/// @param what  the table, for messages
std::string_view one_of(const TomlTable& table, const std::vector<std::string_view>& keys,
                        std::string_view what);

/// The key `axes`: three directions at right angles, of any length, as the columns of a rotation (or of one with
/// a mirror). The identity without the key. @param name  of the table, for messages
Mat3 read_axes(const TomlTable& table, std::string_view name);

/// The tables [[region]] (region_keys.cpp).
void read_regions(const TomlTable& file, Scene& scene);

/// The tables [[boundary]] (boundary_keys.cpp). The scene must have its body and regions.
void read_boundary(const TomlTable& file, Scene& scene);

/// The table [body_force] (boundary_keys.cpp).
void read_body_force(const TomlTable& file, Scene& scene);

/// The scene in a parsed file; tables and keys that do not belong to scenes are not looked at.
Scene scene_from(const TomlTable& file, const std::string& name, const std::filesystem::path& folder);

/// Throws InputError, at `key` of `table`, if neither the scene nor its built-in model has a region of that
/// name.
void require_region(const Scene& scene, const std::string& region, const TomlTable& table,
                    std::string_view key);

}  // namespace conchoid
