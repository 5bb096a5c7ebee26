#include "conchoid/io/run_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "conchoid/core/error.hpp"
#include "conchoid/core/numbers.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

constexpr double ghost_opacity = 0.22;
constexpr std::size_t most_rows = 20000;  // of front.csv that colours are taken from

std::string counted(std::size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

std::string run_caption(const RunDocument& d) {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f s", d.total_seconds);
  return std::string(name(d.stop)) + " after " + counted(static_cast<std::size_t>(d.frames), "frame") + ", " +
         counted(d.fragments.size(), "piece") + ", " + seconds;
}

PictureMesh broken(const TriMesh& mesh) {
  PictureMesh out;
  out.mesh = mesh;
  out.face_kind.assign(mesh.triangle_count(), FaceKind::fracture);
  return out;
}

PictureMesh ghost(const TriMesh& mesh) {
  PictureMesh out;
  out.mesh = mesh;
  out.opacity = ghost_opacity;
  return out;
}

/// The body as the pieces show it, put together.
std::vector<PictureMesh> ghosts(const RunData& run) {
  std::vector<PictureMesh> out;
  for (const Fragment& f : run.fragments) {
    TriMesh skin;
    skin.positions = f.mesh.positions;
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
      if (f.face_kind[t] == FaceKind::original) skin.corners.push_back(f.mesh.corners[TriId(t)]);
    out.push_back(ghost(skin));
  }
  return out;
}

/// Where a front breaks through the last ligament, K grows without bounds: the colour map ends at five times
/// the median, so that it still tells the rest apart. Whether anything was cut off.
bool cut_off_largest(std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::erase_if(sorted, [](double v) { return !std::isfinite(v); });
  if (sorted.empty()) return false;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double limit = 5 * *middle;
  bool cut = false;
  for (double& v : values)
    if (v > limit) {
      v = limit;
      cut = true;
    }
  return cut;
}

/// |K| [MPa √m] at the places of the front up to a frame.
struct FrontValues {
  std::vector<Vec3> place;
  std::vector<double> value;

  FrontValues(const std::vector<FrontRow>& rows, int last_frame) {
    const std::size_t step = 1 + rows.size() / most_rows;
    for (std::size_t i = 0; i < rows.size(); i += step)
      if (rows[i].frame <= last_frame) {
        place.push_back(rows[i].position);
        value.push_back(rows[i].intensity.norm() / 1e6);
      }
  }

  /// Mean of the nearest places, weighted by distance.
  double at(const Vec3& x) const {
    constexpr std::size_t wanted = 4;
    std::array<std::pair<double, std::size_t>, wanted> nearest;
    std::size_t found = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
      const double d = (place[i] - x).squaredNorm();
      if (found == wanted && !(d < nearest.back().first)) continue;
      std::size_t k = found < wanted ? found++ : wanted - 1;
      for (; k > 0 && d < nearest[k - 1].first; --k)
        nearest[k] = nearest[k - 1];
      nearest[k] = {d, i};
    }
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < found; ++k) {
      if (!(nearest[k].first > 0)) return value[nearest[k].second];
      sum += value[nearest[k].second] / nearest[k].first;
      weights += 1 / nearest[k].first;
    }
    return weights > 0 ? sum / weights : 0;
  }
};

std::string colour_by_intensity(PictureMesh& mesh, const std::vector<FrontRow>& rows, int last_frame) {
  const FrontValues front(rows, last_frame);
  mesh.node_value.assign(mesh.mesh.node_count(), 0);
  parallel_for(mesh.mesh.node_count(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      mesh.node_value[n] = front.at(mesh.mesh.positions[NodeId(n)]);
  });
  return cut_off_largest(mesh.node_value) ? "|K| [MPa√m], largest cut off" : "|K| [MPa√m]";
}

constexpr const char* opening_name = "opening [μm]";

fs::path frame_file(const fs::path& folder, int frame) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%04d.vtu", frame);
  return folder / "frames" / name;
}

/// Body and crack of one frame.
struct Frame {
  TriMesh body, crack;
  std::vector<Vec3> opening;  ///< per crack node

  /// A piece that has come off may be anywhere: its opening says nothing. It is beyond a fifth of what the
  /// frame shows.
  bool in_one_piece() const {
    double largest = 0;
    for (const Vec3& u : opening)
      largest = std::max(largest, u.norm());
    return largest <= 0.2 * std::max(bounding_box(body).diagonal(), bounding_box(crack).diagonal());
  }
};

TriMesh part_of(const TriMesh& mesh, const VtkField& part, double wanted, std::vector<std::size_t>& nodes) {
  TriMesh out;
  std::vector<NodeId> moved(mesh.node_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (part.values[t] != wanted) continue;
    std::array<NodeId, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId from = mesh.corners[TriId(t)][k];
      NodeId& to = moved[from.index()];
      if (!to.valid()) {
        to = out.positions.add(mesh.positions[from]);
        nodes.push_back(from.index());
      }
      corners[k] = to;
    }
    out.corners.push_back(corners);
  }
  return out;
}

