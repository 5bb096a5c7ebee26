#include "conchoid/io/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "conchoid/core/parallel.hpp"
#include "conchoid/io/panel_labels.hpp"
#include "conchoid/io/ray_scene.hpp"
#include "conchoid/surface/corner_normals.hpp"

namespace conchoid {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_view_angle = 0.13;  // of the camera: long lens, little perspective [rad]
constexpr double ray_offset = 2e-4;       // start of secondary rays off the surface, scene of unit radius
constexpr int sky_rays = 2;               // per camera ray

using Light = Vec3;  // linear red, green, blue

Light light_of(const Color& c) {
  return {to_linear(c.r), to_linear(c.g), to_linear(c.b)};
}

struct Camera {
  Vec3 right, up, back, eye;
  double half_width = 1, half_height = 1;  // of the image plane at distance 1
  Vec2 shift = Vec2::Zero();               // of the image plane, so that the subject sits in the middle

  Vec3 direction(double sx, double sy) const {  // sx, sy in −1…1
    return ((shift.x() + sx * half_width) * right + (shift.y() + sy * half_height) * up - back).normalized();
  }
};

/// Box of everything a set of panels shows.
struct Extent {
  std::vector<Vec3> points;  // [m]
  Vec3 center = Vec3::Zero();
  double radius = 1;

  void add(const PictureMesh& m) {
    IdVector<NodeId, char> used(m.mesh.node_count(), 0);
    for (const auto& corners : m.mesh.corners)
      for (NodeId c : corners)
        used[c] = 1;
    for (std::size_t n = 0; n < m.mesh.node_count(); ++n)
      if (used[NodeId(n)]) points.push_back(m.mesh.positions[NodeId(n)] + m.offset);
  }
  void add(const PicturePanel& panel) {
    for (const PictureMesh& mesh : panel.meshes)
      add(mesh);
  }
  void finish() {
    if (points.empty()) return;
    Box box{points[0], points[0]};
    for (const Vec3& x : points)
      box = {box.low.cwiseMin(x), box.high.cwiseMax(x)};
    center = box.center();
    if (box.diagonal() > 0) radius = 0.5 * box.diagonal();
  }
};

/// Looks at the points from the given side, just far enough away to see them all, with them in the middle of
/// the image.
/// @param margin  shares of the image's height kept free at the top and at the bottom
Camera fitted_camera(const Extent& extent, const PictureSettings& s, double aspect, const Vec2& margin) {
  Camera camera;
  camera.back = s.from.normalized();
  camera.right = cross(s.up, camera.back);
  if (camera.right.norm() < 1e-6 * s.up.norm())
    camera.right = cross(Vec3(s.up.y(), s.up.z(), s.up.x()), camera.back);
  camera.right.normalize();
  camera.up = cross(camera.back, camera.right);
  const double slope = std::tan(half_view_angle);
  camera.half_width = aspect >= 1 ? slope * aspect : slope;
  camera.half_height = camera.half_width / aspect;
  constexpr double fill_width = 0.88;
  const double fill_height = 1 - margin[0] - margin[1];
  double distance = 1.2;
  for (int round = 0; round < 40; ++round) {
    Vec2 low = Vec2::Constant(1e30), high = -low;
    for (const Vec3& point : extent.points) {
      const Vec3 x = (point - extent.center) / extent.radius;
      const double depth = distance - x.dot(camera.back);
      const Vec2 p(x.dot(camera.right) / depth, x.dot(camera.up) / depth);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    if (extent.points.empty()) break;
    camera.shift = 0.5 * (low + high) + Vec2(0, (margin[0] - margin[1]) * camera.half_height);
    const Vec2 half = 0.5 * (high - low);
    const double excess =
        std::max(half.x() / (fill_width * camera.half_width), half.y() / (fill_height * camera.half_height));
    distance = std::max(distance * (1 + 0.9 * (excess - 1)), 1.05);
  }
  camera.eye = distance * camera.back;
  return camera;
}

/// Fixed numbers in [0, 1) that look random: the sample pattern, the same in every run.
double noise(std::uint32_t x, std::uint32_t y, std::uint32_t k) {
  std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ k * 0xcb1ab31fu;
  h = (h ^ h >> 16) * 0x7feb352du;
  h = (h ^ h >> 15) * 0x846ca68bu;
  h ^= h >> 16;
  return h * (1.0 / 4294967296.0);
}

double fraction(double x) {
  return x - std::floor(x);
}

/// Direction of the cosine-weighted hemisphere around n.
Vec3 hemisphere(const Vec3& n, double u, double v) {
  const Vec3 helper = std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 a = cross(n, helper).normalized(), b = cross(n, a);
  const double r = std::sqrt(u);
  return r * std::cos(2 * pi * v) * a + r * std::sin(2 * pi * v) * b + std::sqrt(std::max(0.0, 1 - u)) * n;
}

/// One view being rendered: scene, camera and the range of the colour map.
class View {
 public:
  /// @param extent  what the camera sees; own  what stands on this panel's floor
  View(const PicturePanel& panel, const Extent& extent, const Extent& own, const PictureSettings& settings,
       double aspect, const Vec2& margin, const Vec2& range)
      : panel_(panel),
        settings_(settings),
        scene_(panel.meshes, extent.center, extent.radius),
        camera_(fitted_camera(extent, settings, aspect, margin)),
        up_(settings.up.normalized()),
        range_(range) {
    for (const PictureMesh& m : panel.meshes)
      normals_.push_back(corner_normals(m.mesh, m.face_kind));
    floor_ = own.points.empty() ? -1.0 : 1e30;
    for (const Vec3& point : own.points)
      floor_ = std::min(floor_, (point - extent.center).dot(up_) / extent.radius - 2e-3);
    key_ = (-0.42 * camera_.right + 0.90 * up_ + 0.62 * camera_.back).normalized();
    fill_ = (0.9 * camera_.right + 0.25 * up_ + 0.5 * camera_.back).normalized();
  }

  void render(Image& image, int x0, int y0, int width, int height) const {
    parallel_for(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row)
        for (int column = 0; column < width; ++column)
          image.set(x0 + column, y0 + static_cast<int>(row),
                    pixel(column, static_cast<int>(row), width, height));
    });
  }

