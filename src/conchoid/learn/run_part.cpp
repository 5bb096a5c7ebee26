// File of one finished run, little-endian: magic (8 bytes) · hash of the header u64 · record · samples column
// by column · xxHash64 of all bytes before it.
#include "conchoid/learn/run_part.hpp"

#include <nlohmann/json.hpp>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

constexpr std::string_view magic = "CNCHRUN3";

void put_record(ByteWriter& out, const RunRecord& r) {
  out.put(r.id);
  out.put(r.seed);
  for (int i = 0; i < 3; ++i)
    out.put(r.direction[i]);
  for (const double x : {r.magnitude, r.alpha, r.beta, r.wall_seconds})
    out.put(x);
  out.put(r.body);
  out.put_text(r.body_class);
  out.put_text(r.load);
  out.put(r.frames);
  out.put_text(r.stop);
  out.put(static_cast<std::uint32_t>(r.excluded));
  out.put_text(r.reason);
  out.put(r.samples);
  out.put(r.hash);
}

RunRecord get_record(ByteReader& in) {
  RunRecord r;
  r.id = in.get<std::int32_t>();
  r.seed = in.get<std::uint64_t>();
  for (int i = 0; i < 3; ++i)
    r.direction[i] = in.get<double>();
  for (double* x : {&r.magnitude, &r.alpha, &r.beta, &r.wall_seconds})
    *x = in.get<double>();
  r.body = in.get<std::int32_t>();
  r.body_class = in.get_text();
  r.load = in.get_text();
  r.frames = in.get<std::int32_t>();
  r.stop = in.get_text();
  r.excluded = in.get<std::uint32_t>() != 0;
  r.reason = in.get_text();
  r.samples = in.get<std::uint64_t>();
  r.hash = in.get<std::uint64_t>();
  return r;
}

}  // namespace

std::string header_text(const DatabaseHeader& h, bool with_shard) {
  const MaterialRecord& m = h.material;
  nlohmann::json j = {
      {"format", "conchoid database parts"},
      {"models", h.models},
      {"material",
       {m.youngs_modulus, m.poisson_ratio, m.density, m.strength, m.toughness, m.compressive_factor}},
      {"resolution", h.resolution},
      {"spec", h.spec},
      {"seed", h.seed},
      {"planned_runs", h.planned_runs}};
  for (const SampleField& f : SampleSet::fields())
    j["fields"].push_back(std::string(f.name));
  if (h.files != 0) j["files"] = h.files;
  if (with_shard) j["shard"] = {h.shard, h.shards};
  return j.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string run_part_bytes(const RunPart& part, std::uint64_t header_hash) {
  ByteWriter out;
  out.put_raw(magic);
  out.put(header_hash);
  put_record(out, part.record);
  out.put_all(std::span<const std::int32_t>(part.samples.frame()));
  out.put_all(std::span<const std::int32_t>(part.samples.node()));
  out.put_all(std::span<const std::int32_t>(part.samples.front()));
  for (std::size_t f = 0; f < SampleSet::field_count; ++f)
    out.put_all(std::span<const double>(part.samples.field(f)));
  out.put(hash_bytes(out.bytes()));
  return out.bytes();
}

void write_run_part(const std::filesystem::path& file, const RunPart& part, std::uint64_t header_hash) {
  write_bytes(file, run_part_bytes(part, header_hash));
}

RunPart read_run_part(const std::filesystem::path& file, std::uint64_t header_hash) {
  return run_part_from(read_bytes(file), header_hash, file.string());
}

RunPart run_part_from(const std::string& bytes, std::uint64_t header_hash, const std::string& name) {
  const auto refuse = [&](const std::string& what) {
    return InputError(name + ": " + what + "; remove this file and the run will be generated again");
  };
  if (!std::string_view(bytes).starts_with(magic)) throw refuse("is not a finished run of a database");
  if (bytes.size() < magic.size() + 16 ||
      ByteReader(std::string_view(bytes).substr(bytes.size() - 8)).get<std::uint64_t>() !=
          hash_bytes(std::string_view(bytes).substr(0, bytes.size() - 8)))
    throw refuse("is truncated or corrupt");
  try {
    ByteReader in(std::string_view(bytes).substr(magic.size(), bytes.size() - magic.size() - 8));
    if (in.get<std::uint64_t>() != header_hash) throw refuse("belongs to another database");
    RunPart part;
    part.record = get_record(in);
    const std::size_t n = part.record.samples;
    if (n > in.left()) throw OutOfBytes();
    part.samples.resize(n);
    part.samples.run().assign(n, part.record.id);
    part.samples.frame() = in.get_all<std::int32_t>(n);
    part.samples.node() = in.get_all<std::int32_t>(n);
    part.samples.front() = in.get_all<std::int32_t>(n);
    for (std::size_t f = 0; f < SampleSet::field_count; ++f)
      part.samples.field(f) = in.get_all<double>(n);
    return part;
  } catch (const OutOfBytes&) {
    throw refuse("is truncated or corrupt");
  }
}

}  // namespace conchoid
