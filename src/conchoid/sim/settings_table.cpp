#include "conchoid/sim/settings.hpp"

#include "conchoid/material/library.hpp"
#include "conchoid/sim/world_bodies.hpp"

// The tables and keys there are. What is made of them is in settings.cpp.
namespace conchoid {
namespace {

SettingRange above(double low) {
  return {.low = low, .low_included = false};
}
SettingRange at_least(double low) {
  return {.low = low};
}
SettingRange between(double low, double high) {
  return {.low = low, .high = high};
}

std::vector<std::string_view> names_of(const std::vector<NamedMaterial>& materials) {
  std::vector<std::string_view> names;
  for (const NamedMaterial& m : materials)
    names.push_back(m.name);
  return names;
}

}  // namespace

const std::vector<SettingTable>& setting_tables() {
  static const std::vector<SettingTable> tables = {
      {"body", false, true, "What breaks: a built-in model or a mesh file, one of the two."},
      {"material", false, true, "Isotropic, linear elastic, brittle."},
      {"material.toughness_field", true, true,
       "How the toughness varies in the body: a factor on material.toughness. One table [material."
       "toughness_field], or several [[material.toughness_field]] whose factors multiply."},
      {"material.strength_field", true, true, "The same for material.strength.", "material.toughness_field"},
      {"resolution", false, true, "How fine the crack is."},
      {"region", true, true,
       "A named part of the surface: the triangles that fulfil all that it asks for. Where it asks for a "
       "place, all "
       "three vertices must lie there. A triangle belongs to the first region that wants it; the regions of "
       "a "
       "built-in model come after those given here."},
      {"boundary", true, true,
       "What acts on a region: one of traction, force (with or without a moment), pressure, displacement, "
       "fixed. "
       "Where nothing is said the surface is free."},
      {"body_force", false, true,
       "What acts on every part of the body. Pieces keep it; one that nothing holds falls without stress."},
      {"crack", true, true, "A crack that is there from the start."},
      {"remote_stress", false, true, "Stress at infinity, for model = \"infinite\"."},
      {"run", false, true, "How the simulation is run."},
      {"output", false, true, "What the pieces are written as, and how they look."},
      {"database", false, false,
       "How the loads of the runs are drawn: a traction on one region, and mostly its opposite on another."},
      {"world", false, false,
       "In place of a scene: body, supports, material, cracks and load of every run are drawn at random, "
       "from "
       "database.seed. Of [database] it takes runs, seed, frames, led_by, many_cracks and tiny_growth."},
  };
  return tables;
}

const std::vector<Setting>& settings() {
  using enum SettingType;
  static const std::vector<Setting> all = {
      {"body",
       "model",
       text,
       "",
       "",
       "built-in model",
       {},
       0,
       {"cube", "cylinder", "bar", "edge-crack-cube", "infinite"}},
      {"body", "mesh", file, "", "", "closed surface: .ply, .obj, .stl, .off or .glb, coordinates in m"},
      {"body", "remesh", integer, "triangles", "",
       "BEM triangles after remeshing; without it the mesh is used as it is", between(20, 200000)},
      {"body", "follow_thickness", boolean, "", "true",
       "with remesh: shorter edges on walls thinner than the triangles would be, so that these show the "
       "bending stress, as "
       "far as the number lasts; no effect where walls are stout"},
      {"body", "scale", number, "", "1.0",
       "factor on the body's coordinates; everything else in the scene stays as written", above(0)},

      {"material",
       "name",
       text,
       "",
       "",
       "a material of the library (docs/materials.md, conchoid materials): gives the first five constants "
       "below; those written beside it count instead",
       {},
       0,
       names_of(named_materials())},
      {"material", "youngs_modulus", number, "Pa", "", "Young's modulus E; required without a name",
       above(0)},
      {"material",
       "poisson_ratio",
       number,
       "",
       "",
       "Poisson's ratio ν; required without a name",
       {.low = -1, .high = 0.5, .low_included = false, .high_included = false}},
      {"material", "density", number, "kg/m³", "1200.0", "mass density ρ", above(0)},
      {"material", "strength", number, "Pa", "7.6e7",
       "tensile strength of the surface: cracks start above it", above(0)},
      {"material", "toughness", number, "Pa√m", "1.0e6", "fracture toughness K_c: cracks grow from it on",
       above(0)},
      {"material", "compressive_factor", number, "", "3.0",
       "compressive over tensile strength, for run.compression = \"published\"", at_least(1)},
      {"material.toughness_field",
       "kind",
       text,
       "",
       "\"homogeneous\"",
       "homogeneous: 1 everywhere. layers: 1 + a sin 2π(n·x/λ − phase). grains: Voronoi cells. noise: "
       "exp(a · fractal noise). vdb: voxels of a file",
       {},
       0,
       {"homogeneous", "layers", "grains", "noise", "vdb"}},
      {"material.toughness_field",
       "origin",
       numbers,
       "m",
       "",
       "where the field's origin lies, in the scene's coordinates; without it at the centre of the body's "
       "bounding box",
       {},
       3},
      {"material.toughness_field",
       "axes",
       vectors,
       "",
       "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
       "the field's three axes, at right angles, of any length: turns the field with the body",
       {},
       3},
      {"material.toughness_field",
       "direction",
       numbers,
       "",
       "[0.0, 0.0, 1.0]",
       "layers: n, across them, along the field's axes; of any length",
       {},
       3},
      {"material.toughness_field", "wavelength", number, "m", "",
       "layers, noise: λ, of noise that of the first octave; required", above(0)},
      {"material.toughness_field", "amplitude", number, "", "",
       "layers: a, below 1; noise: a, standard deviation of the factor's logarithm; required", at_least(0)},
      {"material.toughness_field", "phase", number, "wavelengths", "0.0",
       "layers: shift along the direction"},
      {"material.toughness_field", "octaves", integer, "octaves", "4",
       "noise: each has half the wavelength of the one before", between(1, 16)},
      {"material.toughness_field", "gain", number, "", "0.5",
       "noise: amplitude of an octave over that of the one before", above(0)},
      {"material.toughness_field", "size", number, "m", "",
       "grains: grain size, the cube root of the mean volume; required", above(0)},
      {"material.toughness_field", "stretch", numbers, "", "[1.0, 1.0, 1.0]",
       "grains: factors on the size along the field's axes", above(0), 3},
      {"material.toughness_field",
       "weakening",
       number,
       "",
       "0.5",
       "grains: the boundaries have this share less",
       {.low = 0, .high = 1, .high_included = false}},
      {"material.toughness_field", "width", number, "m", "",
       "grains: width of the weakened boundaries; without it size / 5, never below size / 50", above(0)},
      {"material.toughness_field",
       "spread",
       number,
       "",
       "0.0",
       "grains: each grain has its own factor, drawn evenly from 1 − spread … 1 + spread",
       {.low = 0, .high = 1, .high_included = false}},
      {"material.toughness_field", "seed", integer, "", "1", "grains, noise: another seed, another pattern",
       between(0, 9007199254740992.0)},
      {"material.toughness_field", "file", file, "", "",
       "vdb: OpenVDB file with positive factors, smoothed over a voxel; required"},
      {"material.toughness_field", "grid", text, "", "",
       "vdb: name of the grid; needed if the file has several"},
      {"material.toughness_field", "scale", number, "m", "1.0", "vdb: one unit of the grid's own coordinates",
       above(0)},
      {"material.toughness_field",
       "outside",
       text,
       "",
       "\"clamped\"",
       "vdb: beyond the box of active voxels the outermost go on, or the box repeats",
       {},
       0,
       {"clamped", "periodic"}},

      {"resolution", "crack", number, "m", "",
       "r̄, target edge of crack triangles; without it a tenth of the body's size (cube root of the volume) "
       "or, in "
       "the infinite body, an eighth of the largest crack; refused where a crack across the body would have "
       "more "
       "than 1e5 triangles",
       above(0)},
      {"resolution", "surface", number, "m", "",
       "spacing of the markers along the fine front, and with it the detail of the output surface; without "
       "it crack / 20; refused where a crack across the body would have more than 2e7 triangles",
       above(0)},

      {"region", "name", text, "", "", "required, unique"},
      {"region", "half_spaces", vectors, "m", "", "[[nx, ny, nz, d], …]: the points with n·x > d", {}, 4},
      {"region", "box", vectors, "m", "", "two opposite corners of a box along the scene's axes", {}, 3},
      {"region", "sphere", numbers, "m", "", "x, y, z of its centre, and its radius", {}, 4},
      {"region",
       "indenter",
       numbers,
       "m",
       "",
       "contact patch of a ball pressed on: x, y, z of its centre where it stands, and its radius; what is "
       "nearer to "
       "its surface than `within`, or inside it",
       {},
       4},
      {"region",
       "indenter_axis",
       numbers,
       "",
       "",
       "the indenter is a cylinder along this direction, endless",
       {},
       3},
      {"region", "within", number, "m", "", "distance from the indenter's surface; required with it",
       above(0)},
      {"region", "material", text, "", "",
       "a material that the mesh file gives triangles: usemtl of OBJ, materials of glTF; material_3 for the "
       "face property "
       "material_index (or material) = 3 of PLY"},
      {"region", "group", text, "", "", "a group that the mesh file gives triangles: g or o of OBJ"},
      {"region",
       "nearest",
       numbers,
       "m",
       "",
       "the one triangle that is nearest to this point, of those that fulfil the rest",
       {},
       3},
      {"region", "edge", number, "m", "",
       "with body.remesh: longest edge of the boundary elements there, whichever region has them", above(0)},
      {"region", "initiation", boolean, "", "true", "false: no crack starts there"},

      {"boundary", "region", text, "", "", "name of the region; required, at most one condition per region"},
      {"boundary", "traction", numbers, "Pa", "", "force per area", {}, 3},
      {"boundary", "force", numbers, "N", "", "total force, spread evenly over the region", {}, 3},
      {"boundary",
       "moment",
       numbers,
       "N m",
       "",
       "total moment about the centroid of the region, as tractions that grow with the distance from it "
       "(linear "
       "bending, twist) and have no resultant force; alone or with force",
       {},
       3},
      {"boundary", "pressure", number, "Pa", "", "along the inward normal; below 0 it pulls"},
      {"boundary",
       "displacement",
       components,
       "m",
       "",
       "prescribed displacement; in \"free\" components the load beside it acts (traction, force, moment or "
       "pressure), or none: [0.0, \"free\", \"free\"] is a roller, or a plane of symmetry",
       {},
       3},
      {"boundary", "fixed", boolean, "", "", "true: no displacement"},
      {"boundary",
       "axes",
       vectors,
       "",
       "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
       "the three directions, at right angles, of any length, along which the components of this table's "
       "vectors are meant",
       {},
       3},

      {"body_force",
       "gravity",
       numbers,
       "m/s²",
       "[0.0, 0.0, 0.0]",
       "acceleration: weight is this times material.density",
       {},
       3},
      {"body_force",
       "spin",
       numbers,
       "rad/s",
       "[0.0, 0.0, 0.0]",
       "steady rotation about an axis of this direction: centrifugal force",
       {},
       3},
      {"body_force",
       "axis_through",
       numbers,
       "m",
       "",
       "a point of that axis; without it the centre of mass",
       {},
       3},

      {"crack", "kind", text, "", "", "required", {}, 0, {"disc", "ellipse", "rectangle", "mesh"}},
      {"crack", "center", numbers, "m", "", "disc, ellipse, rectangle", {}, 3},
      {"crack", "normal", numbers, "", "", "disc, ellipse: normal, of any length", {}, 3},
      {"crack", "radius", number, "m", "", "disc", above(0)},
      {"crack", "axes", numbers, "m", "", "ellipse: semi-axes a, b", above(0), 2},
      {"crack",
       "direction",
       numbers,
       "",
       "",
       "ellipse: direction of a; disc: where the mesh begins; optional",
       {},
       3},
      {"crack", "edges", vectors, "m", "", "rectangle: its two full edge vectors", {}, 3},
      {"crack", "file", file, "", "",
       "mesh: open triangle mesh; edges inside the body are front, others mouth"},
      {"crack", "triangles", integer, "triangles", "",
       "wanted number of triangles; without it resolution.crack decides", between(4, 100000)},

      {"remote_stress", "tensor", numbers, "Pa", "", "xx, yy, zz, yz, xz, xy; required", {}, 6},

      {"run", "frames", integer, "frames", "30",
       "most frames to simulate; a front moves at most crack per frame", between(1, 100000)},
      {"run", "max_cracks", integer, "cracks", "1",
       "new cracks that may start in the whole run, on the surface or as branches on faces of cracks; 0: "
       "only the initial ones",
       between(0, 10000)},
      {"run", "max_cracks_per_frame", integer, "cracks", "1",
       "new cracks that may start in one frame; the body is solved again after each, so that the next one "
       "feels the relief",
       between(1, 10000)},
      {"run",
       "after_separation",
       text,
       "",
       "\"continue\"",
       "continue: pieces that carry load go on breaking, each as a body of its own, and what nothing holds "
       "is "
       "accelerated by its load. stop: the run ends when the body comes apart, as published. Databases stop",
       {},
       0,
       {"continue", "stop"}},
      {"run",
       "smallest_body",
       number,
       "of the body",
       "1e-2",
       "pieces below this share of the first body's volume, or below 8 resolution.crack³, break no further. "
       "A "
       "piece so small does not end the run of a database",
       {.low = 0, .high = 1}},
      {"run", "seed", integer, "", "1", "of everything random", between(0, 9007199254740992.0)},
      {"run", "inertia_relief", boolean, "", "false",
       "true: loads out of balance accelerate the body as a whole instead of being refused"},
      {"run", "contact", boolean, "", "true", "crack faces do not pass through each other"},
      {"run",
       "sif",
       text,
       "",
       "\"two-point\"",
       "stress intensity from the opening at two distances, or one (raw)",
       {},
       0,
       {"two-point", "one-point"}},
      {"run",
       "sif_convention",
       text,
       "",
       "\"full-opening\"",
       "half-opening returns twice the stress intensity, as published in 2015",
       {},
       0,
       {"full-opening", "half-opening"}},
      {"run",
       "elements",
       text,
       "",
       "\"auto\"",
       "displacement on the elements of the uncracked body: linear; quadratic, for walls that bend, in which "
       "linear ones are far too stiff (144 n² bytes for n triangles); auto, quadratic where walls are thin "
       "beside the elements, up to 4000 triangles, and in its pieces where theirs are",
       {},
       0,
       {"auto", "linear", "quadratic"}},
      {"run", "quadrature_tolerance", number, "", "1e-6",
       "relative error of the integrals over pairs of the body's triangles, a hundred times that (1e-3 at "
       "most) with cracks: K needs 1e-3, walls that bend need 1e-6",
       between(1e-11, 1e-3)},
      {"run",
       "rayleigh",
       text,
       "",
       "\"exact\"",
       "Rayleigh speed: exact, or 0.9 √(μ/ρ)",
       {},
       0,
       {"exact", "approximate"}},
      {"run",
       "compression",
       text,
       "",
       "\"closed\"",
       "fronts under pressure: closed, they feel no K_I < 0, and stay where it outweighs sliding; published, "
       "−K/compressive_factor drives them where compression dominates (with contact = false)",
       {},
       0,
       {"closed", "published"}},
      {"run",
       "smallest_fragment",
       number,
       "of the body",
       "1e-4",
       "pieces below this share of the body's volume are joined to the neighbour with which they share the "
       "most "
       "fracture area",
       {.low = 0, .high = 1, .high_included = false}},
      {"run", "max_fragments", integer, "pieces", "0",
       "the smallest pieces are joined to the neighbour with which they share the most fracture area until "
       "there are so few, and with so many the run ends; 0: all stay",
       between(0, 1e6)},
      {"run", "solve_every", integer, "frames", "0",
       "methods that predict (--method) solve frames 1, 1 + N, 1 + 2N … and predict the others; 0: they "
       "solve "
       "frame 1 alone",
       between(0, 100000)},

      {"output",
       "formats",
       texts,
       "",
       "[\"ply\", \"obj\", \"glb\"]",
       "files of the pieces; `run --format` takes its place. Without ply, `compare` and `picture` cannot "
       "show "
       "the pieces",
       {},
       0,
       {"ply", "obj", "glb", "stl", "vdb", "hulls"}},
      {"output",
       "projection",
       text,
       "",
       "\"box\"",
       "texture coordinates of fracture faces: box, along the coordinate axis nearest to the normal, so that "
       "facing pieces match; planar, along one direction for each piece",
       {},
       0,
       {"box", "planar"}},
      {"output", "texture_size", number, "m", "",
       "length that a texture covers on fracture faces; without it the body's size (cube root of the volume)",
       above(0)},
      {"output", "crease_angle", number, "°", "35.0",
       "normals are smooth over edges that bend less; never from original to fracture", between(0, 180)},
      {"output", "exaggeration", number, "", "0.0",
       "above 0, frames/ show the body moved by so many times its displacement and the crack as two faces "
       "apart "
       "by so many times the opening",
       at_least(0)},

      {"database", "runs", integer, "runs", "300", "number of runs", between(1, 10000000)},
      {"database", "seed", integer, "", "1", "of the loads; run i is the same whatever the number of runs",
       between(0, 9007199254740992.0)},
      {"database", "regions", texts, "", "",
       "the pulled region, and the one that gets the opposite traction, or none where conditions of the "
       "scene hold the body; required"},
      {"database",
       "direction",
       numbers,
       "",
       "[0.0, 0.0, 1.0]",
       "pole of the hemisphere of directions, slope 0",
       {},
       3},
      {"database", "magnitude", numbers, "Pa", "", "smallest and largest traction; required", above(0), 2},
      {"database", "slope", numbers, "°", "[0.0, 90.0]",
       "smallest and largest angle α to the pole, drawn evenly", between(0, 90), 2},
      {"database", "rotation", numbers, "°", "[0.0, 360.0]",
       "smallest and largest angle β about the pole, drawn evenly", between(0, 360), 2},
      {"database", "frames", integer, "frames", "31", "most frames per run", between(2, 100000)},
      {"database", "exclude_above", number, "°", "85.0",
       "runs with a larger slope are recorded but not learned from", between(0, 90)},
      {"database", "led_by", text, "", "",
       "regressor, by name or file, whose predictions the fronts go by; every frame is solved beside it, and "
       "what is learned "
       "from are its own errors"},
      {"database", "many_cracks", integer, "cracks", "3",
       "from so many new cracks on, all of them tiny, a run is not learned from", between(1, 10000)},
      {"database", "tiny_growth", number, "crack edges", "2.0",
       "a crack is tiny if its front has travelled less", between(0, 1e6)},

      {"world",
       "classes",
       texts,
       "",
       "",
       "classes of bodies, drawn in turn; without it all of them, scan where there are scans",
       {},
       0,
       world_class_names()},
      {"world", "scans", texts, "", "",
       "mesh files that bodies of the class scan are made from: drawn out and decimated; paths are relative "
       "to the specification"},
      {"world", "runs_per_body", integer, "runs", "4", "loads on each body, one run each",
       between(1, 100000)},
      {"world", "elements", integer, "triangles", "240", "BEM triangles wanted per body", between(60, 20000)},
      {"world", "cracked", number, "", "0.3", "share of the bodies that have a crack from the start",
       between(0, 1)},
  };
  return all;
}

}  // namespace conchoid
