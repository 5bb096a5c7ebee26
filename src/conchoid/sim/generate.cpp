#include "conchoid/sim/generate.hpp"

#include <fmt/core.h>

#include <atomic>
#include <exception>
#include <optional>
#include <span>
#include <thread>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/learn/run_part.hpp"
#include "conchoid/sim/make_runs.hpp"

namespace conchoid {
namespace {

DatabaseHeader make_header(const DatabaseSpec& spec, const GenerateOptions& options) {
  const MaterialSpec& m = spec.scene.material;
  DatabaseHeader header;
  header.models = spec.world ? spec.world->classes : std::vector{body_class(spec.scene.body)};
  if (!spec.world)
    header.material = {m.youngs_modulus, m.poisson_ratio, m.density,
                       m.strength,       m.toughness,     m.compressive_factor};
  header.resolution = spec.scene.resolution.crack.value_or(0);
  header.spec = spec.scene.text;
  for (const std::filesystem::path& file : spec.files)
    header.files = hash_bytes(read_bytes(file), header.files);
  header.seed = spec.seed;
  header.planned_runs = spec.runs;
  header.shard = options.shard;
  header.shards = options.shards;
  return header;
}

std::uint64_t hash_of(const DatabaseHeader& header) {
  return hash_bytes(header_text(header));
}

// What rank 0 sends is a list of runs, what comes back are finished runs, one by one, and nothing at the end.

void make_share(const DatabaseSpec& spec, const DatabaseHeader& header, Ranks& ranks) {
  const std::string list = ranks.receive().bytes;
  ByteReader in(list);
  const auto runs = in.get_all<std::int32_t>(list.size() / sizeof(std::int32_t));
  make_runs(spec, runs, [&](RunPart part) {
    part.record.samples = part.samples.size();
    ranks.send(0, run_part_bytes(part, hash_of(header)));
  });
  ranks.send(0, {});
}

// Rank 0's dealings with the others while it makes runs itself: gives away their shares of what is missing, and keeps what
// they send.
class Collector {
 public:
  // Leaves in `missing` what rank 0 is to make.
  Collector(Ranks& ranks, const DatabaseHeader& header, DatabaseWriter& writer, Progress& progress,
            std::vector<std::int32_t>& missing)
      : ranks_(ranks), header_hash_(hash_of(header)), writer_(writer), progress_(progress) {
    std::vector<std::vector<std::int32_t>> share(static_cast<std::size_t>(ranks.size()));
    for (std::size_t i = 0; i < missing.size(); ++i)
      share[i % share.size()].push_back(missing[i]);
    for (std::size_t r = 1; r < share.size(); ++r) {
      ByteWriter out;
      out.put_all(std::span<const std::int32_t>(share[r]));
      ranks.send(static_cast<int>(r), out.bytes());
    }
    missing = share.front();
    thread_ = std::thread([this] { collect(); });
  }
  ~Collector() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  // Waits for the others. Throws what went wrong with their runs, and Interrupted after Ctrl-C.
  void finish() {
    while (!done_) {
      throw_if_interrupted();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void collect() {
    try {
      for (int working = ranks_.size() - 1; working > 0 && !stop_;) {
        const std::optional<Ranks::Message> message = ranks_.poll();
        if (!message) {
          std::this_thread::sleep_for(std::chrono::milliseconds(2));
        } else if (message->bytes.empty()) {
          --working;
        } else {
          RunPart part = run_part_from(message->bytes, header_hash_,
                                       fmt::format("what rank {} has sent", message->from));
          writer_.add(std::move(part.record), part.samples);
          progress_.advance();
        }
      }
    } catch (...) {
      error_ = std::current_exception();
    }
    done_ = true;
  }

  Ranks& ranks_;
  std::uint64_t header_hash_;
  DatabaseWriter& writer_;
  Progress& progress_;
  std::thread thread_;
  std::atomic<bool> stop_ = false, done_ = false;
  std::exception_ptr error_;
};

}  // namespace

void generate_database(const DatabaseSpec& spec, const GenerateOptions& options) {
  const DatabaseHeader header = make_header(spec, options);
  if (options.ranks != nullptr && options.ranks->rank() > 0) {
    make_share(spec, header, *options.ranks);
    return;
  }
  DatabaseWriter writer(options.out, header, options.resume);
  std::vector<std::int32_t> missing;
  for (int run = options.shard - 1; run < spec.runs; run += options.shards)
    if (!options.close && !writer.has(run)) missing.push_back(run);
  Progress progress("runs", missing.size());
  std::optional<Collector> others;
  if (options.ranks != nullptr) others.emplace(*options.ranks, header, writer, progress, missing);
  make_runs(spec, missing, [&](RunPart part) {
    writer.add(std::move(part.record), part.samples);
    progress.advance();
  });
  if (others) others->finish();
  writer.finish();
}

}  // namespace conchoid