 private:
  /// Numbers of one camera ray for choosing the directions of its secondary rays.
  struct Sampler {
    double shift_u, shift_v;
    int index, count;

    Vec2 next(int k) const {  // k-th of sky_rays, spread over all camera rays of the pixel (R2 sequence,
                              // shifted per pixel)
      const double i = index * sky_rays + k;
      return {fraction(shift_u + 0.7548776662466927 * i), fraction(shift_v + 0.5698402909980532 * i)};
    }
  };

  Color pixel(int px, int py, int width, int height) const {
    const int n = settings_.samples;
    Light sum = Light::Zero();
    const auto ux = static_cast<std::uint32_t>(px), uy = static_cast<std::uint32_t>(py);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double sx = 2 * (px + (i + 0.5) / n) / width - 1, sy = 1 - 2 * (py + (j + 0.5) / n) / height;
        const Sampler sampler{noise(ux, uy, 1), noise(ux, uy, 2), j * n + i, n * n};
        const Light light = trace(camera_.direction(sx, sy), sx, sy, 1.0 / width, sampler);
        sum += light.cwiseMin(1.0);
      }
    sum /= n * n;
    return {from_linear(static_cast<float>(sum[0])), from_linear(static_cast<float>(sum[1])),
            from_linear(static_cast<float>(sum[2]))};
  }

  Light trace(const Vec3& direction, double sx, double sy, double pixel_size, const Sampler& sampler) const {
    Light light = Light::Zero();
    double transparency = 1, start = 0;
    for (int layer = 0; layer < 16; ++layer) {
      const auto hit = scene_.first_hit(camera_.eye, direction, start, 1e6, false);
      if (!hit) break;
      const PictureMesh& mesh = panel_.meshes[hit->mesh];
      const Vec3 point = camera_.eye + hit->distance * direction;
      const double width = pixel_size * hit->distance * 2 * camera_.half_width;
      if (mesh.opacity >= 1) return light + transparency * shaded(*hit, point, direction, width, sampler);
      const double alpha = ghost_opacity(*hit, direction, width);
      light += transparency * alpha * light_of(original_color) * 0.75;
      transparency *= 1 - alpha;
      start = hit->distance + ray_offset;
    }
    return light + transparency * background(direction, sx, sy, sampler);
  }

  Vec3 corner(const SurfacePoint& hit, std::size_t k) const {
    return scene_.position(hit.mesh, panel_.meshes[hit.mesh].mesh.corners[hit.triangle][k]);
  }

  /// Shading normal on the side of the eye.
  Vec3 normal(const SurfacePoint& hit, const Vec3& direction) const {
    const PictureMesh& mesh = panel_.meshes[hit.mesh];
    const Vec3 flat = unit_normal(mesh.mesh, hit.triangle);
    const double side = flat.dot(direction) > 0 ? -1.0 : 1.0;
    if (mesh.flat) return side * flat;
    Vec3 n = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      n += hit.barycentric[static_cast<Eigen::Index>(k)] * normals_[hit.mesh][hit.triangle.index()][k];
    return n.squaredNorm() > 0 ? Vec3(side * n.normalized()) : Vec3(side * flat);
  }

  Light albedo(const SurfacePoint& hit) const {
    const PictureMesh& mesh = panel_.meshes[hit.mesh];
    if (!mesh.node_value.empty()) {
      double value = 0;
      for (std::size_t k = 0; k < 3; ++k)
        value += hit.barycentric[static_cast<Eigen::Index>(k)] *
                 mesh.node_value[mesh.mesh.corners[hit.triangle][k].index()];
      const double span = range_[1] - range_[0];
      return light_of(scalar_color(span > 0 ? (value - range_[0]) / span : 0.5));
    }
    return light_of(
        color_of(mesh.face_kind.empty() ? FaceKind::original : mesh.face_kind[hit.triangle.index()]));
  }

  /// 1 on an edge of the triangle, 0 a pixel or more away from it.
  double edge_coverage(const SurfacePoint& hit, double width) const {
    const Vec3 a = corner(hit, 0), b = corner(hit, 1), c = corner(hit, 2);
    const double area2 = area_vector2(a, b, c).norm();
    const Vec3 edge((c - b).norm(), (a - c).norm(), (b - a).norm());
    double nearest = 1e30;
    for (int k = 0; k < 3; ++k)
      if (edge[k] > 0) nearest = std::min(nearest, hit.barycentric[k] * area2 / edge[k]);
    return std::clamp(1.1 - nearest / width, 0.0, 1.0);
  }

  /// Ghosts are clear face on and denser where they curve away; their edges, if drawn, show faintly.
  double ghost_opacity(const SurfacePoint& hit, const Vec3& direction, double width) const {
    const PictureMesh& mesh = panel_.meshes[hit.mesh];
    const double facing = std::abs(normal(hit, direction).dot(direction));
    const double alpha = mesh.opacity * (0.55 + 0.9 * std::pow(1 - facing, 2));
    return std::clamp(alpha + (mesh.edges ? 0.25 * edge_coverage(hit, width) : 0.0), 0.0, 1.0);
  }

  Light shaded(const SurfacePoint& hit, const Vec3& point, const Vec3& direction, double width,
               const Sampler& sampler) const {
    const PictureMesh& mesh = panel_.meshes[hit.mesh];
    const Vec3 n = normal(hit, direction);
    Light color = albedo(hit);
    if (mesh.edges) color *= 1 - 0.55 * edge_coverage(hit, width);
    const Vec3 start = point + ray_offset * (n - direction);
    const Vec3 half = (key_ - direction).normalized();
    const double shine = 0.05 * std::pow(std::max(0.0, half.dot(n)), 24);
    const double lit = std::max(0.0, n.dot(key_)) > 0 ? key_visible(start, sampler) : 0.0;
    const Light key = 0.66 * lit * std::max(0.0, n.dot(key_)) * Light(1.0, 0.97, 0.92);
    const Light fill = 0.12 * std::max(0.0, n.dot(fill_)) * Light(0.92, 0.96, 1.0);
    return color.cwiseProduct(key + fill + sky(start, n, sampler)) + Light::Constant(shine * lit);
  }

  /// Is the key light seen? It is a disc, so shadows have soft rims.
  double key_visible(const Vec3& start, const Sampler& sampler) const {
    const Vec2 u = sampler.next(0);
    const Vec3 toward = (key_ + 0.10 * (hemisphere(key_, u.x(), u.y()) - key_)).normalized();
    return scene_.blocked(start, toward) ? 0.0 : 1.0;
  }

  /// Light of the sky and of what stands around: rays that meet something bring back a part of its colour.
  Light sky(const Vec3& start, const Vec3& n, const Sampler& sampler) const {
    Light sum = Light::Zero();
    for (int k = 0; k < sky_rays; ++k) {
      const Vec2 u = sampler.next(k);
      const Vec3 d = hemisphere(n, u.x(), u.y());
      const auto hit = scene_.first_hit(start, d, 0, 2.5, true);
      const double height = d.dot(up_);
      if (hit) {
        sum += 0.42 * albedo(*hit);
      } else {
        sum += height > 0 ? Light(0.50, 0.51, 0.53) * (0.75 + 0.35 * height) : Light(0.33, 0.325, 0.32);
      }
    }
    return sum / sky_rays;
  }

  Light background(const Vec3& direction, double sx, double sy, const Sampler& sampler) const {
    const Light wall = light_of({0.955f, 0.96f, 0.965f}) * (0.93 + 0.07 * sy);
    const double sink = direction.dot(up_);
    if (!settings_.floor || sink >= -1e-3) return wall;
    const double s = (floor_ - camera_.eye.dot(up_)) / sink;
    const Vec3 point = camera_.eye + s * direction;
    const double away = (point - up_ * point.dot(up_)).norm();
    // Shadows fade with the distance and towards the sides, where the next panel begins.
    const double near =
        std::clamp(1 - (away - 1.2) / 2.0, 0.0, 1.0) * std::clamp((1 - std::abs(sx)) / 0.2, 0.0, 1.0);
    if (near == 0) return wall;
    double open = 0;
    for (int k = 0; k < sky_rays; ++k) {
      const Vec2 u = sampler.next(k);
      open += scene_.blocked(point, hemisphere(up_, u.x(), u.y())) ? 0.0 : 1.0 / sky_rays;
    }
    const double dark = 0.50 * (1 - open) + 0.28 * (1 - key_visible(point, sampler));
    return wall * (1 - near * dark);
  }

  const PicturePanel& panel_;
  const PictureSettings& settings_;
  RayScene scene_;
  Camera camera_;
  std::vector<std::vector<std::array<Vec3, 3>>> normals_;
  Vec3 up_, key_, fill_;
  double floor_ = 0;
  Vec2 range_;
};

}  // namespace

