#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "conchoid/mesh/surface_attributes.hpp"

namespace conchoid {

// One reader and one writer per format (PLY: ply.hpp); `bytes` is the whole file, `file` its name for messages.

AttributedMesh read_obj(std::string_view bytes, const std::string& file);
TriMesh read_stl(std::string_view bytes, const std::string& file);
TriMesh read_off(std::string_view bytes, const std::string& file);
AttributedMesh read_glb(std::string_view bytes, const std::string& file);

void write_obj(std::ostream& out, const TriMesh& mesh);
void write_stl(std::ostream& out, const TriMesh& mesh);
void write_off(std::ostream& out, const TriMesh& mesh);

}  // namespace conchoid
