#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Numbers attached to the nodes or the triangles of a mesh, `components` per element, one element after the
/// other.
struct VtkField {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

VtkField scalar_field(std::string name, const std::vector<double>& values);
VtkField vector_field(std::string name, const std::vector<Vec3>& values);
/// Symmetric tensors, six components in VTK's order: xx, yy, zz, xy, yz, xz.
VtkField tensor_field(std::string name, const std::vector<Mat3>& values);

/// Writes a triangle mesh with its fields as a VTK XML unstructured grid (.vtu: base64 binary, double
/// precision), for ParaView. Throws std::logic_error where a field is not as long as the mesh (our bug).
void write_vtu(const std::filesystem::path& path, const TriMesh& mesh,
               const std::vector<VtkField>& node_fields, const std::vector<VtkField>& triangle_fields);

/// A mesh with its fields, as write_vtu() took it.
struct VtuMesh {
  TriMesh mesh;
  std::vector<VtkField> node_fields, triangle_fields;
};

/// Reads a file of write_vtu(). Throws InputError (file and remedy) for a damaged or foreign one.
VtuMesh read_vtu(const std::filesystem::path& path);
/// The field of that name, or nullptr.
const VtkField* find_field(const std::vector<VtkField>& fields, const std::string& name);

struct PvdEntry {
  double time = 0;   ///< [s] or frame number
  std::string file;  ///< relative to the .pvd
};

/// Writes a ParaView collection (.pvd): the frames of a run with their times.
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

}  // namespace conchoid
