// What exporters write and strict readers stumble over.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "conchoid/core/byte_order.hpp"
#include "conchoid/core/context.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace conchoid {
namespace {

struct Listener : MessageSink {
  void message(std::string_view) override {}
  void warning(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<std::string> warnings;
};

struct Heard {
  TriMesh mesh;
  std::vector<std::string> warnings;
};

Heard heard(const std::filesystem::path& path) {
  const auto sink = std::make_shared<Listener>();
  const TriMesh mesh = ExecutionContext(1, sink).run([&] { return read_mesh(path); });
  return {mesh, sink->warnings};
}

void expect_body(const TriMesh& mesh, double area, double volume, std::size_t triangles) {
  EXPECT_EQ(mesh.triangle_count(), triangles);
  EXPECT_TRUE(find_defects(mesh).empty());
  EXPECT_NEAR(surface_area(mesh), area, 1e-12 * area);
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12 * volume);
}

const std::string cube_vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string cube_faces = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string with_crlf(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

/// A prism over a polygon in the plane of x and y, its caps as one polygon each; `lift` bends the caps.
template <class Lift>
std::string prism_obj(const std::vector<std::array<double, 2>>& outline, const Lift& lift) {
  std::string text, bottom = "f", top = "f", sides;
  const std::size_t n = outline.size();
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline)
      text +=
          "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z + lift(x, y)) + "\n";
  for (std::size_t i = 0; i < n; ++i) {
    bottom += " " + std::to_string(n - i);
    top += " " + std::to_string(n + 1 + i);
    const std::size_t j = (i + 1) % n;
    sides += "f " + std::to_string(i + 1) + " " + std::to_string(j + 1) + " " + std::to_string(n + j + 1) +
             " " + std::to_string(n + i + 1) + "\n";
  }
  return text + bottom + "\n" + top + "\n" + sides;
}

class FilesAsTheyAre : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(FilesAsTheyAre, ObjLinesGoOnAfterABackslash) {
  std::string text = cube_vertices + cube_faces;
  text.replace(text.find("v 1 1 0"), 7, "v 1 \\\n1 0");
  text.replace(text.find("f 1 2 6 5"), 9, "f 1 2 \\\n  \\\n6 5");
  text.replace(text.find("f 5 6 7 8"), 9, "f \\\n5 6 7\\\n 8");
  text = "# a comment that ends so \\\n" + text;
  for (const std::string& t : {text, with_crlf(text)}) {
    const Heard file = heard(folder_.write("cube.obj", t));
    expect_body(file.mesh, 6, 1, 12);
    EXPECT_TRUE(file.warnings.empty());
  }
  EXPECT_NE(test::refusal([&] {
              read_mesh(folder_.write("bad.obj", cube_vertices + "f 1 2 \\\n3 9\n"));
            }).find("line 10"),
            std::string::npos)
      << "errors name the line of the file";
}

TEST_F(FilesAsTheyAre, EdgesAndPointsAreSkippedAndSaidSo) {
  const Heard obj =
      heard(folder_.write("cube.obj", cube_vertices + cube_faces + "f 1 2\nf 3 3\nl 1 2 3\np 4\n"));
  expect_body(obj.mesh, 6, 1, 12);
  ASSERT_EQ(obj.warnings.size(), 1u);
  for (const char* part : {"cube.obj", "2 faces of fewer than three vertices", "1 line elements", "1 point"})
    EXPECT_NE(obj.warnings[0].find(part), std::string::npos) << obj.warnings[0];
  const Heard off = heard(folder_.write(
      "t.off", "OFF\n4 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n2 0 1\n3 1 2 3\n3 0 3 2\n"));
  EXPECT_EQ(off.mesh.triangle_count(), 4u);
  EXPECT_EQ(off.warnings.size(), 1u);
}

TEST_F(FilesAsTheyAre, ConcavePolygonsKeepTheirArea) {
  const auto flat = [](double, double) { return 0.0; };
  const std::vector<std::array<double, 2>> l = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (std::size_t first = 0; first < l.size(); ++first) {  // whichever corner the file starts with
    std::vector<std::array<double, 2>> turned;
    for (std::size_t i = 0; i < l.size(); ++i)
      turned.push_back(l[(first + i) % l.size()]);
    expect_body(read_mesh(folder_.write("l.obj", prism_obj(turned, flat))), 14, 3, 20);
  }
  // An arrowhead: a concave quad, which a fan about two of its corners turns over.
  const std::vector<std::array<double, 2>> arrow = {{0, 0}, {1, -1}, {0, 2}, {-1, -1}};
  for (std::size_t first = 0; first < arrow.size(); ++first) {
    std::vector<std::array<double, 2>> turned;
    for (std::size_t i = 0; i < arrow.size(); ++i)
      turned.push_back(arrow[(first + i) % arrow.size()]);
    const TriMesh mesh = read_mesh(folder_.write("arrow.obj", prism_obj(turned, flat)));
    EXPECT_TRUE(find_defects(mesh).empty());
    EXPECT_NEAR(enclosed_volume(mesh), 2, 1e-12) << first;
  }
  // A comb of 60 teeth: more corners than the optimal triangulation takes at once.
  std::vector<std::array<double, 2>> comb = {{0, 0}, {60, 0}};
  for (int i = 60; i-- > 0;) {
    comb.push_back({i + 0.75, 3});
    comb.push_back({i + 0.25, 3});
    comb.push_back({i + 0.25, 1});
    comb.push_back({static_cast<double>(i), 1});
  }
  const TriMesh mesh = read_mesh(folder_.write("comb.obj", prism_obj(comb, flat)));
  EXPECT_TRUE(find_defects(mesh).empty());
}

TEST_F(FilesAsTheyAre, CornersInOneLineMakeNoFlatTriangle) {
  const auto flat = [](double, double) { return 0.0; };
  const std::vector<std::array<double, 2>> square = {{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0, 1}};
  expect_body(read_mesh(folder_.write("square.obj", prism_obj(square, flat))), 6, 1, 20);
}

TEST_F(FilesAsTheyAre, BentPolygonsAreDividedWhereTheyBend) {
  const std::vector<std::array<double, 2>> l = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const TriMesh bent = read_mesh(
      folder_.write("l.obj", prism_obj(l, [](double x, double y) { return 0.1 * x * x + 0.05 * y; })));
  EXPECT_TRUE(find_defects(bent).empty());
  EXPECT_NEAR(enclosed_volume(bent), 3, 0.1) << "caps may be divided differently";
}

TEST_F(FilesAsTheyAre, AsciiStlInAnyCaseOfLetters) {
  std::string stl = "solid t\n";
  for (const char* corners :
       {"vertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n", "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n",
        "vertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n", "vertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\n"})
    stl += std::string("facet normal 0 0 0\nouter loop\n") + corners + "endloop\nendfacet\n";
  stl += "endsolid t\n";
  std::string capitals = stl, mixed = stl;
  for (std::size_t i = 0; i < stl.size(); ++i) {
    capitals[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(stl[i])));
    if (i % 3 == 0) mixed[i] = capitals[i];
  }
  for (const std::string& text : {stl, capitals, mixed, with_crlf(capitals), "  " + capitals})
    EXPECT_NEAR(enclosed_volume(read_mesh(folder_.write("t.stl", text))), 1.0 / 6, 1e-12)
        << text.substr(0, 40);
}

