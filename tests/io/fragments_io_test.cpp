#include "conchoid/io/fragments_io.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/formats/ply.hpp"
#include "conchoid/surface/corner_normals.hpp"
#include "conchoid/surface/fragment_attributes.hpp"
#include "io/samples.hpp"

#ifdef CONCHOID_HAVE_ASSIMP
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#endif

using namespace conchoid;
using Json = nlohmann::json;

namespace {

struct Glb {
  Json json;
  std::string bytes;
};

template <class T>
T value_at(const std::string& bytes, std::size_t at) {
  T value{};
  EXPECT_LE(at + sizeof(T), bytes.size());
  if (at + sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// Takes the container apart as the specification describes it.
Glb opened(const std::string& file) {
  EXPECT_EQ(file.substr(0, 4), "glTF");
  EXPECT_EQ(value_at<std::uint32_t>(file, 4), 2u);
  EXPECT_EQ(value_at<std::uint32_t>(file, 8), file.size());
  const std::size_t text = value_at<std::uint32_t>(file, 12);
  EXPECT_EQ(text % 4, 0u);
  EXPECT_EQ(file.substr(16, 4), "JSON");
  const std::size_t size = value_at<std::uint32_t>(file, 20 + text);
  EXPECT_EQ(size % 4, 0u);
  EXPECT_EQ(file.substr(24 + text, 4), std::string("BIN\0", 4));
  EXPECT_EQ(28 + text + size, file.size());
  return {Json::parse(file.substr(20, text)), file.substr(28 + text)};
}

/// Bytes of an accessor, after checking its view.
std::string accessed(const Glb& glb, const Json& accessor, std::size_t element_size) {
  const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const auto offset = view["byteOffset"].get<std::size_t>(), length = view["byteLength"].get<std::size_t>();
  EXPECT_EQ(offset % 4, 0u);
  EXPECT_LE(offset + length, glb.json["buffers"][0]["byteLength"].get<std::size_t>());
  EXPECT_EQ(length, accessor["count"].get<std::size_t>() * element_size);
  return glb.bytes.substr(offset, length);
}

/// The broken cube with two materials on its outside and texture coordinates.
std::vector<Fragment> painted_cube(double height) {
  std::vector<Fragment> pieces = broken_cube(height);
  for (Fragment& piece : pieces) {
    SurfaceAttributes paint;
    paint.materials = {"wood", "steel"};
    for (std::size_t t = 0; t < 12; ++t) {
      paint.material.push_back(t < 8 ? 0 : 1);
      const double s = static_cast<double>(t);
      paint.uv.push_back({Vec2(s / 12, 0), Vec2((s + 1) / 12, 0.25), Vec2(s / 12, 0.5)});
    }
    std::vector<Fragment> one{piece};
    transfer_attributes(one, piece.mesh, paint, {});
    piece = one[0];
  }
  return pieces;
}

void expect_valid_primitive(const Glb& glb, const Json& primitive, std::size_t triangles) {
  const Json& accessors = glb.json["accessors"];
  const Json& position = accessors[primitive["attributes"]["POSITION"].get<std::size_t>()];
  const Json& normal = accessors[primitive["attributes"]["NORMAL"].get<std::size_t>()];
  const Json& index = accessors[primitive["indices"].get<std::size_t>()];
  const std::size_t vertices = position["count"];
  EXPECT_EQ(normal["count"], vertices);
  EXPECT_EQ(index["count"], 3 * triangles);
  const std::string x = accessed(glb, position, 12), n = accessed(glb, normal, 12),
                    corners = accessed(glb, index, 4);
  for (std::size_t i = 0; i < 3; ++i) {
    float low = INFINITY, high = -INFINITY;
    for (std::size_t v = 0; v < vertices; ++v) {
      low = std::min(low, value_at<float>(x, 12 * v + 4 * i));
      high = std::max(high, value_at<float>(x, 12 * v + 4 * i));
    }
    EXPECT_EQ(position["min"][i].get<float>(), low);
    EXPECT_EQ(position["max"][i].get<float>(), high);
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    double length2 = 0;
    for (std::size_t i = 0; i < 3; ++i)
      length2 += std::pow(value_at<float>(n, 12 * v + 4 * i), 2);
    EXPECT_NEAR(length2, 1, 1e-5);
  }
  for (std::size_t i = 0; i < 3 * triangles; ++i)
    EXPECT_LT(value_at<std::uint32_t>(corners, 4 * i), vertices);
}

}  // namespace

TEST(CornerNormals, BoxStaysSharpAndSphereLikeFanIsSmooth) {
  const TriMesh cube = box({0, 0, 0}, {1, 1, 1});
  const auto normals = corner_normals(cube, {});
  for (std::size_t t = 0; t < 12; ++t)
    for (const Vec3& n : normals[t])
      EXPECT_NEAR((n - unit_normal(cube, TriId(t))).norm(), 0, 1e-14);

  TriMesh roof = sheet(2, 0);
  for (Vec3& x : roof.positions)
    x.z() = -0.1 * std::abs(x.x());  // ridge along y, 11° to each side
  const auto bent = corner_normals(roof, {});
  const std::vector<FaceKind> halves{FaceKind::original, FaceKind::original, FaceKind::fracture,
                                     FaceKind::fracture, FaceKind::original, FaceKind::original,
                                     FaceKind::fracture, FaceKind::fracture};
  const auto split = corner_normals(roof, halves);
  EXPECT_NEAR(bent[0][1].x(), 0, 0.06);  // on the ridge: the mean of both sides
  EXPECT_NEAR(split[0][1].x(), unit_normal(roof, TriId(0)).x(), 1e-14);  // unless they differ in kind
}

TEST(NodeNormals, EqualCornersKeepTheirBitsOthersAreAveragedByArea) {
  const TriMesh cube = box({0, 0, 0}, {1, 2, 4});
  std::vector<std::array<Vec3, 3>> radial(12);
  const Vec3 center(0.5, 1, 2);
  for (std::size_t t = 0; t < 12; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      radial[t][k] = (cube.positions[cube.corners[TriId(t)][k]] - center).normalized();
  const auto same = node_normals(cube, {}, radial);
  const auto mean = node_normals(cube, {}, corner_normals(cube, {}));
  for (std::size_t n = 0; n < 8; ++n) {
    const Vec3 out = cube.positions[NodeId(n)] - center;
    EXPECT_EQ(same[NodeId(n)], Vec3(out.normalized()));
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < 12; ++t)
      for (const NodeId c : cube.corners[TriId(t)])
        if (c == NodeId(n)) sum += area_vector(cube, TriId(t));
    EXPECT_NEAR((mean[NodeId(n)] - sum.normalized()).norm(), 0, 1e-15);
  }
}

TEST(NodeNormals, OriginalFacesCountAloneWhereANodeHasAny) {
  TriMesh flat = sheet(2, 0);
  std::vector<std::array<Vec3, 3>> normal;
  std::vector<FaceKind> kind;
  for (std::size_t t = 0; t < flat.triangle_count(); ++t) {
    kind.push_back(t < 4 ? FaceKind::original : FaceKind::fracture);  // the lower half of the square
    normal.emplace_back().fill(t < 4 ? Vec3::UnitX() : Vec3::UnitY());
  }
  flat.positions.add({9, 9, 9});  // of no triangle
  const auto found = node_normals(flat, kind, normal);
  for (std::size_t n = 0; n < 9; ++n)
    EXPECT_EQ(found[NodeId(n)], flat.positions[NodeId(n)].y() < 0.1 ? Vec3::UnitX() : Vec3::UnitY());
  EXPECT_EQ(found[NodeId(9)], Vec3::UnitZ());

  normal[1].fill(Vec3::Zero());  // corners without a normal do not count
  EXPECT_EQ(node_normals(flat, kind, normal)[NodeId(0)], Vec3::UnitX());
  normal[1].fill(-Vec3::UnitX());  // opposite faces of one size: one of the two, not a direction of round-off
  EXPECT_EQ(node_normals(flat, kind, normal)[NodeId(0)], Vec3::UnitX());
}

TEST(FragmentPly, KeepsNodesKindsAndSources) {
  const TemporaryFolder folder;
  const Fragment lower = broken_cube(0.1)[0];
  write_fragment_ply(folder / "f.ply", lower);
  const PlyMesh back = read_ply(folder / "f.ply");
  EXPECT_EQ(back.mesh.positions, lower.mesh.positions);
  EXPECT_EQ(back.mesh.corners, lower.mesh.corners);
  ASSERT_EQ(back.kind.size(), lower.face_kind.size());
  ASSERT_EQ(back.source.size(), lower.source.size());
  for (std::size_t t = 0; t < back.kind.size(); ++t) {
    EXPECT_EQ(back.kind[t], static_cast<int>(lower.face_kind[t]));
    EXPECT_EQ(back.source[t], lower.source[t].value);
  }
  EXPECT_NEAR(enclosed_volume(back.mesh), 0.6, 1e-15);
}

TEST(FragmentsGlb, FollowsTheSpecification) {
  const TemporaryFolder folder;
  const auto pieces = broken_cube(0.1);
  write_fragments_glb(folder / "f.glb", pieces);
  const Glb glb = opened(file_content(folder / "f.glb"));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  ASSERT_EQ(glb.json["nodes"].size(), 3u);
  EXPECT_EQ(glb.json["nodes"][0]["children"], Json({1, 2}));
  ASSERT_EQ(glb.json["materials"].size(), 2u);
  EXPECT_EQ(glb.json["materials"][1]["name"], "fracture");
  for (std::size_t f = 0; f < 2; ++f) {
    const Json& node = glb.json["nodes"][f + 1];
    EXPECT_DOUBLE_EQ(node["extras"]["mass"].get<double>(), pieces[f].mass);
    EXPECT_NEAR(node["translation"][2].get<double>(), pieces[f].center_of_mass.z(), 1e-7);
    const Json& primitives = glb.json["meshes"][node["mesh"].get<std::size_t>()]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    EXPECT_EQ(primitives[0]["material"], 0);
    expect_valid_primitive(glb, primitives[0], 10);
    expect_valid_primitive(glb, primitives[1], 2);
    // A box face has its own four vertices: five grey faces, one warm one.
    EXPECT_EQ(glb.json["accessors"][primitives[0]["attributes"]["POSITION"].get<std::size_t>()]["count"], 20);
    EXPECT_EQ(glb.json["accessors"][primitives[1]["attributes"]["POSITION"].get<std::size_t>()]["count"], 4);
  }
}

TEST(FragmentsGlb, UncutBodyHasOneMaterialInUse) {
  const TemporaryFolder folder;
  std::vector<Fragment> pieces{broken_cube(0.5)[0]};
  pieces[0].face_kind.assign(12, FaceKind::original);
  write_fragments_glb(folder / "f.glb", pieces);
  const Glb glb = opened(file_content(folder / "f.glb"));
  ASSERT_EQ(glb.json["meshes"].size(), 1u);
  EXPECT_EQ(glb.json["meshes"][0]["primitives"].size(), 1u);
}

TEST(FragmentObj, TwoGroupsAndAMaterialFile) {
  const TemporaryFolder folder;
  write_fragment_obj(folder / "f.obj", broken_cube(0.1)[1]);
  const std::string obj = file_content(folder / "f.obj"), mtl = file_content(folder / "f.mtl");
  EXPECT_NE(obj.find("mtllib f.mtl"), std::string::npos);
  for (const char* name : {"original", "fracture"}) {
    EXPECT_NE(obj.find(std::string("usemtl ") + name), std::string::npos);
    EXPECT_NE(mtl.find(std::string("newmtl ") + name), std::string::npos);
  }
}

TEST(FragmentObj, ReadsBackWithEveryValueOfEveryCorner) {
  const TemporaryFolder folder;
  const Fragment piece = painted_cube(0.1)[0];
  write_fragment_obj(folder / "f.obj", piece);
  const auto [mesh, a] = read_surface(folder / "f.obj");
  EXPECT_EQ(mesh.positions, piece.mesh.positions);
  EXPECT_EQ(a.materials, (std::vector<std::string>{"wood", "steel", "fracture"}));
  ASSERT_EQ(mesh.triangle_count(), 12u);
  // faces are grouped by material: look each one up by its corners
  for (std::size_t t = 0; t < 12; ++t) {
    const auto same = std::find(piece.mesh.corners.begin(), piece.mesh.corners.end(), mesh.corners[TriId(t)]);
    ASSERT_NE(same, piece.mesh.corners.end());
    const auto from = static_cast<std::size_t>(same - piece.mesh.corners.begin());
    EXPECT_EQ(a.material[t], piece.attributes.material[from]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR((a.uv[t][k] - piece.attributes.uv[from][k]).norm(), 0, 1e-7);
      EXPECT_NEAR((a.normal[t][k] - piece.attributes.normal[from][k]).norm(), 0, 1e-7);
    }
  }
}

TEST(FragmentPly, MaterialsAndTextureCoordinatesReadBack) {
  const TemporaryFolder folder;
  const Fragment piece = painted_cube(0.1)[0];
  write_fragment_ply(folder / "f.ply", piece);
  const auto [mesh, a] = read_surface(folder / "f.ply");
  EXPECT_EQ(mesh.corners, piece.mesh.corners);
  for (std::size_t t = 0; t < 12; ++t) {
    EXPECT_EQ(a.materials[static_cast<std::size_t>(a.material[t])],
              "material_" + std::to_string(piece.attributes.material[t]));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR((a.uv[t][k] - piece.attributes.uv[t][k]).norm(), 0, 1e-7);
  }
}

// One normal per node, and no node twice: the file as it stands is closed.
TEST(FragmentPly, NodesAreSharedAndHaveOutwardUnitNormals) {
  const TemporaryFolder folder;
  for (const Fragment& piece : painted_cube(0.1)) {
    write_fragment_ply(folder / "f.ply", piece);
    std::string bytes = file_content(folder / "f.ply");
    const std::string list = "float normals\n";
    bytes.replace(bytes.find(list), list.size(), "float unknown\n");  // only the nodes' are left
    std::ofstream(folder / "nodes.ply", std::ios::binary) << bytes;
    const auto [mesh, a] = read_surface(folder / "nodes.ply");
    EXPECT_EQ(mesh.positions, piece.mesh.positions);
    ASSERT_EQ(a.normal.size(), 12u);
    const auto wanted = node_normals(piece.mesh, piece.face_kind, piece.attributes.normal);
    for (std::size_t t = 0; t < 12; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR((a.normal[t][k] - wanted[mesh.corners[TriId(t)][k]]).norm(), 0, 1e-7);
        EXPECT_NEAR(a.normal[t][k].norm(), 1, 1e-6);
        if (piece.face_kind[t] == FaceKind::original) {
          EXPECT_GT(a.normal[t][k].dot(unit_normal(mesh, TriId(t))), 0.1);
        }
      }
  }
}

// A piece that is broken again keeps its sharp edges: read back, each corner has its own normal.
TEST(FragmentPly, NormalsOfCornersReadBack) {
  const TemporaryFolder folder;
  for (const Fragment& piece : painted_cube(0.1)) {
    write_fragment_ply(folder / "f.ply", piece);
    const auto [mesh, a] = read_surface(folder / "f.ply");
    ASSERT_EQ(a.normal.size(), 12u);
    for (std::size_t t = 0; t < 12; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR((a.normal[t][k] - piece.attributes.normal[t][k]).norm(), 0, 1e-7);
        EXPECT_NEAR((a.normal[t][k] - unit_normal(mesh, TriId(t))).norm(), 0, 1e-7);
      }
  }
}

TEST(FragmentsGlb, EveryMaterialIsAPrimitiveWithTextureCoordinates) {
  const TemporaryFolder folder;
  const auto pieces = painted_cube(0.1);
  write_fragments_glb(folder / "f.glb", pieces);
  const Glb glb = opened(file_content(folder / "f.glb"));
  ASSERT_EQ(glb.json["materials"].size(), 3u);
  EXPECT_EQ(glb.json["materials"][2]["name"], "fracture");
  std::size_t corners = 0;
  for (const Json& mesh : glb.json["meshes"])
    for (const Json& primitive : mesh["primitives"]) {
      const Json& uv = glb.json["accessors"][primitive["attributes"]["TEXCOORD_0"].get<std::size_t>()];
      EXPECT_EQ(uv["type"], "VEC2");
      EXPECT_EQ(accessed(glb, uv, 8).size(), 8 * uv["count"].get<std::size_t>());
      const Json& index = glb.json["accessors"][primitive["indices"].get<std::size_t>()];
      expect_valid_primitive(glb, primitive, index["count"].get<std::size_t>() / 3);
      corners += index["count"].get<std::size_t>();
    }
  EXPECT_EQ(corners, 2u * 36u);
}

TEST(FragmentsGlb, ContactsAreInTheExtras) {
  const TemporaryFolder folder;
  const auto pieces = broken_cube(0.1);
  write_fragments_glb(folder / "f.glb", pieces, {{0, 1, 1.0}});
  const Glb glb = opened(file_content(folder / "f.glb"));
  EXPECT_EQ(glb.json["nodes"][1]["extras"]["contacts"], Json::parse(R"([{"fragment":1,"area":1.0}])"));
  EXPECT_EQ(glb.json["nodes"][2]["extras"]["contacts"], Json::parse(R"([{"fragment":0,"area":1.0}])"));
}

TEST(FragmentFormats, AreNamed) {
  const FragmentFormats some = formats_from_names({"glb", "stl"}, "--format");
  EXPECT_TRUE(some.glb && some.stl);
  EXPECT_FALSE(some.ply || some.obj);
  EXPECT_TRUE(formats_from_names({"hulls"}, "").hulls && formats_from_names({"vdb"}, "").vdb);
  EXPECT_THROW(formats_from_names({"fbx"}, "scene.toml:3"), InputError);
}

#ifdef CONCHOID_HAVE_ASSIMP
namespace {

struct Counts {
  std::size_t faces = 0, places = 0;
  double volume = 0;
  std::set<std::string> materials;
  std::size_t with_uv = 0;  ///< faces with texture coordinates
};

/// What an independent reader finds: triangles, different vertex places, enclosed volume.
Counts counted(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_PreTransformVertices);
  if (!scene) ADD_FAILURE() << importer.GetErrorString();
  Counts counts;
  if (!scene) return counts;
  std::set<std::array<float, 3>> places;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    counts.faces += mesh.mNumFaces;
    if (mesh.HasTextureCoords(0)) counts.with_uv += mesh.mNumFaces;
    counts.materials.insert(scene->mMaterials[mesh.mMaterialIndex]->GetName().C_Str());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      places.insert({mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z});
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      Vec3 x[3];
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& p = mesh.mVertices[mesh.mFaces[f].mIndices[k]];
        x[k] = {p.x, p.y, p.z};
      }
      counts.volume += x[0].dot(cross(x[1], x[2])) / 6;
    }
  }
  counts.places = places.size();
  return counts;
}

}  // namespace

