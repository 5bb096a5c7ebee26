#include "conchoid/mesh/models.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/circle_points.hpp"
#include "conchoid/mesh/place.hpp"

namespace conchoid {
namespace {

/// In-plane coordinates (p, q) on the side of a box across `axis`, so that (p, q, axis) is right-handed.
Vec3 on_side(int axis, double height, double p, double q) {
  Vec3 x;
  x[axis] = height;
  x[(axis + 1) % 3] = p;
  x[(axis + 2) % 3] = q;
  return x;
}

/// 20 triangles of one quarter-symmetric face: five in the quadrant p, q > 0, mirrored into the others.
void add_cube_face(TriMesh& mesh, NodeWelder& node, int axis, double height) {
  constexpr double third = 1.0 / 6.0, inner = 0.27;
  for (int sp : {1, -1})
    for (int sq : {1, -1}) {
      auto corner = [&](double p, double q) { return node(on_side(axis, height, sp * p, sq * q)); };
      const bool outward = (height > 0) == (sp * sq > 0);
      auto add = [&](NodeId a, NodeId b, NodeId c) {
        mesh.corners.push_back(outward ? std::array{a, b, c} : std::array{a, c, b});
      };
      const NodeId center = corner(0, 0), right = corner(inner, 0), up = corner(0, inner);
      const NodeId edge_q = corner(0.5, third), edge_p = corner(third, 0.5);
      add(center, right, up);
      add(up, right, edge_p);
      add(right, edge_q, edge_p);
      add(edge_q, corner(0.5, 0.5), edge_p);
      // The two triangles on the middles of the sides lie in two quadrants: each is made once, by the
      // positive one.
      auto mirrored_p = [&](double p, double q) { return node(on_side(axis, height, -sp * p, sq * q)); };
      auto mirrored_q = [&](double p, double q) { return node(on_side(axis, height, sp * p, -sq * q)); };
      if (sp > 0) add(up, edge_p, mirrored_p(third, 0.5));
      if (sq > 0) add(right, mirrored_q(0.5, third), edge_q);
    }
}

BodyModel cube() {
  BodyModel model;
  NodeWelder node(model.mesh);
  for (int axis = 0; axis < 3; ++axis)
    for (double height : {-0.5, 0.5})
      add_cube_face(model.mesh, node, axis, height);
  model.regions = box_regions(model.mesh);
  return model;
}

/// 16 nodes around, five levels of which every second is turned by half a step.
void add_cylinder_side(TriMesh& mesh, NodeWelder& node) {
  constexpr int around = 16, rows = 4;
  auto at = [&](int j, int level) {
    const Vec2 p = ellipse_point(2 * j + level % 2, 2 * around, 0.5, 0.5);
    return node({p.x(), p.y(), static_cast<double>(2 * level - rows) / (2 * rows)});
  };
  for (int row = 0; row < rows; ++row)
    for (int j = 0; j < around; ++j) {
      if (row % 2 == 0) {
        mesh.corners.push_back({at(j, row), at(j + 1, row), at(j, row + 1)});
        mesh.corners.push_back({at(j, row + 1), at(j + 1, row), at(j + 1, row + 1)});
      } else {
        mesh.corners.push_back({at(j, row), at(j + 1, row), at(j + 1, row + 1)});
        mesh.corners.push_back({at(j, row), at(j + 1, row + 1), at(j, row + 1)});
      }
    }
}

/// Rings of 16, 8 and 1 nodes.
void add_cylinder_cap(TriMesh& mesh, NodeWelder& node, double height) {
  auto at = [&](double radius, int j) {
    const Vec2 p = ellipse_point(j, 16, radius, radius);
    return node({p.x(), p.y(), height});
  };
  auto add = [&](NodeId a, NodeId b, NodeId c) {
    mesh.corners.push_back(height > 0 ? std::array{a, b, c} : std::array{a, c, b});
  };
  for (int j = 0; j < 16; j += 2) {
    const NodeId inner = at(0.25, j), next = at(0.25, j + 2);
    add(node({0, 0, height}), inner, next);
    add(inner, at(0.5, j), at(0.5, j + 1));
    add(inner, at(0.5, j + 1), next);
    add(next, at(0.5, j + 1), at(0.5, j + 2));
  }
}

std::vector<TriId> triangles_between(std::size_t first, std::size_t end) {
  std::vector<TriId> ids;
  for (std::size_t t = first; t < end; ++t)
    ids.push_back(TriId(t));
  return ids;
}

BodyModel cylinder() {
  BodyModel model;
  NodeWelder node(model.mesh);
  add_cylinder_cap(model.mesh, node, 0.5);
  const std::size_t top_end = model.mesh.triangle_count();
  add_cylinder_cap(model.mesh, node, -0.5);
  const std::size_t bottom_end = model.mesh.triangle_count();
  add_cylinder_side(model.mesh, node);
  model.regions = {{"top", triangles_between(0, top_end)},
                   {"bottom", triangles_between(top_end, bottom_end)},
                   {"side", triangles_between(bottom_end, model.mesh.triangle_count())}};
  return model;
}

constexpr double bar_length = 0.2, bar_width = 0.04, bar_height = 0.05;
constexpr int bar_columns = 16;

/// Moves the nodes of a regular box so that the middle of its bottom becomes a V-notch; the top stays as it
/// is.
Vec3 notched(const Vec3& x) {
  constexpr double half_mouth = 0.007, depth = 0.01, cell = bar_length / bar_columns;
  const double toward_bottom = 0.5 - x.z() / bar_height;
  const double distance = std::abs(x.x());
  double bottom_distance =
      half_mouth + (distance - cell) * (0.5 * bar_length - half_mouth) / (0.5 * bar_length - cell);
  Vec3 moved = x;
  if (distance < 0.5 * cell) {
    bottom_distance = 0;
    moved.z() += toward_bottom * depth;
  }
  const double new_distance = toward_bottom * bottom_distance + (1 - toward_bottom) * distance;
  moved.x() = distance == 0.5 * bar_length ? x.x() : std::copysign(new_distance, x.x());
  return moved;
}

BodyModel bar() {
  BodyModel model;
  model.mesh = box_mesh({bar_length, bar_width, bar_height}, bar_columns, 2, 4);
  const std::vector<Region> sides = box_regions(model.mesh);
  const std::vector<std::string> names = {
      "support-left", "support-right", "load", "notch", "bottom", "top", "x-", "x+", "y-", "y+"};
  for (const std::string& name : names)
    model.regions.push_back({name, {}});
  auto add = [&](const std::string& name, TriId t) {
    for (Region& region : model.regions)
      if (region.name == name) region.triangles.push_back(t);
  };
  auto column = [&](TriId t) {
    return static_cast<int>(std::floor((centroid(model.mesh, t).x() / bar_length + 0.5) * bar_columns));
  };
  auto in_the_middle = [&](TriId t) {
    return column(t) == bar_columns / 2 - 1 || column(t) == bar_columns / 2;
  };
  for (const Region& side : sides)
    for (TriId t : side.triangles) {
      if (side.name == "z-")
        add(column(t) == 1                 ? "support-left"
            : column(t) == bar_columns - 2 ? "support-right"
            : in_the_middle(t)             ? "notch"
                                           : "bottom",
            t);
      else if (side.name == "z+")
        add(in_the_middle(t) ? "load" : "top", t);
      else
        add(side.name, t);
    }
  for (Vec3& x : model.mesh.positions)
    x = notched(x);
  return model;
}

/// Rectangle in z = 0 whose rows of nodes are turned by half a step in turn, so that every edge of its front
/// (x = front) has its opposite node straight behind its middle.
TriMesh staggered_sheet(double mouth, double front, double width, int rows, int columns) {
  TriMesh sheet;
  NodeWelder node(sheet);
  auto across = [&](int half_steps) { return width * (half_steps - columns) / (2.0 * columns); };
  auto at = [&](int row, int half_steps) {
    return node({front + (mouth - front) * row / rows, across(half_steps), 0.0});
  };
  for (int row = 0; row < rows; ++row) {
    const int plain = row % 2 == 0 ? row : row + 1;      // nodes at 0, 2, 4 …
    const int staggered = row % 2 == 0 ? row + 1 : row;  // nodes at 0, 1, 3, 5 …, 2·columns
    auto add = [&](NodeId a, NodeId b, NodeId c) {  // a, b ascending in y on the plain or the staggered row
      sheet.corners.push_back({a, b, c});
    };
    const bool plain_ahead =
        plain < staggered;  // rows count away from the front: the plain row has the larger x
    for (int j = 0; j < columns; ++j) {
      const NodeId a = at(plain, 2 * j), b = at(plain, 2 * j + 2), c = at(staggered, 2 * j + 1);
      plain_ahead ? add(a, b, c) : add(b, a, c);
    }
    for (int j = 0; j <= columns; ++j) {
      const NodeId a = at(staggered, std::max(2 * j - 1, 0));
      const NodeId b = at(staggered, std::min(2 * j + 1, 2 * columns)), c = at(plain, 2 * j);
      plain_ahead ? add(b, a, c) : add(a, b, c);
    }
  }
  return sheet;
}

BodyModel edge_crack_cube() {
  BodyModel model;
  model.mesh = box_mesh(Vec3::Ones(), 4, 4, 4);
  model.regions = box_regions(model.mesh);
  model.crack = staggered_sheet(-0.5, -0.5 + 0.3, 1.0, 4, 14);
  return model;
}

}  // namespace

const std::vector<std::string>& built_in_model_names() {
  static const std::vector<std::string> names = {"cube", "cylinder", "bar", "edge-crack-cube", "infinite"};
  return names;
}

BodyModel built_in_model(const std::string& name) {
  if (name == "cube") return cube();
  if (name == "cylinder") return cylinder();
  if (name == "bar") return bar();
  if (name == "edge-crack-cube") return edge_crack_cube();
  if (name == "infinite") return {};
  throw InputError("there is no built-in model '" + name +
                   "'; use one of cube, cylinder, bar, edge-crack-cube, infinite, or give a mesh file");
}

}  // namespace conchoid
