#include "conchoid/learn/database.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <random>
#include <thread>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/database_provenance.hpp"
#include "conchoid/learn/summary.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

DatabaseHeader header(std::int32_t runs) {
  DatabaseHeader h;
  h.models = {"cube", "cylinder"};
  h.material = {3.1e9, 0.327, 1200, 7.6e7, 1e6, 3};
  h.resolution = 0.1;
  h.spec = "model = \"cube\"\n# ümlaut\n";
  h.seed = 42;
  h.planned_runs = runs;
  return h;
}

RunRecord record(std::int32_t id) {
  RunRecord r;
  r.id = id;
  r.seed = 1000u + static_cast<std::uint64_t>(id);
  r.direction = {0.6, 0, 0.8};
  r.magnitude = 1e6 * (id + 1);
  r.alpha = 36.9;
  r.beta = 10.0 * id;
  r.frames = 5 + id % 7;
  r.stop = id % 3 ? "separated" : "arrested";
  r.excluded = id % 4 == 3;
  if (r.excluded) r.reason = "did not stop within 31 frames";
  r.wall_seconds = 0.25;
  return r;
}

SampleSet samples_of(std::int32_t id) {
  return id % 5 == 4 ? SampleSet() : test::synthetic_run(id, 3 + id % 3, 6, 1.1, 0.4);
}

/// Generates whatever is missing, in a given order of runs.
void generate(const fs::path& file, const DatabaseHeader& h, bool resume, bool backwards = false) {
  DatabaseWriter writer(file, h, resume);
  for (std::int32_t i = 0; i < h.planned_runs; ++i) {
    const std::int32_t run = backwards ? h.planned_runs - 1 - i : i;
    if (h.plans(run) && !writer.has(run)) writer.add(record(run), samples_of(run));
  }
  writer.finish();
}

void expect_refused(const fs::path& file, const std::string& about) {
  try {
    read_database(file);
    FAIL() << about << " was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(file.filename().string()), std::string::npos)
        << about << ": " << e.what();
    EXPECT_NE(std::string(e.what()).find("conchoid database generate"), std::string::npos)
        << about << ": " << e.what();
  }
}

TEST(Database, GivesBackWhatWasPutIn) {
  const TemporaryFolder folder;
  generate(folder / "a.h5", header(11), false);
  const Database d = read_database(folder / "a.h5");
  EXPECT_EQ(d.header, header(11));
  EXPECT_TRUE(d.complete());
  ASSERT_EQ(d.runs.size(), 11u);
  SampleSet all, training;
  for (std::int32_t id = 0; id < 11; ++id) {
    RunRecord expected = record(id);
    expected.samples = samples_of(id).size();
    expected.hash = samples_of(id).hash();
    EXPECT_EQ(d.runs[static_cast<std::size_t>(id)], expected);
    all.append(samples_of(id));
    if (!expected.excluded) training.append(samples_of(id));
  }
  EXPECT_EQ(d.samples, all);
  EXPECT_EQ(d.training_samples(), training);
  EXPECT_FALSE(fs::exists(folder / "a.h5.parts")) << "nothing is left beside a complete database";
}

TEST(Database, NodesThatAreNewOnAFrontAreLearnedFromWhereThatIsAskedFor) {
  Database d;
  d.runs = {record(0)};
  d.samples = samples_of(0);
  const std::size_t others = d.training_samples().size();
  Sample fresh = d.samples[0];
  fresh.opening = Vec3::Zero();
  d.samples.add(fresh);
  EXPECT_EQ(d.training_samples().size(), others);
  TrainingChoice choice;
  choice.new_nodes = true;
  EXPECT_EQ(d.training_samples(choice).size(), others + 1);
}

TEST(Database, IsPlainHdf5BehindItsFirstBlock) {
  const TemporaryFolder folder;
  generate(folder / "a.h5", header(3), false);
  const std::string bytes = read_bytes(folder / "a.h5");
  EXPECT_EQ(bytes.substr(512, 8), "\x89HDF\r\n\x1a\n");
  for (const char* column : {"node", "K_I", "opening_III", "new_on_front"})
    EXPECT_NE(bytes.find(column), std::string::npos) << column;
}

