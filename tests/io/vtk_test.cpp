#include "conchoid/io/vtk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "conchoid/core/error.hpp"
#include "io/samples.hpp"

using namespace conchoid;

namespace {

/// Tags opened and closed in order, attributes quoted, nothing after the root: the least a reader of XML asks
/// for.
void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    const std::size_t end = xml.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    at = end;
    EXPECT_EQ(tag.find('<'), std::string::npos) << tag;
    EXPECT_EQ(std::count(tag.begin(), tag.end(), '"'), 2 * std::count(tag.begin(), tag.end(), '=')) << tag;
    if (tag.front() == '?' || tag.back() == '/') continue;
    if (tag.front() == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ("/" + open.back(), tag);
      open.pop_back();
    } else {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  EXPECT_TRUE(open.empty());
}

std::string decoded(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

/// Numbers of the named DataArray; its byte count comes first.
template <class T>
std::vector<T> array(const std::string& xml, const std::string& name) {
  const std::size_t tag = xml.find("Name=\"" + name + "\"");
  if (tag == std::string::npos) return {};
  const std::size_t begin = xml.find('>', tag) + 1;
  const std::string bytes = decoded(xml.substr(begin, xml.find('<', begin) - begin));
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), 8);
  EXPECT_EQ(size + 8, bytes.size());
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + 8, size);
  return values;
}

}  // namespace

TEST(Vtu, MeshAndFieldsComeBackBitForBit) {
  const TemporaryFolder folder;
  const TriMesh mesh = box({-0.5, -0.1, 1.0 / 3.0}, {0.5, 0.5, 0.7});
  std::vector<Vec3> displacement;
  std::vector<double> stress;
  for (int i = 0; i < 8; ++i)
    displacement.push_back({0.1 * i, -1e-300, 1e300});
  for (int t = 0; t < 12; ++t)
    stress.push_back(t / 7.0);
  write_vtu(folder / "m.vtu", mesh, {vector_field("displacement", displacement)},
            {scalar_field("s<1>", stress)});

  const std::string xml = file_content(folder / "m.vtu");
  expect_well_formed(xml);
  EXPECT_NE(xml.find("NumberOfPoints=\"8\" NumberOfCells=\"12\""), std::string::npos);
  EXPECT_EQ(array<double>(xml, "s&lt;1&gt;"), stress);
  const auto points = array<double>(xml, "Points"), u = array<double>(xml, "displacement");
  ASSERT_EQ(points.size(), 24u);
  ASSERT_EQ(u.size(), 24u);
  for (std::size_t n = 0; n < 8; ++n)
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(points[3 * n + static_cast<std::size_t>(i)], mesh.positions[NodeId(n)][i]);
      EXPECT_EQ(u[3 * n + static_cast<std::size_t>(i)], displacement[n][i]);
    }
  const auto connectivity = array<std::int64_t>(xml, "connectivity"),
             offsets = array<std::int64_t>(xml, "offsets");
  ASSERT_EQ(connectivity.size(), 36u);
  EXPECT_EQ(connectivity[4], mesh.corners[TriId(1)][1].value);
  EXPECT_EQ(offsets.back(), 36);
  EXPECT_EQ(array<std::uint8_t>(xml, "types"), std::vector<std::uint8_t>(12, 5));
}

TEST(Vtu, ReaderTakesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const TriMesh mesh = box({-0.5, -0.1, 1.0 / 3.0}, {0.5, 0.5, 0.7});
  const std::vector<Vec3> u(8, Vec3(0.1, -1e-300, 1e300));
  Mat3 stress;
  stress << 1, 4, 6, 4, 2, 5, 6, 5, 3;
  write_vtu(folder / "m.vtu", mesh, {vector_field("u", u)},
            {tensor_field("stress", std::vector<Mat3>(12, stress))});
  const VtuMesh back = read_vtu(folder / "m.vtu");
  EXPECT_EQ(back.mesh.positions, mesh.positions);
  EXPECT_EQ(back.mesh.corners, mesh.corners);
  ASSERT_NE(find_field(back.node_fields, "u"), nullptr);
  EXPECT_EQ(find_field(back.node_fields, "u")->values, vector_field("u", u).values);
  ASSERT_EQ(back.triangle_fields.size(), 1u);
  EXPECT_EQ(back.triangle_fields[0].components, 6);  // xx, yy, zz, xy, yz, xz
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_EQ(back.triangle_fields[0].values[6 + k], static_cast<double>(k + 1));
  EXPECT_EQ(find_field(back.node_fields, "stress"), nullptr);
}

TEST(Vtu, DamagedFilesAreRefused) {
  const TemporaryFolder folder;
  write_vtu(folder / "m.vtu", box({0, 0, 0}, {1, 1, 1}), {}, {});
  const std::string whole = file_content(folder / "m.vtu");
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{40}, whole.size() / 3, whole.size() / 2, whole.size() - 60}) {
    std::ofstream(folder / "cut.vtu", std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(read_vtu(folder / "cut.vtu"), InputError) << length;
  }
  EXPECT_THROW(read_vtu(folder / "missing.vtu"), InputError);
}

TEST(Vtu, FieldOfWrongLengthIsOurBug) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_vtu(folder / "m.vtu", box({0, 0, 0}, {1, 1, 1}), {scalar_field("f", {1.0})}, {}),
               std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "m.vtu"));
}

TEST(Pvd, ListsFramesWithTimes) {
  const TemporaryFolder folder;
  write_pvd(folder / "run.pvd", {{0.0, "frames/frame_0000.vtu"}, {1.5e-5, "frames/frame_0001.vtu"}});
  const std::string xml = file_content(folder / "run.pvd");
  expect_well_formed(xml);
  EXPECT_NE(xml.find("timestep=\"1.5e-05\""), std::string::npos);
  EXPECT_NE(xml.find("file=\"frames/frame_0001.vtu\""), std::string::npos);
}
