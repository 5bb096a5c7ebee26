#include "conchoid/io/vtk.hpp"

#include <cstdint>
#include <ostream>
#include <stdexcept>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/base64.hpp"
#include "conchoid/core/byte_order.hpp"
#include "conchoid/core/numbers.hpp"

namespace conchoid {
namespace {

constexpr std::uint8_t vtk_triangle = 5;

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

/// One DataArray: byte count (UInt64) and bytes, together in base64.
template <class T>
void write_array(std::ostream& out, const char* type, const std::string& name, int components,
                 const std::vector<T>& values) {
  std::string bytes;
  bytes.reserve(8 + sizeof(T) * values.size());
  append_bytes(bytes, static_cast<std::uint64_t>(sizeof(T) * values.size()));
  for (const T& value : values)
    append_bytes(bytes, value);
  out << "<DataArray type=\"" << type << "\" Name=\"" << xml_escaped(name) << "\" NumberOfComponents=\""
      << components << "\" format=\"binary\">" << base64(bytes) << "</DataArray>\n";
}

void write_fields(std::ostream& out, const char* tag, const std::vector<VtkField>& fields,
                  std::size_t count) {
  out << '<' << tag << ">\n";
  for (const VtkField& field : fields) {
    if (field.values.size() != count * static_cast<std::size_t>(field.components))
      throw std::logic_error("write_vtu: the field '" + field.name + "' is not as long as the mesh");
    write_array(out, "Float64", field.name, field.components, field.values);
  }
  out << "</" << tag << ">\n";
}

}  // namespace

VtkField scalar_field(std::string name, const std::vector<double>& values) {
  return {std::move(name), 1, values};
}

VtkField vector_field(std::string name, const std::vector<Vec3>& values) {
  VtkField field{std::move(name), 3, {}};
  field.values.reserve(3 * values.size());
  for (const Vec3& v : values)
    field.values.insert(field.values.end(), {v[0], v[1], v[2]});
  return field;
}

VtkField tensor_field(std::string name, const std::vector<Mat3>& values) {
  VtkField field{std::move(name), 6, {}};
  field.values.reserve(6 * values.size());
  for (const Mat3& m : values)
    field.values.insert(field.values.end(), {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)});
  return field;
}

void write_vtu(const std::filesystem::path& path, const TriMesh& mesh,
               const std::vector<VtkField>& node_fields, const std::vector<VtkField>& triangle_fields) {
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& corners : mesh.corners) {
    for (NodeId c : corners)
      connectivity.push_back(c.value);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "<?xml version=\"1.0\"?>\n"
      << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n"
      << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << mesh.node_count() << "\" NumberOfCells=\""
      << mesh.triangle_count() << "\">\n";
  write_fields(out, "PointData", node_fields, mesh.node_count());
  write_fields(out, "CellData", triangle_fields, mesh.triangle_count());
  out << "<Points>\n";
  write_array(out, "Float64", "Points", 3, vector_field("", mesh.positions).values);
  out << "</Points>\n<Cells>\n";
  write_array(out, "Int64", "connectivity", 1, connectivity);
  write_array(out, "Int64", "offsets", 1, offsets);
  write_array(out, "UInt8", "types", 1, std::vector<std::uint8_t>(mesh.triangle_count(), vtk_triangle));
  out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  file.commit();
}

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const PvdEntry& entry : entries)
    out << "<DataSet timestep=\"" << shortest(entry.time) << "\" group=\"\" part=\"0\" file=\""
        << xml_escaped(entry.file) << "\"/>\n";
  out << "</Collection>\n</VTKFile>\n";
  file.commit();
}

}  // namespace conchoid
