// Reads what vtk.cpp writes, and no more of the format: one piece, triangles, arrays of base64 with a 64-bit
// byte count before them.
#include <array>
#include <cstdint>
#include <string_view>

#include "conchoid/core/byte_order.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/io/vtk.hpp"

namespace conchoid {
namespace {

class VtuReader {
 public:
  explicit VtuReader(const std::filesystem::path& path) : path_(path), text_(read_bytes(path)) {}

  VtuMesh run() const {
    VtuMesh out;
    const std::vector<VtkField> points = fields("Points"), cells = fields("Cells");
    if (points.size() != 1 || points[0].components != 3) refuse("has no points; make the run again");
    for (std::size_t i = 0; i + 2 < points[0].values.size(); i += 3)
      out.mesh.positions.add({points[0].values[i], points[0].values[i + 1], points[0].values[i + 2]});
    const VtkField* connectivity = find_field(cells, "connectivity");
    if (!connectivity || connectivity->values.size() % 3 != 0) refuse("has no triangles; make the run again");
    for (std::size_t i = 0; i < connectivity->values.size(); i += 3) {
      std::array<NodeId, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const double node = connectivity->values[i + k];
        if (!(node >= 0 && node < static_cast<double>(out.mesh.node_count())))
          refuse("names a point that does not exist; make the run again");
        corners[k] = NodeId(static_cast<std::size_t>(node));
      }
      out.mesh.corners.add(corners);
    }
    out.node_fields = fields("PointData");
    out.triangle_fields = fields("CellData");
    check(out.node_fields, out.mesh.node_count());
    check(out.triangle_fields, out.mesh.triangle_count());
    return out;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw InputError(path_.string() + ": " + why); }

  void check(const std::vector<VtkField>& fields, std::size_t count) const {
    for (const VtkField& f : fields)
      if (f.values.size() != count * static_cast<std::size_t>(f.components))
        refuse("the field '" + f.name + "' is not as long as the mesh; make the run again");
  }

  /// The arrays between <tag> and </tag>.
  std::vector<VtkField> fields(const std::string& tag) const {
    const std::size_t begin = text_.find("<" + tag + ">"), end = text_.find("</" + tag + ">");
    if (begin == std::string::npos || end == std::string::npos || end < begin)
      refuse("is no frame of a run, or is cut off (no <" + tag + ">); make the run again");
    std::vector<VtkField> out;
    for (std::size_t at = text_.find("<DataArray", begin); at < end; at = text_.find("<DataArray", at + 1)) {
      const std::size_t close = text_.find('>', at), stop = text_.find('<', close);
      if (close == std::string::npos || stop == std::string::npos) refuse("is cut off; make the run again");
      const std::string head = text_.substr(at, close - at);
      VtkField field{attribute(head, "Name"), 1, {}};
      field.components = std::atoi(attribute(head, "NumberOfComponents").c_str());
      field.values = values(attribute(head, "type"), bytes(close + 1, stop));
      out.push_back(std::move(field));
    }
    return out;
  }

  std::string attribute(const std::string& head, const std::string& name) const {
    const std::size_t at = head.find(" " + name + "=\"");
    if (at == std::string::npos) refuse("an array has no " + name + "; make the run again");
    const std::size_t begin = at + name.size() + 3;
    return head.substr(begin, head.find('"', begin) - begin);
  }

  std::string bytes(std::size_t begin, std::size_t end) const {
    std::string out;
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t i = begin; i < end && text_[i] != '='; ++i) {
      const char c = text_[i];
      const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                        : c >= 'a' && c <= 'z' ? c - 'a' + 26
                        : c >= '0' && c <= '9' ? c - '0' + 52
                        : c == '+'             ? 62
                        : c == '/'             ? 63
                                               : -1;
      if (digit < 0) refuse("an array is damaged; make the run again");
      bits = bits << 6 | static_cast<std::uint32_t>(digit);
      count += 6;
      if (count >= 8) out += static_cast<char>(bits >> (count -= 8) & 255);
    }
    return out;
  }

  template <class T>
  std::vector<double> numbers(const std::string& raw) const {
    if (raw.size() < 8) refuse("an array is cut off; make the run again");
    const auto size = from_bytes<std::uint64_t>(raw);
    if (size + 8 != raw.size() || size % sizeof(T) != 0) refuse("an array is cut off; make the run again");
    std::vector<double> out;
    for (std::size_t at = 8; at < raw.size(); at += sizeof(T))
      out.push_back(static_cast<double>(from_bytes<T>(std::string_view(raw).substr(at))));
    return out;
  }

  std::vector<double> values(const std::string& type, const std::string& raw) const {
    if (type == "Float64") return numbers<double>(raw);
    if (type == "Int64") return numbers<std::int64_t>(raw);
    if (type == "UInt8") return numbers<std::uint8_t>(raw);
    refuse("holds numbers of type " + type + ", which conchoid does not write; make the run again");
  }

  std::filesystem::path path_;
  std::string text_;
};

}  // namespace

const VtkField* find_field(const std::vector<VtkField>& fields, const std::string& name) {
  for (const VtkField& f : fields)
    if (f.name == name) return &f;
  return nullptr;
}

VtuMesh read_vtu(const std::filesystem::path& path) {
  return VtuReader(path).run();
}

}  // namespace conchoid