Image render_picture(const std::vector<PicturePanel>& panels, const PictureSettings& settings) {
  Image image(settings.width, settings.height);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{250});
  Extent common;
  for (const PicturePanel& panel : panels)
    common.add(panel);
  common.finish();

  const int count = static_cast<int>(panels.size());
  const int columns = settings.columns > 0 ? std::min(settings.columns, count) : count;
  const int rows = columns > 0 ? (count + columns - 1) / columns : 0;
  const double height = static_cast<double>(settings.height) / std::max(rows, 1);
  const double size =
      std::clamp(height / (rows > 1 ? 30.0 : 45.0), 7.0, 40.0);  // cap height of titles [pixel]
  Vec2 margin(0.04, 0.04);
  for (const PicturePanel& panel : panels)
    margin = margin.cwiseMax(label_room(panel, size) / height);
  for (int p = 0; p < count; ++p) {
    const PicturePanel& panel = panels[static_cast<std::size_t>(p)];
    const int column = p % columns, row = p / columns;
    const PixelArea area = {settings.width * column / columns, settings.height * row / rows,
                            settings.width * (column + 1) / columns, settings.height * (row + 1) / rows};
    const double aspect = static_cast<double>(settings.width) / columns / height;
    Extent own;
    own.add(panel);
    own.finish();
    const Vec2 range = value_range(panels, panel.value_name);
    View(panel, settings.same_view ? common : own, own, settings, aspect, margin, range)
        .render(image, area.left, area.top, area.right - area.left, area.bottom - area.top);
    draw_labels(image, panel, area, range, size);
  }
  return image;
}

