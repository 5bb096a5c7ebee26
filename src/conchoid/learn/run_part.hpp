#pragma once

#include <filesystem>
#include <string>

#include "conchoid/learn/database.hpp"

namespace conchoid {

/// One finished run with its samples: a file in the folder FILE.parts.
struct RunPart {
  RunRecord record;
  SampleSet samples;
};

/// @param header_hash  of the database the run belongs to
void write_run_part(const std::filesystem::path& file, const RunPart& part, std::uint64_t header_hash);
/// Throws InputError that names the file and the remedy if it is damaged or belongs to another database.
RunPart read_run_part(const std::filesystem::path& file, std::uint64_t header_hash);

/// Everything in a header as one text, the shard excepted if so wished; equal texts, equal headers.
std::string header_text(const DatabaseHeader& header, bool with_shard = true);

}  // namespace conchoid
