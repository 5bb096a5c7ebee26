#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace conchoid {

/// Regressors that come with the program, by name, each a file NAME.forest in the folder databases/:
///   cube, cylinder, bar   of one body each, under random loads
///   versatile             of many classes of bodies: for any scene
/// How they were made: databases/README.md, scripts/make_databases.sh.
const std::vector<std::string_view>& shipped_names();

/// What a method takes where no database is named.
inline constexpr std::string_view kStandardDatabase = "versatile";

/// The file of one: installed with the program (share/conchoid/databases), or in the source tree that it was built from.
/// Throws InputError, naming the folders looked in, if it is in none of them.
std::filesystem::path shipped_file(std::string_view name);

/// What a user names: one of the shipped ones, or a file. Throws InputError that lists the names where it is neither.
std::filesystem::path database_file(const std::string& name_or_file);

}  // namespace conchoid
