#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/formats/mesh_text.hpp"

namespace conchoid::ply {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(Scalar type);

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> list_count;  ///< type of the length of a list; a single value otherwise
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

/// Reads the lines up to `end_header`. Throws InputError with the line.
/// @param file_size  no element can be more often there than the file has bytes
Header read_header(TextScanner& scan, const std::string& file, std::size_t file_size);

/// Throws InputError unless the vertices have x, y and z and the faces or strips a list of vertices.
void require_surface(const Header& header, const std::string& file);
const Element& element_named(const Header& header, std::string_view name, const std::string& file);
/// Whether its items are strips of triangles, in the places of faces.
bool holds_strips(const Element& element);
/// Whether `first` comes before `second` in the body.
bool comes_before(const Header& header, std::string_view first, std::string_view second);
/// Whether this is the list of the vertices of a face.
bool holds_corners(const Property& property);

}  // namespace conchoid::ply