TEST(Database, HasTheSameBytesInWhateverOrderTheRunsEnd) {
  const TemporaryFolder folder;
  generate(folder / "a.h5", header(20), false);
  generate(folder / "b.h5", header(20), false, true);
  {
    DatabaseWriter writer(folder / "c.h5", header(20), false);
    std::vector<std::thread> workers;
    for (int w = 0; w < 3; ++w)
      workers.emplace_back([&, w] {
        for (std::int32_t run = w; run < 20; run += 3)
          writer.add(record(run), samples_of(run));
      });
    for (auto& worker : workers)
      worker.join();
    writer.finish();
  }
  EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "b.h5"));
  EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "c.h5"));
}

TEST(Database, CanBeStoppedFinishedAndTakenUpAgain) {
  const TemporaryFolder folder;
  {
    DatabaseWriter writer(folder / "a.h5", header(9), false);
    for (const std::int32_t run : {7, 2, 4})
      writer.add(record(run), samples_of(run));
    writer.finish();
  }
  const Database part = read_database(folder / "a.h5");
  EXPECT_FALSE(part.complete());
  EXPECT_EQ(part.runs.size(), 3u);
  fs::remove_all(folder / "a.h5.parts");  // the file alone is enough to go on
  generate(folder / "a.h5", header(9), true);
  generate(folder / "b.h5", header(9), false);
  EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "b.h5"));
  generate(folder / "a.h5", header(9), true);
  EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "b.h5")) << "nothing to do, nothing changes";
  EXPECT_FALSE(fs::exists(folder / "a.h5.parts"));
}

TEST(Database, SurvivesBeingKilledAtAnyMoment) {
  const TemporaryFolder folder;
  const DatabaseHeader h = header(60);
  const auto start = std::chrono::steady_clock::now();
  generate(folder / "whole.h5", h, false);
  const auto whole =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
  std::mt19937_64 random(3);
  int kills = 0, kept_by_killed = 0;
  // On a busy machine a child can be done before it is killed: then more rounds.
  for (int round = 0; round < 3 || (kills <= 3 && round < 20); ++round) {
    const fs::path file = folder / ("killed-" + std::to_string(round) + ".h5");
    for (int attempt = 0; attempt < 60; ++attempt) {
      const pid_t child = ::fork();
      if (child == 0) {
        try {
          generate(file, h, true);
        } catch (...) {
          ::_exit(1);
        }
        ::_exit(0);
      }
      ::usleep(static_cast<useconds_t>(random() % static_cast<std::uint64_t>(1 + whole.count() / 2)));
      ::kill(child, SIGKILL);
      int status = 0;
      ::waitpid(child, &status, 0);
      ASSERT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) != 0) << "taking up again failed";
      if (WIFEXITED(status)) break;
      ++kills;
      const DatabaseWriter writer(file, h, true);
      EXPECT_GE(static_cast<int>(writer.size()), kept_by_killed) << "no finished run is lost";
      kept_by_killed = static_cast<int>(writer.size());
    }
    kept_by_killed = 0;
    generate(file, h, true);
    EXPECT_EQ(read_bytes(file), read_bytes(folder / "whole.h5"));
    EXPECT_FALSE(fs::exists(file.string() + ".parts"));
  }
  EXPECT_GT(kills, 3);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_TRUE(entry.path().extension() == ".h5" ||
                entry.path().filename().string().find(".tmp-") != std::string::npos);
}

TEST(Database, DoesNotOverwriteAndDoesNotMixSpecifications) {
  const TemporaryFolder folder;
  { DatabaseWriter(folder / "a.h5", header(5), false).add(record(1), samples_of(1)); }
  EXPECT_THROW(DatabaseWriter(folder / "a.h5", header(5), false), InputError);
  EXPECT_THROW(DatabaseWriter(folder / "a.h5", header(6), true), InputError);
  generate(folder / "a.h5", header(5), true);
  EXPECT_THROW(DatabaseWriter(folder / "a.h5", header(5), false), InputError);
  DatabaseHeader other = header(5);
  other.material.toughness = 2e6;
  EXPECT_THROW(DatabaseWriter(folder / "a.h5", other, true), InputError);
  EXPECT_FALSE(fs::exists(folder / "a.h5.parts"));
  EXPECT_THROW(DatabaseWriter("/proc/no-such-place/a.h5", header(5), false), InputError);
  EXPECT_THROW(DatabaseWriter(folder / "b.h5", header(0), false), InputError);
  DatabaseHeader shard = header(5);
  shard.shard = 3, shard.shards = 2;
  EXPECT_THROW(DatabaseWriter(folder / "b.h5", shard, false), InputError);
}

