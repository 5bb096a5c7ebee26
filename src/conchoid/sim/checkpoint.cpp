#include "conchoid/sim/checkpoint.hpp"

#include <cstdint>
#include <cstdio>
#include <span>
#include <string_view>
#include <system_error>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "conchoid rows 2\n";

void put(ByteWriter& out, const DenseMatrix& m) {
  out.put(static_cast<std::uint64_t>(m.rows));
  out.put(static_cast<std::uint64_t>(m.columns));
  out.put_all(std::span<const double>(m.data));
}

DenseMatrix get_matrix(ByteReader& in) {
  DenseMatrix m;
  m.rows = in.get<std::uint64_t>();
  m.columns = in.get<std::uint64_t>();
  m.data = in.get_all<double>(m.rows * m.columns);
  return m;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError(file.string() + ": " + why +
                   "; leave out --resume to make the run anew, or name another folder with --out");
}

}  // namespace

Checkpoint::Checkpoint(fs::path folder, std::string identity, Earlier earlier, BackgroundQueue& queue)
    : folder_(std::move(folder) / "resume"), identity_(std::move(identity)), queue_(queue) {
  if (earlier == Earlier::keep)
    while (fs::exists(file(frames_ + 1))) {
      read(frames_ + 1);
      ++frames_;
    }
  remove_from(frames_ + 1);
}

fs::path Checkpoint::file(int frame) const {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%04d.rows", frame);
  return folder_ / name;
}

void Checkpoint::begin(int frame) {
  records_ = frame <= frames_ ? read(frame) : std::vector<Record>{};
  next_ = 0;
}

void Checkpoint::finish(int frame) {
  if (frame <= frames_) return;
  queue_.add([file = file(frame), identity = identity_, records = std::move(records_)] {
    write(file, identity, records);
  });
  records_.clear();
}

void Checkpoint::write(const fs::path& file, const std::string& identity,
                       const std::vector<Record>& records) {
  ByteWriter out;
  out.put_raw(kMagic);
  out.put_text(identity);
  out.put(static_cast<std::uint64_t>(records.size()));
  for (const Record& record : records) {
    out.put_text(record.name);
    out.put(static_cast<std::uint64_t>(record.rows.size()));
    for (const EnrichmentRows& rows : record.rows) {
      put(out, rows.body);
      put(out, rows.enriched);
      put(out, rows.sources);
    }
  }
  const std::uint64_t check = hash_bytes(out.bytes());
  out.put(check);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  write_bytes(file, out.bytes());
}

std::vector<Checkpoint::Record> Checkpoint::read(int frame) const {
  const fs::path path = file(frame);
  const std::string bytes = read_bytes(path);
  const std::string_view all = bytes;
  if (!all.starts_with(kMagic)) refuse(path, "is not what a run leaves to go on from");
  try {
    const std::string_view content = all.substr(0, all.size() - sizeof(std::uint64_t));
    if (ByteReader(all.substr(content.size())).get<std::uint64_t>() != hash_bytes(content))
      throw OutOfBytes();
    ByteReader in(content.substr(kMagic.size()));
    if (in.get_text() != identity_)
      refuse(path, "belongs to another scene or method, or to another version of conchoid");
    std::vector<Record> records(in.get<std::uint64_t>());
    for (Record& record : records) {
      record.name = in.get_text();
      record.rows.resize(in.get<std::uint64_t>());
      for (EnrichmentRows& rows : record.rows) {
        rows.body = get_matrix(in);
        rows.enriched = get_matrix(in);
        rows.sources = get_matrix(in);
      }
    }
    return records;
  } catch (const OutOfBytes&) {
    refuse(path, "is cut short or damaged");
  }
}

// Files half written when a run was killed go too.
void Checkpoint::remove_from(int frame) {
  std::error_code ignored;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    int number = 0;
    if (std::sscanf(name.c_str(), "frame_%d.rows", &number) != 1) continue;
    if (number >= frame || name.find(".tmp-") != std::string::npos) old.push_back(entry.path());
  }
  for (const fs::path& path : old)
    fs::remove(path, ignored);
  fs::remove(folder_, ignored);  // if it is empty
}

void Checkpoint::remove() {
  remove_from(1);
}

std::optional<std::vector<EnrichmentRows>> Checkpoint::recall(const std::string& name) {
  if (next_ >= records_.size() || records_[next_].name != name) return std::nullopt;
  return std::move(records_[next_++].rows);
}

void Checkpoint::keep(const std::string& name, const std::vector<EnrichmentRows>& rows) {
  records_.push_back({name, rows});
  next_ = records_.size();
}

}  // namespace conchoid
