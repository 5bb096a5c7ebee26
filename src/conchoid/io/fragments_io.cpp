#include "conchoid/io/fragments_io.hpp"

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/io/colors.hpp"
#include "conchoid/io/corner_normals.hpp"
#include "conchoid/io/numbers.hpp"
#include "conchoid/io/ply.hpp"

namespace conchoid {
namespace {

void write_material(std::ostream& out, const char* name, const Color& color) {
  out << "newmtl " << name << "\nKd " << shortest(color.r) << ' ' << shortest(color.g) << ' '
      << shortest(color.b) << "\nKa 0 0 0\nKs 0.05 0.05 0.05\nNs 20\nillum 2\n\n";
}

/// Faces of one kind as a group. A normal of the file belongs to each corner: number 3t + k + 1.
void write_group(std::ostream& out, const Fragment& fragment, FaceKind kind, const char* name) {
  out << "g " << name << "\nusemtl " << name << '\n';
  for (std::size_t t = 0; t < fragment.mesh.triangle_count(); ++t) {
    if (fragment.face_kind[t] != kind) continue;
    out << 'f';
    for (std::size_t k = 0; k < 3; ++k)
      out << ' ' << fragment.mesh.corners[TriId(t)][k].value + 1 << "//" << 3 * t + k + 1;
    out << '\n';
  }
}

}  // namespace

void write_fragment_ply(const std::filesystem::path& path, const Fragment& fragment) {
  write_ply(path, {fragment.mesh, fragment.face_kind, fragment.source, {}});
}

void write_fragment_obj(const std::filesystem::path& path, const Fragment& fragment) {
  const std::filesystem::path material = std::filesystem::path(path).replace_extension(".mtl");
  AtomicFile materials(material);
  write_material(materials.stream(), "original", original_color);
  write_material(materials.stream(), "fracture", fracture_color);
  materials.commit();

  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "# conchoid fragment, lengths in metres\nmtllib " << material.filename().string() << '\n';
  for (const Vec3& x : fragment.mesh.positions)
    out << "v " << shortest(x[0]) << ' ' << shortest(x[1]) << ' ' << shortest(x[2]) << '\n';
  for (const auto& corners : corner_normals(fragment.mesh, fragment.face_kind))
    for (const Vec3& n : corners) {
      out << "vn";
      for (int i = 0; i < 3; ++i)
        out << ' ' << shortest(static_cast<double>(static_cast<float>(n[i])));
      out << '\n';
    }
  write_group(out, fragment, FaceKind::original, "original");
  write_group(out, fragment, FaceKind::fracture, "fracture");
  file.commit();
}

}  // namespace conchoid
