#include "conchoid/mesh/surface_attributes.hpp"

#include <algorithm>

namespace conchoid {
namespace {

template <class T>
T& grown(std::vector<T>& list, std::size_t i, const T& fill) {
  if (list.size() <= i) list.resize(i + 1, fill);
  return list[i];
}

/// The triangle has the name `current`.
void add_named(std::size_t triangle, const std::string& current, std::vector<int>& of_triangle,
               std::vector<std::string>& names) {
  if (current.empty()) return;
  auto known = std::find(names.begin(), names.end(), current);
  if (known == names.end()) {
    names.push_back(current);
    known = names.end() - 1;
  }
  grown(of_triangle, triangle, -1) = static_cast<int>(known - names.begin());
}

/// Triangles without a name get "default", if any has one.
void name_the_rest(std::size_t triangles, std::vector<int>& of_triangle, std::vector<std::string>& names) {
  if (of_triangle.empty()) return;
  of_triangle.resize(triangles, -1);
  if (std::find(of_triangle.begin(), of_triangle.end(), -1) == of_triangle.end()) return;
  std::replace(of_triangle.begin(), of_triangle.end(), -1, static_cast<int>(names.size()));
  names.push_back("default");
}

}  // namespace

Vec3 barycentric_weights(const Triangle& triangle, const Vec3& x) {
  for (int k = 0; k < 3; ++k)
    if (triangle[static_cast<std::size_t>(k)] == x) return Vec3::Unit(k);
  const Vec3 n = area_vector2(triangle[0], triangle[1], triangle[2]);
  Vec3 w;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = triangle[static_cast<std::size_t>((k + 1) % 3)],
               &q = triangle[static_cast<std::size_t>((k + 2) % 3)];
    w[k] = std::max(0.0, n.dot(area_vector2(x, p, q)));
  }
  const double sum = w.sum();
  return sum > 0 ? Vec3(w / sum) : Vec3(Vec3::Constant(1.0 / 3.0));
}

bool is_among(const std::string& names, const std::string& name) {
  return (' ' + names + ' ').find(' ' + name + ' ') != std::string::npos;
}

void AttributeCollector::use_material(const std::string& name) {
  material_ = name.empty() ? "unnamed" : name;
}

void AttributeCollector::use_groups(const std::string& names) {
  groups_ = names.empty() ? "default" : names;
}

void AttributeCollector::add_normal(std::size_t triangle, int corner, const Vec3& normal) {
  const double length = normal.norm();
  auto& corners = grown(out_.normal, triangle, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  if (length > 0) corners[static_cast<std::size_t>(corner)] = normal / length;
}

void AttributeCollector::add_uv(std::size_t triangle, int corner, const Vec2& uv) {
  grown(out_.uv, triangle, {Vec2::Zero(), Vec2::Zero(), Vec2::Zero()})[static_cast<std::size_t>(corner)] = uv;
}

void AttributeCollector::add_triangle(std::size_t triangle) {
  add_named(triangle, material_, out_.material, out_.materials);
  add_named(triangle, groups_, out_.group, out_.groups);
}

SurfaceAttributes AttributeCollector::finish(std::size_t triangles) {
  if (!out_.normal.empty()) out_.normal.resize(triangles, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  if (!out_.uv.empty()) out_.uv.resize(triangles, {Vec2::Zero(), Vec2::Zero(), Vec2::Zero()});
  name_the_rest(triangles, out_.material, out_.materials);
  name_the_rest(triangles, out_.group, out_.groups);
  return std::move(out_);
}

}  // namespace conchoid