TEST(Database, OneWriterAtATime) {
  const TemporaryFolder folder;
  const DatabaseWriter first(folder / "a.h5", header(5), false);
  EXPECT_THROW(DatabaseWriter(folder / "a.h5", header(5), true), InputError);
}

TEST(Database, RefusesRunsThatAreNotPlannedOrKeptAlready) {
  const TemporaryFolder folder;
  DatabaseWriter writer(folder / "a.h5", header(5), false);
  writer.add(record(1), samples_of(1));
  EXPECT_THROW(writer.add(record(1), samples_of(1)), std::logic_error);
  EXPECT_THROW(writer.add(record(5), samples_of(5)), std::logic_error);
  EXPECT_THROW(writer.add(record(2), samples_of(3)), std::logic_error) << "samples of another run";
  SampleSet bad = samples_of(2);
  bad.field(0)[0] = std::nan("");
  EXPECT_THROW(writer.add(record(2), bad), InputError);
}

TEST(Database, NamesADamagedPart) {
  const TemporaryFolder folder;
  { DatabaseWriter(folder / "a.h5", header(5), false).add(record(1), samples_of(1)); }
  const fs::path part = folder / "a.h5.parts/run-00000001.bin";
  std::string bytes = read_bytes(part);
  bytes[bytes.size() / 2] ^= 1;
  write_bytes(part, bytes);
  try {
    DatabaseWriter(folder / "a.h5", header(5), true);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("run-00000001.bin"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("remove"), std::string::npos);
  }
  fs::remove(part);
  EXPECT_EQ(DatabaseWriter(folder / "a.h5", header(5), true).size(), 0u);
}

TEST(DatabaseMerge, ShardsMakeTheWhole) {
  const TemporaryFolder folder;
  std::vector<fs::path> files;
  for (std::int32_t shard = 1; shard <= 3; ++shard) {
    DatabaseHeader h = header(10);
    h.shard = shard;
    h.shards = 3;
    files.push_back(folder / ("shard-" + std::to_string(shard)));
    generate(files.back(), h, false);
    EXPECT_TRUE(read_database(files.back()).complete());
  }
  EXPECT_EQ(read_database(files[0]).runs.size(), 4u);
  generate(folder / "whole", header(10), false);
  const Database whole = read_database(folder / "whole");
  const Database merged = merge_databases({files[2], files[0], files[1], files[0]});
  EXPECT_EQ(merged.hash(), whole.hash());
  write_database(folder / "merged", merged);
  EXPECT_EQ(read_bytes(folder / "merged"), read_bytes(folder / "whole"));
  EXPECT_FALSE(merge_databases({files[0], files[1]}).complete());
}

TEST(DatabaseMerge, RefusesWhatDoesNotBelongTogether) {
  const TemporaryFolder folder;
  generate(folder / "a", header(4), false);
  DatabaseHeader other = header(4);
  other.spec = "model = \"bar\"\n";
  generate(folder / "b", other, false);
  EXPECT_THROW(merge_databases({folder / "a", folder / "b"}), InputError);
  {
    DatabaseWriter writer(folder / "c", header(4), false);
    SampleSet changed = samples_of(2);
    changed.field(0)[0] *= 2;
    writer.add(record(2), changed);
    writer.finish();
  }
  EXPECT_THROW(merge_databases({folder / "a", folder / "c"}), InputError) << "run 2 differs";
  EXPECT_THROW(merge_databases({}), InputError);
}

TEST(DatabaseFile, RefusesTruncatedDamagedAndForeignFiles) {
  const TemporaryFolder folder;
  generate(folder / "whole", header(2), false);
  const std::string bytes = read_bytes(folder / "whole");
  for (std::size_t n = 0; n < bytes.size(); n += n < 40 ? 1 : 331) {
    folder.write("part", std::string_view(bytes).substr(0, n));
    expect_refused(folder / "part", std::to_string(n) + " bytes");
    std::string damaged = bytes;
    damaged[n] = static_cast<char>(damaged[n] ^ 4);
    folder.write("damaged", damaged);
    expect_refused(folder / "damaged", "byte " + std::to_string(n));
  }
  write_bytes(folder / "longer", bytes + "x");
  expect_refused(folder / "longer", "an extra byte");
  write_bytes(folder / "foreign", bytes.substr(512));
  expect_refused(folder / "foreign", "HDF5 without the block in front");
  write_bytes(folder / "text", "model = \"cube\"\n");
  expect_refused(folder / "text", "a specification");
  std::string newer = bytes;
  newer[8] = 7;
  write_bytes(folder / "newer", newer);
  EXPECT_THROW(read_database(folder / "newer"), InputError);
  EXPECT_THROW(read_database(folder / "absent"), InputError);
  EXPECT_THROW(read_database(folder.path()), InputError);
}

