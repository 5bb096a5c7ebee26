#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "oracle.hpp"

/// Pairs of panels, by the case they belong to; every case is checked at three tolerances against the slow
/// integrals.
namespace conchoid::oracle {

struct NamedPair {
  std::string name;
  Panel x, y;
};

inline const Triangle base = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 0.8, 0)};

inline std::vector<NamedPair> common_edge_pairs() {
  std::vector<NamedPair> pairs;
  const auto add = [&](const std::string& name, double degrees, double height_y, double height_x) {
    const double angle = degrees * std::numbers::pi / 180;
    const Triangle x = {base[0], base[1], Vec3(0.3, height_x, 0)};
    const Triangle y = {base[1], base[0], Vec3(0.6, height_y * std::cos(angle), height_y * std::sin(angle))};
    pairs.push_back({name, panel(x, 0, 1, 2), panel(y, 1, 0, 3)});
  };
  add("flat", 180, 0.7, 0.8);
  add("right angle", 90, 0.7, 0.8);
  add("folded to 10 degrees", 10, 0.7, 0.8);
  add("folded to 0.1 degrees", 0.1, 0.7, 0.8);
  add("folded flat", 0, 0.7, 0.8);
  add("one slim", 120, 0.02, 0.8);
  add("both slim", 60, 0.02, 0.02);
  add("slim, folded to 1 degree", 1, 0.02, 0.8);
  return pairs;
}

inline std::vector<NamedPair> common_vertex_pairs() {
  std::vector<NamedPair> pairs;
  const auto add = [&](const std::string& name, const Vec3& b1, const Vec3& b2) {
    pairs.push_back({name, panel(base, 0, 1, 2), panel({b2, Vec3::Zero(), b1}, 5, 0, 4)});
  };
  add("flat, opposite", {-1, 0, 0}, {-0.3, -0.8, 0});
  add("in space", {-1, 0.2, 0.5}, {-0.3, 0.8, 0.4});
  add("slim, nearly along an edge", {1, -0.01, 0.001}, {1, -0.03, 0.01});
  add("crossing", {0.8, 0.3, 0.5}, {0.7, 0.5, -0.6});
  add("overlapping in the plane", {0.8, 0.3, 0}, {-0.7, 0.5, 0});
  add("folded to 1 degree", {0.9, 0.2, 0.005}, {0.2, 0.6, 0.012});
  return pairs;
}

inline std::vector<NamedPair> near_pairs() {
  std::vector<NamedPair> pairs;
  const auto add = [&](const std::string& name, const Triangle& y) {
    pairs.push_back({name, panel(base, 0, 1, 2), panel(y, 7, 8, 9)});
  };
  const auto above = [](double gap) {
    return Triangle{Vec3(0.1, -0.2, gap), Vec3(0.9, 0.1, gap), Vec3(0.2, 0.6, gap)};
  };
  add("hanging along part of an edge", {Vec3(0.2, 0, 0), Vec3(0.6, -0.5, 0.3), Vec3(0.7, 0, 0)});
  add("hanging, in the plane", {Vec3(0.2, 0, 0), Vec3(0.6, -0.5, 0), Vec3(0.7, 0, 0)});
  add("crossing", {Vec3(0.2, 0.2, -0.5), Vec3(0.6, 0.1, 0.5), Vec3(0.4, 0.7, 0.4)});
  add("crossing, slim", {Vec3(0.2, 0.2, -0.5), Vec3(0.2, 0.22, 0.5), Vec3(0.21, 0.2, 0.9)});
  add("corner in the face", {Vec3(0.4, 0.3, 0), Vec3(0.9, 0.2, 0.5), Vec3(0.3, 0.9, 0.7)});
  add("overlapping in the plane", above(0));
  add("parallel, gap 0.1", above(0.1));
  add("parallel, gap 1e-2", above(1e-2));
  add("parallel, gap 1e-4", above(1e-4));
  add("parallel, gap 1e-6", above(1e-6));
  Triangle tilted = above(1e-3);
  tilted[1].z() += 1e-5;
  add("gap 1e-3, tilted a little", tilted);
  tilted[1].z() += 1e-2;
  add("gap 1e-3, tilted more", tilted);
  add("nearly flat on the face, touching with a corner",
      {Vec3(0.2, 0.2, 0), Vec3(0.7, 0.1, 1e-6), Vec3(0.3, 0.5, 1e-6)});
  add("nearly flat, touching with a corner, tilted",
      {Vec3(0.2, 0.2, 0), Vec3(0.7, 0.1, 1e-3), Vec3(0.3, 0.5, 3e-4)});
  add("wedge above a corner", {Vec3(0.9, 0.1, 1e-6), Vec3(1.5, 0.2, 0.4), Vec3(1.2, 0.9, 0.3)});
  add("half an edge away", {Vec3(0.2, 0.2, 0.5), Vec3(0.6, 0.1, 0.5), Vec3(0.4, 0.7, 0.7)});
  add("small beside large", {Vec3(0.5, 0.2, 0.01), Vec3(0.51, 0.2, 0.012), Vec3(0.505, 0.21, 0.02)});
  return pairs;
}

inline std::vector<NamedPair> far_pairs() {
  std::vector<NamedPair> pairs;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (double distance : {2.2, 3.0, 5.0, 20.0}) {
    for (double slimness : {1.0, 0.05}) {
      const auto triangle = [&](const Vec3& at) {
        const Vec3 a(u(random), u(random), u(random)), b(u(random), u(random), u(random));
        const Vec3 p = a.normalized(), q = (b - b.dot(p) * p).normalized();
        return Triangle{at - 0.5 * p, at + 0.5 * p, at + 0.8 * slimness * q};
      };
      const Vec3 direction = Vec3(u(random), u(random), u(random)).normalized();
      pairs.push_back({"at " + std::to_string(distance) + (slimness < 1 ? ", slim" : ""),
                       panel(triangle(Vec3::Zero()), 0, 1, 2),
                       panel(triangle(distance * direction), 3, 4, 5)});
    }
  }
  return pairs;
}

}  // namespace conchoid::oracle