TEST_F(FilesAsTheyAre, BinaryStlWithTrailingBytesOrTheWordSolid) {
  write_mesh(folder_ / "bar.stl", built_in_model("bar").mesh);
  const std::string good = folder_.read("bar.stl");
  std::string solid = good;
  solid.replace(0, 13, "solid facet 1");
  const std::size_t triangles = built_in_model("bar").mesh.triangle_count();
  EXPECT_EQ(heard(folder_.write("a.stl", solid)).mesh.triangle_count(), triangles);
  for (const std::string& base : {good, solid})
    for (const std::string& tail :
         {std::string("\0\0", 2), std::string("made by hand"), std::string(500, 'x')}) {
      const Heard file = heard(folder_.write("b.stl", base + tail));
      EXPECT_EQ(file.mesh.triangle_count(), triangles);
      ASSERT_EQ(file.warnings.size(), 1u);
      EXPECT_NE(file.warnings[0].find(std::to_string(tail.size()) + " bytes"), std::string::npos);
    }
}

TEST_F(FilesAsTheyAre, PlyStripsWithRestartsAndDegenerateTriangles) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
  for (const char* strip : {"14 3 2 7 6 5 2 1 3 0 7 4 5 0 1\n",                   // one strip
                            "20 3 2 7 6 5 2 -1 5 2 1 3 0 7 -1 0 7 4 5 0 1\n",     // three
                            "22 3 2 7 6 5 2 2 5 5 2 1 3 0 7 7 0 0 7 4 5 0 1\n"})  // joined to one
    expect_body(read_mesh(folder_.write("cube.ply", header + strip)), 6, 1, 12);
  EXPECT_NE(
      test::refusal([&] { read_mesh(folder_.write("bad.ply", header + "4 0 1 -2 3\n")); }).find("range"),
      std::string::npos);
}

TEST_F(FilesAsTheyAre, PlyFacesMayComeBeforeTheirVertices) {
  const TriMesh mesh = read_mesh(folder_.write(
      "t.ply",
      "ply\nformat ascii 1.0\nelement face 4\nproperty list uchar int vertex_indices\nelement vertex 4\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n"
      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"));
  EXPECT_NEAR(enclosed_volume(mesh), 1.0 / 6, 1e-12);
}

}  // namespace conchoid
