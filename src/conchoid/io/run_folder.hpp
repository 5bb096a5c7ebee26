#pragma once

#include <filesystem>
#include <vector>

#include "conchoid/io/fragments_io.hpp"
#include "conchoid/io/run_document.hpp"
#include "conchoid/io/vtk.hpp"

namespace conchoid {

/// One frame for ParaView: the body's surface and the BEM crack mesh with what was computed on them. Empty
/// lists are left out.
struct FrameData {
  double time = 0;                         ///< [s]
  TriMesh body;                            ///< without triangles for the infinite body
  IdVector<NodeId, Vec3> displacement;     ///< per body node [m]
  IdVector<TriId, Vec3> traction;          ///< per body triangle [Pa]
  IdVector<TriId, Vec3> principal_stress;  ///< per body triangle, largest first [Pa]
  IdVector<TriId, Mat3> stress;            ///< per body triangle [Pa]
  TriMesh crack;
  IdVector<NodeId, Vec3> opening;    ///< per crack node, world axes [m]
  IdVector<NodeId, Vec3> intensity;  ///< per crack node: K_I, K_II, K_III [Pa √m], zero off the front
  /// Above 0, for display: the body's nodes are moved by so many times their displacement, and the crack
  /// becomes two faces, moved apart by so many times the opening.
  double exaggeration = 0;
};

/// A front node in a frame: one line of front.csv.
struct FrontRow {
  int frame = 0;
  int front = 0;                  ///< number of the front within the frame
  int node = 0;                   ///< number of the node within the BEM crack mesh
  Vec3 position = Vec3::Zero();   ///< [m]
  Vec3 intensity = Vec3::Zero();  ///< K_I, K_II, K_III [Pa √m]
  Vec3 opening = Vec3::Zero();    ///< Δu at the correlation node in the front frame: I, II, III [m]
  double speed = 0;               ///< [m/s], 0: arrested
  double kink_angle = 0;          ///< from e2 towards e1 [rad]
};

void write_front_csv(const std::filesystem::path& path, const std::vector<FrontRow>& rows);
/// Reads front.csv (columns by name, others ignored). Throws InputError with the line.
std::vector<FrontRow> read_front_csv(const std::filesystem::path& path);

/// Writer of a run folder: frames/frame_0001.vtu … + run.pvd, front.csv, crack.ply, the pieces in the formats
/// asked for (fragments/fragment_000.ply, .obj + .mtl, .stl; fragments.glb, fragments.vdb, hulls.obj),
/// run.json. Every file appears complete or not at all; run.json comes last and makes the folder a finished
/// run.
class RunFolder {
 public:
  /// Creates the folder if need be. One that holds an earlier run (run.json or run.pvd) is emptied of that
  /// run's files; any other folder with something in it, and one that cannot be written, is an InputError.
  explicit RunFolder(const std::filesystem::path& path);

  void write_frame(int frame, const FrameData& data);
  void write_front_csv(const std::vector<FrontRow>& rows);
  /// The fine crack surface, trimmed to the body. @param frame  per triangle: frame in which it appeared; may
  /// be empty
  void write_crack(const TriMesh& crack, const std::vector<int>& frame = {});
  /// @param contacts  for the glTF file; voxel  of level sets [m]
  void write_fragments(const std::vector<Fragment>& fragments, const FragmentFormats& formats = {},
                       const std::vector<FragmentContact>& contacts = {}, double voxel = 0);
  void write_run_json(const RunDocument& document);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::vector<PvdEntry> frames_;
};

/// What a finished run left, as `compare` and the pictures need it.
struct RunData {
  RunDocument document;
  TriMesh crack;  ///< fine crack surface, trimmed to the body
  std::vector<FrontRow> front;
  std::vector<Fragment> fragments;  ///< largest first, as written; empty unless the run wrote them as PLY
};

/// Reads a run folder. Throws InputError (file and remedy) for a folder that is foreign, unfinished or
/// damaged.
RunData read_run(const std::filesystem::path& path);

}  // namespace conchoid
