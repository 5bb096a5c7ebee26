// Databases as HDF5: a module (core/module.hpp). What is where in the file: database_file.cpp.
#include "conchoid/learn/hdf5_module.hpp"

#include <H5Cpp.h>

#include <algorithm>
#include <array>
#include <utility>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

constexpr std::size_t chunk = 16384;

template <class T>
const H5::PredType& type_of() {
  if constexpr (std::is_same_v<T, double>) return H5::PredType::IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5::PredType::STD_I32LE;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5::PredType::STD_U64LE;
}

template <class T>
const H5::PredType& memory_type() {
  if constexpr (std::is_same_v<T, double>) return H5::PredType::NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5::PredType::NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5::PredType::NATIVE_UINT64;
}

H5::DSetCreatPropList storage(std::size_t n) {
  H5::DSetCreatPropList list;
  H5Pset_obj_track_times(list.getId(), false);  // the same content gives the same bytes
  if (n > 0) {
    const hsize_t size = std::min(n, chunk);
    list.setChunk(1, &size);
    list.setShuffle();
    list.setDeflate(4);
  }
  return list;
}

template <class T>
H5::DataSet write_column(const H5::Group& group, const std::string& name, const std::vector<T>& values) {
  const hsize_t n = values.size();
  const H5::DataSet set =
      group.createDataSet(name, type_of<T>(), H5::DataSpace(1, &n), storage(values.size()));
  if (n > 0) set.write(values.data(), memory_type<T>());
  return set;
}

/// Texts of equal length, filled up with zeros.
void write_texts(const H5::Group& group, const std::string& name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& t : texts)
    length = std::max(length, t.size());
  std::string block(length * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i)
    texts[i].copy(block.data() + i * length, length);
  const hsize_t n = texts.size();
  H5::StrType type(H5::PredType::C_S1, length);
  type.setStrpad(H5T_STR_NULLPAD);
  const H5::DataSet set = group.createDataSet(name, type, H5::DataSpace(1, &n), storage(texts.size()));
  if (n > 0) set.write(block.data(), type);
}

template <class T>
void write_attribute(const H5::H5Object& object, const std::string& name, T value) {
  object.createAttribute(name, type_of<T>(), H5::DataSpace()).write(memory_type<T>(), &value);
}

void write_attribute(const H5::H5Object& object, const std::string& name, const std::string& text) {
  const H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(1, text.size()));
  object.createAttribute(name, type, H5::DataSpace()).write(type, text);
}

template <class T>
std::vector<T> read_column(const H5::Group& group, const std::string& name) {
  const H5::DataSet set = group.openDataSet(name);
  const H5::DataSpace space = set.getSpace();
  if (space.getSimpleExtentNdims() != 1) throw InputError("column " + name + " has the wrong shape");
  hsize_t n = 0;
  space.getSimpleExtentDims(&n);
  std::vector<T> values(n);
  if (n > 0) set.read(values.data(), memory_type<T>());
  return values;
}

std::vector<std::string> read_texts(const H5::Group& group, const std::string& name) {
  const H5::DataSet set = group.openDataSet(name);
  const H5::StrType type = set.getStrType();
  hsize_t n = 0;
  set.getSpace().getSimpleExtentDims(&n);
  const std::size_t length = type.getSize();
  std::string block(length * n, '\0');
  if (n > 0) set.read(block.data(), type);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < n; ++i) {
    texts.push_back(block.substr(i * length, length));
    texts.back().erase(texts.back().find_last_not_of('\0') + 1);
  }
  return texts;
}

template <class T>
T read_attribute(const H5::H5Object& object, const std::string& name) {
  T value{};
  object.openAttribute(name).read(memory_type<T>(), &value);
  return value;
}

/// Material constants and their names in the file.
template <class Material>
auto material_fields(Material& m) {
  return std::array<std::pair<const char*, decltype(&m.density)>, 6>{
      {{"youngs_modulus", &m.youngs_modulus},
       {"poisson_ratio", &m.poisson_ratio},
       {"density", &m.density},
       {"strength", &m.strength},
       {"toughness", &m.toughness},
       {"compressive_factor", &m.compressive_factor}}};
}

void write_header(const H5::Group& root, const Database& database) {
  const DatabaseHeader& h = database.header;
  write_attribute(root, "format", std::string("conchoid database"));
  write_attribute(root, "version", kDatabaseVersion);
  for (const auto& [name, value] : material_fields(h.material))
    write_attribute(root, name, *value);
  write_attribute(root, "resolution", h.resolution);
  write_attribute(root, "seed", h.seed);
  write_attribute(root, "planned_runs", h.planned_runs);
  write_attribute(root, "shard", h.shard);
  write_attribute(root, "shards", h.shards);
  write_attribute(root, "complete", static_cast<std::int32_t>(database.complete()));
  write_texts(root, "models", h.models);
  write_texts(root, "spec", {h.spec});
  if (h.files != 0) write_attribute(root, "files", h.files);
}

