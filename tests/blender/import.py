"""What Blender sees in files of pieces: blender --background --factory-startup --python import.py -- FILE...

Prints one line of JSON per file, after the marker "IMPORTED ": a list of its objects with name, triangles, volume [m³],
material names and the number of triangles of each.
"""

import json
import sys

import bmesh
import bpy
import numpy

# Blender 3.4's glTF importer asks for an alias that numpy has dropped since; Debian 12 ships both.
if "bool" not in vars(numpy):
    numpy.bool = bool


def read(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if file.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=file)
    elif file.endswith(".obj"):
        bpy.ops.wm.obj_import(filepath=file)
    elif file.endswith(".ply"):
        bpy.ops.import_mesh.ply(filepath=file)
    elif file.endswith(".stl"):
        bpy.ops.import_mesh.stl(filepath=file)
    else:
        raise ValueError(file)


def describe(item):
    mesh = bmesh.new()
    mesh.from_mesh(item.data)
    bmesh.ops.remove_doubles(mesh, verts=mesh.verts, dist=0)
    mesh.transform(item.matrix_world)
    bmesh.ops.triangulate(mesh, faces=mesh.faces)
    names = [slot.material.name if slot.material else "" for slot in item.material_slots]
    counts = [0] * max(1, len(names))
    for face in mesh.faces:
        counts[face.material_index] += 1
    return {
        "name": item.name,
        "triangles": len(mesh.faces),
        "volume": mesh.calc_volume(signed=True),
        "materials": names,
        "counts": counts,
        "uv": len(item.data.uv_layers),
    }


for file in sys.argv[sys.argv.index("--") + 1 :]:
    read(file)
    items = sorted((o for o in bpy.data.objects if o.type == "MESH"), key=lambda o: o.name)
    print("IMPORTED " + json.dumps([describe(o) for o in items]), flush=True)