Frame read_frame(const fs::path& file) {
  const VtuMesh vtu = read_vtu(file);
  const VtkField* part = find_field(vtu.triangle_fields, "part");
  const VtkField* opening = find_field(vtu.node_fields, "opening");
  if (!part) throw InputError(file.string() + ": does not tell body and crack apart; make the run again");
  Frame out;
  std::vector<std::size_t> body_nodes, crack_nodes;
  out.body = part_of(vtu.mesh, *part, 0, body_nodes);
  out.crack = part_of(vtu.mesh, *part, 1, crack_nodes);
  for (const std::size_t n : crack_nodes)
    out.opening.push_back(
        opening ? Vec3(opening->values[3 * n], opening->values[3 * n + 1], opening->values[3 * n + 2])
                : Vec3(Vec3::Zero()));
  return out;
}

/// The crack coloured by its opening, as one sheet or as two faces apart.
std::vector<PictureMesh> opened(const Frame& frame, double exaggerate) {
  PictureMesh face = broken(frame.crack);
  if (!frame.in_one_piece()) return {face};
  for (const Vec3& u : frame.opening)
    face.node_value.push_back(1e6 * u.norm());
  if (!(exaggerate > 0)) return {face};
  std::vector<PictureMesh> faces{face, face};
  for (std::size_t n = 0; n < frame.opening.size(); ++n) {
    faces[0].mesh.positions[NodeId(n)] += 0.5 * exaggerate * frame.opening[n];
    faces[1].mesh.positions[NodeId(n)] -= 0.5 * exaggerate * frame.opening[n];
  }
  return faces;
}

std::vector<int> frames_of(const fs::path& folder) {
  std::vector<int> frames;
  for (int frame = 0; frame < 100000; ++frame)
    if (fs::exists(frame_file(folder, frame)))
      frames.push_back(frame);
    else if (frame > 0)
      break;
  if (frames.empty())
    throw InputError((folder / "frames").string() +
                     ": holds no frames; pictures of the opening need a run with some");
  return frames;
}

/// The last frame before anything has come off.
Frame last_in_one_piece(const fs::path& folder) {
  const std::vector<int> frames = frames_of(folder);
  for (std::size_t i = frames.size(); i-- > 1;)
    if (Frame frame = read_frame(frame_file(folder, frames[i])); frame.in_one_piece()) return frame;
  return read_frame(frame_file(folder, frames.front()));
}

}  // namespace

Vec3 usual_up(const RunDocument& run) {
  constexpr double clearly = 1.2;
  if (!run.body) return Vec3::UnitZ();
  const Vec3 extent = run.body->high - run.body->low;
  return extent.y() > clearly * std::max(extent.x(), extent.z()) ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
}

RunView run_view_from_name(const std::string& name) {
  if (name == "pieces") return RunView::pieces;
  if (name == "crack") return RunView::crack;
  if (name == "K") return RunView::intensity;
  if (name == "opening") return RunView::opening;
  throw InputError("'" + name + "' cannot be shown; choose pieces, crack, K or opening");
}

PicturePanel run_panel(const RunData& run, const fs::path& folder, const RunPictureSettings& settings) {
  PicturePanel panel;
  panel.title = run.document.method;
  panel.caption = run_caption(run.document);
  switch (settings.view) {
    case RunView::pieces:
      if (run.fragments.size() > 1)
        panel.meshes = exploded(run.fragments, settings.explode);
      else
        panel.meshes =
            crack_in_body(run.fragments.empty() ? TriMesh() : run.fragments.front().mesh, run.crack);
      break;
    case RunView::crack:
      panel.meshes = {broken(run.crack)};
      break;
    case RunView::intensity:
      panel.meshes = ghosts(run);
      panel.meshes.push_back(broken(run.crack));
      panel.value_name = colour_by_intensity(panel.meshes.back(), run.front, run.document.frames);
      break;
    case RunView::opening: {
      const Frame frame = last_in_one_piece(folder);
      panel.meshes = opened(frame, settings.exaggerate);
      panel.meshes.push_back(ghost(frame.body));
      panel.value_name = opening_name;
      break;
    }
  }
  return panel;
}

std::vector<PicturePanel> frame_panels(const RunData& run, const fs::path& folder, int count,
                                       const RunPictureSettings& settings) {
  const std::vector<int> frames = frames_of(folder);
  const std::size_t shown = std::min(frames.size(), static_cast<std::size_t>(std::max(count, 1)));
  std::vector<PicturePanel> panels;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t which = shown == 1 ? frames.size() - 1 : i * (frames.size() - 1) / (shown - 1);
    const Frame frame = read_frame(frame_file(folder, frames[which]));
    PicturePanel panel;
    panel.title = "frame " + std::to_string(frames[which]);
    panel.legend = i == 0;
    if (settings.view == RunView::intensity) {
      panel.meshes = {broken(frame.crack)};
      colour_by_intensity(panel.meshes[0], run.front, frames[which]);
      panel.value_name = "|K| [MPa√m]";
    } else {
      panel.meshes = opened(frame, settings.exaggerate);
      panel.value_name = opening_name;
    }
    panel.meshes.push_back(ghost(frame.body));
    panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace conchoid