DatabaseHeader read_header(const H5::Group& root) {
  DatabaseHeader h;
  for (const auto& [name, value] : material_fields(h.material))
    *value = read_attribute<double>(root, name);
  h.resolution = read_attribute<double>(root, "resolution");
  h.seed = read_attribute<std::uint64_t>(root, "seed");
  h.planned_runs = read_attribute<std::int32_t>(root, "planned_runs");
  h.shard = read_attribute<std::int32_t>(root, "shard");
  h.shards = read_attribute<std::int32_t>(root, "shards");
  if (h.planned_runs < 1 || h.shards < 1 || h.shard < 1 || h.shard > h.shards)
    throw InputError("its plan is not valid");
  h.models = read_texts(root, "models");
  const auto spec = read_texts(root, "spec");
  if (spec.size() != 1) throw InputError("its specification is missing");
  h.spec = spec[0];
  if (root.attrExists("files")) h.files = read_attribute<std::uint64_t>(root, "files");
  return h;
}

template <class T, class Get>
std::vector<T> column_of(const std::vector<RunRecord>& runs, Get get) {
  std::vector<T> values;
  values.reserve(runs.size());
  for (const RunRecord& r : runs)
    values.push_back(static_cast<T>(get(r)));
  return values;
}

/// Calls visit(name, member of RunRecord) for every column with one number per run.
template <class Visit>
void visit_run_columns(Visit visit) {
  visit("id", &RunRecord::id);
  visit("seed", &RunRecord::seed);
  visit("magnitude", &RunRecord::magnitude);
  visit("alpha", &RunRecord::alpha);
  visit("beta", &RunRecord::beta);
  visit("body", &RunRecord::body);
  visit("frames", &RunRecord::frames);
  visit("samples", &RunRecord::samples);
  visit("wall_seconds", &RunRecord::wall_seconds);
  visit("hash", &RunRecord::hash);
}

constexpr std::array<const char*, 3> direction_names = {"direction_x", "direction_y", "direction_z"};

void write_runs(const H5::Group& group, const std::vector<RunRecord>& runs) {
  visit_run_columns([&](const char* name, auto member) {
    using T = std::decay_t<decltype(std::declval<RunRecord>().*member)>;
    write_column(group, name, column_of<T>(runs, [&](const RunRecord& r) { return r.*member; }));
  });
  for (int i = 0; i < 3; ++i)
    write_column(group, direction_names[static_cast<std::size_t>(i)],
                 column_of<double>(runs, [&](const RunRecord& r) { return r.direction[i]; }));
  write_column(group, "excluded",
               column_of<std::int32_t>(runs, [](const RunRecord& r) { return r.excluded; }));
  write_texts(group, "body_class",
              column_of<std::string>(runs, [](const RunRecord& r) { return r.body_class; }));
  write_texts(group, "load", column_of<std::string>(runs, [](const RunRecord& r) { return r.load; }));
  write_texts(group, "stop", column_of<std::string>(runs, [](const RunRecord& r) { return r.stop; }));
  write_texts(group, "reason", column_of<std::string>(runs, [](const RunRecord& r) { return r.reason; }));
}

std::vector<RunRecord> read_runs(const H5::Group& group) {
  std::vector<RunRecord> runs(read_column<std::int32_t>(group, "id").size());
  const auto fill = [&](const auto& values, auto set) {
    if (values.size() != runs.size()) throw InputError("the columns of its runs differ in length");
    for (std::size_t i = 0; i < runs.size(); ++i)
      set(runs[i], values[i]);
  };
  visit_run_columns([&](const char* name, auto member) {
    using T = std::decay_t<decltype(std::declval<RunRecord>().*member)>;
    fill(read_column<T>(group, name), [&](RunRecord& r, const T& value) { r.*member = value; });
  });
  for (int i = 0; i < 3; ++i)
    fill(read_column<double>(group, direction_names[static_cast<std::size_t>(i)]),
         [&](RunRecord& r, double value) { r.direction[i] = value; });
  fill(read_column<std::int32_t>(group, "excluded"),
       [](RunRecord& r, std::int32_t value) { r.excluded = value != 0; });
  fill(read_texts(group, "body_class"), [](RunRecord& r, const std::string& value) { r.body_class = value; });
  fill(read_texts(group, "load"), [](RunRecord& r, const std::string& value) { r.load = value; });
  fill(read_texts(group, "stop"), [](RunRecord& r, const std::string& value) { r.stop = value; });
  fill(read_texts(group, "reason"), [](RunRecord& r, const std::string& value) { r.reason = value; });
  return runs;
}