TEST(DatabaseFile, RefusesHdf5ThatBearsTheRightHashButIsNoDatabase) {
  const TemporaryFolder folder;
  generate(folder / "whole", header(2), false);
  std::string bytes = read_bytes(folder / "whole");
  for (std::size_t round = 0; round < 6; ++round) {
    std::string image = bytes.substr(512);
    // The names of attributes and columns are what makes it ours: change one.
    const std::vector<std::string> names = {"planned_runs", "toughness", "samples",
                                            "excluded",     "K_III",     "spec"};
    const std::string& victim = names[round];
    std::size_t at = image.find(victim);
    ASSERT_NE(at, std::string::npos);
    for (; at != std::string::npos; at = image.find(victim, at))
      image[at] = 'X';
    ByteWriter block;
    block.put_raw("CNCHDATA");
    block.put(std::uint32_t{1});
    block.put(static_cast<std::uint64_t>(image.size()));
    block.put(hash_bytes(image));
    std::string head = block.bytes();
    head.resize(512, '\0');
    folder.write("forged", head + image);
    expect_refused(folder / "forged", "without " + victim);
  }
}

TEST(DatabaseInfo, CountsRunsSamplesAndReasons) {
  const TemporaryFolder folder;
  generate(folder / "a", header(12), false);
  const Database d = read_database(folder / "a");
  const DatabaseInfo info = database_info(d);
  EXPECT_EQ(info.runs, 12u);
  EXPECT_EQ(info.excluded_runs, 3u);
  EXPECT_EQ(info.samples, d.samples.size());
  EXPECT_EQ(info.training_samples, d.training_samples().size());
  EXPECT_EQ(info.stops.at("arrested"), 4u);
  EXPECT_EQ(info.exclusions.at("did not stop within 31 frames"), 3u);
  EXPECT_DOUBLE_EQ(info.wall_seconds, 3);
  for (const char* key :
       {"\"runs\": 12", "\"complete\": true", "\"features\": [", "\"models\": [", "\"toughness\""})
    EXPECT_NE(json_text(info).find(key), std::string::npos) << key;
}

TEST(DatabaseStatistics, AreThoseOfTable1) {
  const Statistics s = statistics({3, 1, 2, 10});
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.mean, 4);
  EXPECT_DOUBLE_EQ(s.coefficient_of_variation, std::sqrt(50.0 / 3) / 4);
  EXPECT_LT(statistics({-1, -2, -4}).coefficient_of_variation, 0)
      << "it has the sign of the mean, as published";
  const TemporaryFolder folder;
  generate(folder / "a", header(6), false);
  const Database d = read_database(folder / "a");
  const DatabaseStatistics stats = database_statistics(d);
  EXPECT_EQ(stats.samples, d.training_samples().size());
  EXPECT_DOUBLE_EQ(stats.K[1].mean, statistics(d.training_samples().field(1)).mean);
}

TEST(JoinedSamples, KnowOnlyTheClassesThatTheyHold) {
  Database d;
  d.header = header(4);
  for (std::int32_t id = 0; id < 3; ++id) {
    d.runs.push_back(record(id));
    d.runs.back().body_class = id == 1 ? "cylinder" : "cube";
    d.samples.append(samples_of(id));
  }
  const auto joined = [&](const TrainingChoice& choice) { return join_samples({d, d}, choice); };
  EXPECT_EQ(joined({}).provenance.models, (std::vector<std::string>{"cube", "cylinder"}));
  for (const TrainingChoice& choice :
       {TrainingChoice{true, {"cylinder"}, {}}, TrainingChoice{true, {}, {"cube"}}}) {
    EXPECT_EQ(joined(choice).provenance.models, std::vector<std::string>{"cylinder"});
    EXPECT_EQ(joined(choice).samples.size(), 2 * samples_of(1).size());
  }
}

}  // namespace
}  // namespace conchoid
