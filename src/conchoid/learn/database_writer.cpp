#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/learn/run_part.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

fs::path parts_folder(const fs::path& file) {
  fs::path folder = file;
  folder += ".parts";
  return folder;
}

/// Holds the lock of a folder of parts until destroyed; the system releases it when the program is killed.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder)
      : descriptor_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0)
      throw InputError(folder.string() + ": cannot be written (" + std::strerror(errno) +
                       "); choose a folder that you may write to");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw InputError(
          folder.string() +
          ": another program is generating this database; wait until it has ended, or use --shard "
          "with another file");
    }
  }
  ~FolderLock() { ::close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

std::string part_name(std::int32_t run) {
  std::string digits = std::to_string(run);
  return "run-" + std::string(digits.size() < 8 ? 8 - digits.size() : 0, '0') + digits + ".bin";
}

/// Id in the name of a part, −1 if it is none.
std::int32_t run_of_part(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.size() < 9 || !name.starts_with("run-") || !name.ends_with(".bin")) return -1;
  const std::string digits = name.substr(4, name.size() - 8);
  if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 9) return -1;
  return std::stoi(digits);
}

bool is_temporary(const fs::path& file) {
  return file.filename().string().find(".tmp-") != std::string::npos;
}

void check_header(const DatabaseHeader& h) {
  if (h.planned_runs < 1)
    throw InputError("a database needs at least one run; give a positive number of runs");
  if (h.shards < 1 || h.shard < 1 || h.shard > h.shards)
    throw InputError("shard " + std::to_string(h.shard) + "/" + std::to_string(h.shards) +
                     " does not exist; give I/N with 1 <= I <= N");
}

}  // namespace

struct DatabaseWriter::State {
  fs::path file, folder;
  DatabaseHeader header;
  std::uint64_t header_hash = 0;
  std::unique_ptr<FolderLock> lock;
  std::map<std::int32_t, RunPart>
      from_file;  ///< runs an earlier finish() put into FILE and whose parts are gone
  std::set<std::int32_t> kept;
  mutable std::mutex mutex;

  void open_folder(bool resume);
  void read_file();
  void read_folder();
  Database assemble() const;
  void remove_folder() const;
};

void DatabaseWriter::State::open_folder(bool resume) {
  if (!resume && (fs::exists(file) || fs::exists(folder)))
    throw InputError((fs::exists(file) ? file : folder).string() +
                     ": exists already; add --resume to go on with it, or remove it to start anew");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(folder.string() + ": cannot be made (" + error.message() +
                     "); choose a folder that you may write to");
  lock = std::make_unique<FolderLock>(folder);
  const std::string text = header_text(header);
  if (!fs::exists(folder / "header.json"))
    write_bytes(folder / "header.json", text);
  else if (read_bytes(folder / "header.json") != text)
    throw InputError(folder.string() +
                     ": was started with another specification or files that it names, number of runs, seed "
                     "or shard; use the same ones, or remove the folder to start anew");
}

void DatabaseWriter::State::read_file() {
  if (!fs::exists(file)) return;
  const Database old = read_database(file);
  if (old.header != header)
    throw InputError(
        file.string() +
        ": was generated with another specification or files that it names, number of runs, seed or shard; "
        "use the same ones, or remove the file to start anew");
  std::size_t first = 0;
  for (const RunRecord& run : old.runs) {
    std::vector<std::size_t> indices(run.samples);
    for (std::size_t i = 0; i < indices.size(); ++i)
      indices[i] = first + i;
    first += run.samples;
    from_file[run.id] = {run, old.samples.subset(indices)};
    kept.insert(run.id);
  }
}

void DatabaseWriter::State::read_folder() {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_temporary(entry.path())) {
      std::error_code ignored;
      fs::remove(entry.path(), ignored);
      continue;
    }
    const std::int32_t run = run_of_part(entry.path());
    if (run < 0) continue;
    const RunPart part = read_run_part(entry.path(), header_hash);
    if (part.record.id != run || !header.plans(run))
      throw InputError(entry.path().string() + ": holds run " + std::to_string(part.record.id) +
                       ", which does not belong there; remove this file");
    kept.insert(run);
  }
}

Database DatabaseWriter::State::assemble() const {
  Database database;
  database.header = header;
  for (const std::int32_t run : kept) {
    const auto old = from_file.find(run);
    const RunPart part =
        old != from_file.end() ? old->second : read_run_part(folder / part_name(run), header_hash);
    database.runs.push_back(part.record);
    database.samples.append(part.samples);
  }
  return database;
}

void DatabaseWriter::State::remove_folder() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (run_of_part(entry.path()) >= 0 || is_temporary(entry.path())) fs::remove(entry.path(), ignored);
  fs::remove(folder / "header.json", ignored);
  fs::remove(folder / "lock", ignored);
  fs::remove(folder, ignored);  // stays if somebody put something else into it
}

DatabaseWriter::DatabaseWriter(fs::path file, DatabaseHeader header, bool resume)
    : state_(std::make_unique<State>()) {
  require_databases(file);
  check_header(header);
  state_->file = std::move(file);
  state_->folder = parts_folder(state_->file);
  state_->header = std::move(header);
  state_->header_hash = hash_bytes(header_text(state_->header));
  if (resume) state_->read_file();
  state_->open_folder(resume);
  state_->read_folder();
}

DatabaseWriter::~DatabaseWriter() = default;

bool DatabaseWriter::has(std::int32_t run) const {
  const std::lock_guard lock(state_->mutex);
  return state_->kept.contains(run);
}

std::size_t DatabaseWriter::size() const {
  const std::lock_guard lock(state_->mutex);
  return state_->kept.size();
}

void DatabaseWriter::add(RunRecord record, const SampleSet& samples) {
  if (!state_->header.plans(record.id))
    throw std::logic_error("run " + std::to_string(record.id) + " is not planned");
  for (const std::int32_t run : samples.run())
    if (run != record.id) throw std::logic_error("a sample bears the id of another run");
  samples.validate();
  if (has(record.id)) throw std::logic_error("run " + std::to_string(record.id) + " is kept already");
  record.samples = samples.size();
  record.hash = samples.hash();
  const std::int32_t id = record.id;
  write_run_part(state_->folder / part_name(id), {std::move(record), samples}, state_->header_hash);
  const std::lock_guard lock(state_->mutex);
  state_->kept.insert(id);
}

void DatabaseWriter::finish() {
  const std::lock_guard lock(state_->mutex);
  const Database database = state_->assemble();
  write_database(state_->file, database);
  if (database.complete()) state_->remove_folder();
}

}  // namespace conchoid
