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

/// The same as bytes. @param header_hash  of the database the run belongs to
std::string run_part_bytes(const RunPart& part, std::uint64_t header_hash);
/// Throws InputError that begins with `name` if they are damaged or belong to another database.
RunPart run_part_from(const std::string& bytes, std::uint64_t header_hash, const std::string& name);

void write_run_part(const std::filesystem::path& file, const RunPart& part, std::uint64_t header_hash);
/// Throws InputError that names the file and the remedy if it is damaged or belongs to another database.
RunPart read_run_part(const std::filesystem::path& file, std::uint64_t header_hash);

/// Everything in a header as one text, the shard excepted if so wished; equal texts, equal headers.
std::string header_text(const DatabaseHeader& header, bool with_shard = true);

}  // namespace conchoid
