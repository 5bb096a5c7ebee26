#include "conchoid/sim/output_spec.hpp"

#include "conchoid/sim/toml_table.hpp"

namespace conchoid {

OutputSpec read_output(const TomlTable& file) {
  OutputSpec output;
  const auto table = file.table("output");
  if (!table) return output;
  table->require_known_keys();
  output.where = table->where();
  table->read("formats", output.formats);
  std::string projection = "box";
  table->read("projection", projection);
  output.projection = projection == "planar" ? Projection::planar : Projection::box;
  if (double size = 0; table->has("texture_size")) {
    table->read("texture_size", size);
    output.texture_size = size;
  }
  table->read("crease_angle", output.crease_angle);
  table->read("exaggeration", output.exaggeration);
  return output;
}

}  // namespace conchoid