void write_samples(const H5::Group& group, const SampleSet& samples) {
  write_column(group, "run", samples.run());
  write_column(group, "frame", samples.frame());
  write_column(group, "node", samples.node());
  write_column(group, "front", samples.front());
  std::vector<std::int32_t>
      is_new;  // for those who read the file with other programs; ours sees it by the opening
  for (std::size_t i = 0; i < samples.size(); ++i)
    is_new.push_back(is_new_on_front(samples[i]));
  write_attribute(
      write_column(group, "new_on_front", is_new), "about",
      std::string(
          "1: the node was not on a front inside the body before; another one stands for what it was, and "
          "it has no opening"));
  for (std::size_t f = 0; f < SampleSet::field_count; ++f) {
    const SampleField& field = SampleSet::fields()[f];
    write_attribute(write_column(group, std::string(field.name), samples.field(f)), "unit",
                    std::string(field.unit));
  }
}

SampleSet read_samples(const H5::Group& group) {
  SampleSet samples;
  samples.run() = read_column<std::int32_t>(group, "run");
  samples.frame() = read_column<std::int32_t>(group, "frame");
  samples.node() = read_column<std::int32_t>(group, "node");
  // Databases of before it was recorded: one front a frame, which is nearly always true.
  samples.front() = group.nameExists("front") ? read_column<std::int32_t>(group, "front")
                                              : std::vector<std::int32_t>(samples.size(), 0);
  bool even = samples.frame().size() == samples.size() && samples.node().size() == samples.size() &&
              samples.front().size() == samples.size();
  for (std::size_t f = 0; f < SampleSet::field_count; ++f) {
    samples.field(f) = read_column<double>(group, std::string(SampleSet::fields()[f].name));
    even = even && samples.field(f).size() == samples.size();
  }
  if (!even) throw InputError("the columns of its samples differ in length");
  return samples;
}

void to_hdf5(const Database& database, std::string& image) {
  H5::FileAccPropList access;
  access.setCore(1 << 20, false);  // in memory only
  const H5::H5File file("conchoid-database", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access);
  const H5::Group root = file.openGroup("/");
  write_header(root, database);
  write_runs(root.createGroup("runs"), database.runs);
  write_samples(root.createGroup("samples"), database.samples);
  file.flush(H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file.getId(), nullptr, 0);
  if (size < 0) throw ComputationError("no HDF5 image; report this as a bug");
  image.assign(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file.getId(), image.data(), image.size()) < 0)
    throw ComputationError("no HDF5 image; report this as a bug");
}

void from_hdf5(std::string& image, Database& database) {
  H5::FileAccPropList access;
  access.setCore(1 << 20, false);
  H5Pset_file_image(access.getId(), image.data(), image.size());
  const H5::H5File file("conchoid-database", H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access);
  const H5::Group root = file.openGroup("/");
  database.header = read_header(root);
  database.runs = read_runs(root.openGroup("runs"));
  database.samples = read_samples(root.openGroup("samples"));
}

/// The library by itself prints its errors to stderr: not while this object exists, and again as before after.
class SilentHdf5 {
 public:
  SilentHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SilentHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  SilentHdf5(const SilentHdf5&) = delete;
  SilentHdf5& operator=(const SilentHdf5&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace
}  // namespace conchoid

CONCHOID_MODULE_FUNCTION void conchoid_database_to_hdf5(const conchoid::Database& database,
                                                        std::string& image) {
  static_assert(std::is_same_v<decltype(conchoid_database_to_hdf5), conchoid::DatabaseToHdf5>);
  const conchoid::SilentHdf5 silent;
  try {
    conchoid::to_hdf5(database, image);
  } catch (const H5::Exception& e) {
    throw conchoid::ComputationError(e.getDetailMsg());
  }
}

CONCHOID_MODULE_FUNCTION void conchoid_database_from_hdf5(std::string& image, conchoid::Database& database) {
  static_assert(std::is_same_v<decltype(conchoid_database_from_hdf5), conchoid::DatabaseFromHdf5>);
  const conchoid::SilentHdf5 silent;
  try {
    conchoid::from_hdf5(image, database);
  } catch (const H5::Exception& e) {
    throw conchoid::InputError("is not a valid database (" + e.getDetailMsg() + ")");
  }
}
