#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace conchoid {

/// Regressors that come with the program, by name, each a file in the folder databases/, NAME.forest where the name tells
/// no kind; NAME.boosted are boosted trees of the same samples, NAME.network networks:
///   cube, cylinder, bar, edge-crack, armadillo   of one body each, under random loads
///   versatile                                    of many classes of bodies: for any scene
/// How they were made: databases/README.md, scripts/make_databases.sh.
const std::vector<std::string>& shipped_names();

/// Which of them a method takes that needs a regressor of that kind, where no database is named; empty: none.
std::string_view standard_database(std::string_view kind);

/// The file of one: installed with the program (share/conchoid/databases), or in the source tree that it was built from.
/// Throws InputError, naming the folders looked in, if it is in none of them.
std::filesystem::path shipped_file(std::string_view name);

/// What a user names: one of the shipped ones, or a file. Throws InputError that lists the names where it is neither.
/// @param kind  of regressor that a method needs, for a name that tells none; empty: forest
std::filesystem::path database_file(const std::string& name_or_file, std::string_view kind = "");

}  // namespace conchoid
