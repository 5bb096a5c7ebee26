#include "conchoid/sim/kept_surface.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "conchoid/core/bytes.hpp"
#include "conchoid/remesh/remesh.hpp"

namespace conchoid {
namespace {

void put(ByteWriter& out, const TriMesh& mesh) {
  out.put(static_cast<std::uint64_t>(mesh.node_count()));
  for (const Vec3& x : mesh.positions)
    out.put_all(std::span<const double>(x.data(), 3));
  out.put(static_cast<std::uint64_t>(mesh.triangle_count()));
  for (const auto& c : mesh.corners)
    for (const NodeId n : c)
      out.put(n.value);
}

TriMesh mesh_of(std::string_view bytes) {
  ByteReader in(bytes);
  TriMesh mesh;
  for (auto n = in.get<std::uint64_t>(); n > 0; --n) {
    const auto x = in.get_all<double>(3);
    mesh.positions.emplace_back(x[0], x[1], x[2]);
  }
  for (auto n = in.get<std::uint64_t>(); n > 0; --n) {
    const auto c = in.get_all<std::int32_t>(3);
    mesh.corners.push_back({NodeId(c[0]), NodeId(c[1]), NodeId(c[2])});
  }
  return mesh;
}

}  // namespace

AttributedMesh kept_welded_if_it_helps(AttributedMesh surface, WeldReport& report, const ByteCache* cache) {
  if (!cache) return welded_if_it_helps(std::move(surface), report);
  ByteWriter all;
  put(all, surface.mesh);
  const std::string name = cache_name("sound", all.bytes());
  if (cache->recall(name)) {
    report = {};
    report.bounds_body = true;
    return surface;
  }
  surface = welded_if_it_helps(std::move(surface), report);
  if (report.bounds_body && report.nodes == 0) cache->keep(name, {});
  return surface;
}

TriMesh kept_remesh(const TriMesh& surface, int triangles, const RemeshSettings& settings,
                    const ByteCache* cache) {
  if (!cache || !settings.limits.empty()) return remesh(surface, triangles, settings);
  ByteWriter all;
  put(all, surface);
  all.put(triangles);
  all.put(settings.follow_thickness);
  const std::string name = cache_name("remesh", all.bytes());
  if (const std::optional<KeptBytes> kept = cache->recall(name)) return mesh_of(kept->bytes);
  TriMesh out = remesh(surface, triangles, settings);
  ByteWriter bytes;
  put(bytes, out);
  cache->keep(name, bytes.bytes());
  return out;
}

}  // namespace conchoid