void write_picture(const std::filesystem::path& path, const std::vector<PicturePanel>& panels,
                   const PictureSettings& settings) {
  write_png(path, render_picture(panels, settings));
}

namespace {

/// Away from what a chip came off: against the area vectors of its fracture faces.
Vec3 way_out(const Fragment& chip) {
  Vec3 into = Vec3::Zero();
  for (std::size_t t = 0; t < chip.mesh.triangle_count(); ++t)
    if (chip.face_kind[t] == FaceKind::fracture) into += area_vector(chip.mesh, TriId(t));
  if (!(into.norm() > 0)) return Vec3::Zero();
  const Vec3 out = -into.normalized();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : chip.mesh.positions) {
    low = std::min(low, out.dot(x));
    high = std::max(high, out.dot(x));
  }
  return (high - low) * out;
}

}  // namespace

std::vector<PictureMesh> exploded(const std::vector<Fragment>& fragments, double factor) {
  Vec3 center = Vec3::Zero();
  double mass = 0, largest = 0;
  for (const Fragment& f : fragments) {
    largest = std::max(largest, f.volume);
    center += f.mass * f.center_of_mass;
    mass += f.mass;
  }
  if (mass > 0) center /= mass;
  std::vector<PictureMesh> meshes;
  for (const Fragment& f : fragments) {
    PictureMesh m;
    m.mesh = f.mesh;
    m.face_kind = f.face_kind;
    m.offset = factor * (f.center_of_mass - center);
    constexpr double chip = 0.1, extents = 4;
    if (f.volume < chip * largest) m.offset += extents * factor * way_out(f);
    meshes.push_back(std::move(m));
  }
  return meshes;
}

std::vector<PictureMesh> crack_in_body(const TriMesh& body, const TriMesh& crack) {
  std::vector<PictureMesh> meshes(2);
  meshes[0].mesh = crack;
  meshes[0].face_kind.assign(crack.triangle_count(), FaceKind::fracture);
  meshes[1].mesh = body;
  meshes[1].opacity = 0.3;
  return meshes;
}

}  // namespace conchoid
