#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conchoid/io/image.hpp"
#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// One mesh in a picture.
struct PictureMesh {
  TriMesh mesh;                     ///< [m]
  std::vector<FaceKind> face_kind;  ///< per triangle; empty: all original
  std::vector<double>
      node_value;  ///< per node: shown by a colour map with a legend instead of the face kinds; may be empty
  Vec3 offset = Vec3::Zero();  ///< moves the mesh [m]
  double opacity = 1;          ///< 0…1; below 1 the mesh is a ghost that throws no shadow
  bool edges = false;          ///< draw the edges of the triangles
  bool flat = false;           ///< shade every triangle by its own normal
};

/// The meshes of one picture, seen together under a title.
struct PicturePanel {
  std::vector<PictureMesh> meshes;
  std::string title;
  std::string caption;     ///< smaller, below
  std::string value_name;  ///< of the legend, e.g. "σ1 [MPa]"; panels with the same name share the range
  bool legend = true;      ///< false: another panel of the picture shows it
};

struct PictureSettings {
  int width = 1600, height = 900;  ///< [pixel]
  Vec3 from{0.62, -1.0, 0.52};     ///< direction from the scene to the eye
  Vec3 up{0, 0, 1};
  int samples =
      4;  ///< per pixel and direction: samples² rays into the scene, each with a few towards the light
  bool floor = true;      ///< the meshes stand on a floor that takes their shadow
  bool same_view = true;  ///< all panels through the same camera, so that sizes compare
  int columns = 0;        ///< panels per row; 0: all in one
};

/// Ray-traced picture: light from above, ambient occlusion, skin grey, fracture warm, panels side by side.
/// Lengths play no part: each view is fitted to what it shows. Same input, same bits, for every thread count.
Image render_picture(const std::vector<PicturePanel>& panels, const PictureSettings& settings = {});
/// Same, as a PNG file.
void write_picture(const std::filesystem::path& path, const std::vector<PicturePanel>& panels,
                   const PictureSettings& settings = {});

/// The fragments moved apart: each by `factor` times the way from the common centre of mass to its own; chips
/// (below a tenth of the largest volume) besides out of the notch they left, by 4 `factor` times their extent.
std::vector<PictureMesh> exploded(const std::vector<Fragment>& fragments, double factor);

/// The crack inside the body: the body as a ghost, the crack's faces in the colour of fracture.
std::vector<PictureMesh> crack_in_body(const TriMesh& body, const TriMesh& crack);

}  // namespace conchoid
