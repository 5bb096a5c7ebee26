#include "conchoid/mesh/surface_attributes.hpp"

#include <algorithm>

namespace conchoid {
namespace {

template <class T>
T& grown(std::vector<T>& list, std::size_t i, const T& fill) {
  if (list.size() <= i) list.resize(i + 1, fill);
  return list[i];
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

void AttributeCollector::use_material(const std::string& name) {
  current_ = name.empty() ? "unnamed" : name;
  named_ = true;
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
  if (!named_) return;
  auto known = std::find(out_.materials.begin(), out_.materials.end(), current_);
  if (known == out_.materials.end()) {
    out_.materials.push_back(current_);
    known = out_.materials.end() - 1;
  }
  grown(out_.material, triangle, -1) = static_cast<int>(known - out_.materials.begin());
}

SurfaceAttributes AttributeCollector::finish(std::size_t triangles) {
  if (!out_.normal.empty()) out_.normal.resize(triangles, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  if (!out_.uv.empty()) out_.uv.resize(triangles, {Vec2::Zero(), Vec2::Zero(), Vec2::Zero()});
  if (!out_.material.empty()) {
    out_.material.resize(triangles, -1);
    if (std::find(out_.material.begin(), out_.material.end(), -1) != out_.material.end()) {
      std::replace(out_.material.begin(), out_.material.end(), -1, static_cast<int>(out_.materials.size()));
      out_.materials.push_back("default");
    }
  }
  return std::move(out_);
}

}  // namespace conchoid
