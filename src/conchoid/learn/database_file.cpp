// File of a database: a block of 512 bytes (magic, version, length and xxHash64 of the rest), then plain
// HDF5, which HDF5 programs find by themselves behind such a block. The hash is checked before anything is
// handed to the HDF5 library, so a damaged file cannot lead it astray.
//   attributes of /: format, version, material, resolution, seed, planned_runs, shard, shards, complete,
//   and files where the specification names meshes or a regressor;
//   /models, /spec: text /runs/<column>: one entry per run;  /samples/run, frame, node, front, <field>: one entry
//   per sample, with its unit as attribute
#include <algorithm>
#include <mutex>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/hdf5_module.hpp"

namespace conchoid {
namespace {

constexpr std::string_view magic = "CNCHDATA";
constexpr std::uint32_t version = kDatabaseVersion;
constexpr std::size_t block_size = 512;
constexpr const char* remedy = "copy it again or generate it again with `conchoid database generate`";

std::mutex hdf5_mutex;  // the library is not safe for several threads at a time

template <class Function>
Function* hdf5_function(const char* symbol, const std::filesystem::path& file) {
  return module_function<Function>(kHdf5Module, symbol, file.string() + ": databases");
}

/// Runs ordered by id, planned, and owning exactly the samples that follow in their order.
void check_order(const Database& database) {
  std::size_t at = 0;
  for (std::size_t r = 0; r < database.runs.size(); ++r) {
    const RunRecord& run = database.runs[r];
    if (!database.header.plans(run.id) || (r > 0 && database.runs[r - 1].id >= run.id))
      throw InputError("its runs are out of order or not planned");
    if (run.samples > database.samples.size() - at)
      throw InputError("samples of run " + std::to_string(run.id) + " are missing");
    for (const std::size_t end = at + run.samples; at < end; ++at)
      if (database.samples.run()[at] != run.id) throw InputError("its samples are out of order");
  }
  if (at != database.samples.size()) throw InputError("some samples belong to no run");
}

/// Checks the block in front; returns the HDF5 part.
std::string open_envelope(const std::string& bytes, const std::string& file) {
  const std::string_view all(bytes);
  if (bytes.empty() || all.substr(0, magic.size()) != magic.substr(0, std::min(magic.size(), bytes.size())))
    throw InputError(
        file +
        ": is not a conchoid database; name a file written by `conchoid database generate` or `merge`");
  if (bytes.size() < block_size) throw InputError(file + ": is truncated; " + remedy);
  ByteReader in(all.substr(magic.size()));
  const auto file_version = in.get<std::uint32_t>();
  const auto length = in.get<std::uint64_t>();
  const auto hash = in.get<std::uint64_t>();
  if (file_version != version)
    throw InputError(
        file + ": has version " + std::to_string(file_version) + ", this program reads version " +
        std::to_string(version) +
        "; use the program that wrote it or generate it again with `conchoid database generate`");
  if (bytes.size() - block_size < length) throw InputError(file + ": is truncated; " + remedy);
  if (bytes.size() - block_size > length || hash_bytes(all.substr(block_size)) != hash ||
      all.substr(magic.size() + 20, block_size - magic.size() - 20).find_first_not_of('\0') !=
          std::string_view::npos)
    throw InputError(file + ": is corrupt (its checksum is wrong); " + remedy);
  return bytes.substr(block_size);
}

}  // namespace

void require_databases(const std::filesystem::path& file) {
  hdf5_function<DatabaseToHdf5>("conchoid_database_to_hdf5", file);
}

Database read_database(const std::filesystem::path& file) {
  const auto from_hdf5 = hdf5_function<DatabaseFromHdf5>("conchoid_database_from_hdf5", file);
  std::string image = open_envelope(read_bytes(file), file.string());
  const std::lock_guard lock(hdf5_mutex);
  try {
    Database database;
    from_hdf5(image, database);
    check_order(database);
    return database;
  } catch (const InputError& e) {
    throw InputError(file.string() + ": " + e.what() + "; " + remedy);
  }
}

void write_database(const std::filesystem::path& file, const Database& database) {
  const auto to_hdf5 = hdf5_function<DatabaseToHdf5>("conchoid_database_to_hdf5", file);
  std::string image;
  try {
    const std::lock_guard lock(hdf5_mutex);
    to_hdf5(database, image);
  } catch (const ComputationError& e) {
    throw ComputationError(file.string() + ": writing failed (" + e.what() + "); is there enough memory?");
  }
  ByteWriter block;
  block.put_raw(magic);
  block.put(version);
  block.put(static_cast<std::uint64_t>(image.size()));
  block.put(hash_bytes(image));
  std::string bytes = block.bytes();
  bytes.resize(block_size, '\0');
  write_bytes(file, bytes + image);
}

}  // namespace conchoid