TEST(FragmentFiles, AnotherReaderFindsTheSamePieces) {
  const TemporaryFolder folder;
  const auto pieces = painted_cube(0.1);
  write_fragment_ply(folder / "f.ply", pieces[0]);
  write_fragment_obj(folder / "f.obj", pieces[0]);
  write_fragments_glb(folder / "f.glb", {pieces[0]});
  write_mesh(folder / "f.stl", pieces[0].mesh);
  for (const char* name : {"f.ply", "f.obj", "f.glb", "f.stl"}) {
    const Counts counts = counted(folder / name);
    EXPECT_EQ(counts.faces, 12u) << name;
    EXPECT_EQ(counts.places, 8u) << name;
    EXPECT_NEAR(counts.volume, 0.6, 1e-6) << name;
  }
  for (const char* name : {"f.obj", "f.glb"}) {
    const Counts counts = counted(folder / name);
    EXPECT_EQ(counts.materials, (std::set<std::string>{"wood", "steel", "fracture"})) << name;
    EXPECT_EQ(counts.with_uv, 12u) << name;
  }
}

TEST(FragmentFiles, AnotherReaderFindsTheNormalsOfThePly) {
  const TemporaryFolder folder;
  for (const Fragment& piece : painted_cube(0.1)) {
    write_fragment_ply(folder / "f.ply", piece);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder / "f.ply").string(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, 1u);
    const aiMesh& mesh = *scene->mMeshes[0];
    ASSERT_TRUE(mesh.HasNormals());
    ASSERT_EQ(mesh.mNumFaces, 12u);
    const auto normal = node_normals(piece.mesh, piece.face_kind, piece.attributes.normal);
    for (unsigned t = 0; t < 12; ++t)
      for (unsigned k = 0; k < 3; ++k) {
        const NodeId node = piece.mesh.corners[TriId(std::size_t(t))][k];
        const unsigned v = mesh.mFaces[t].mIndices[k];
        const aiVector3D &x = mesh.mVertices[v], &n = mesh.mNormals[v];
        EXPECT_NEAR((Vec3(x.x, x.y, x.z) - piece.mesh.positions[node]).norm(), 0, 1e-7);
        EXPECT_NEAR((Vec3(n.x, n.y, n.z) - normal[node]).norm(), 0, 1e-6);
      }
  }
}

TEST(FragmentFiles, AnotherReaderFindsAHullPerPiece) {
  const TemporaryFolder folder;
  write_hulls_obj(folder / "hulls.obj", broken_cube(0.1));
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder / "hulls.obj").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mRootNode->mNumChildren, 2u);
  EXPECT_STREQ(scene->mRootNode->mChildren[1]->mName.C_Str(), "fragment_001");
  EXPECT_NEAR(counted(folder / "hulls.obj").volume, 1.0, 1e-6);  // boxes are their own hulls
}
#endif
