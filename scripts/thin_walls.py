#!/usr/bin/env python3
"""Thin walls with linear and quadratic elements: cantilevers and a pane against beam and plate theory.

  scripts/thin_walls.py build/conchoid [--cases cantilever,pane] > table.md

Prints the share of the true stress and deflection that `conchoid stress` shows, over the unknowns and seconds it takes
(docs/verification.md has the tables). Bodies are boxes of regular triangles, made here.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile

GLASS = {"E": 7e10, "nu": 0.22}


def box(size, parts):
    """A box around the origin as nodes and triangles, cut into parts along each axis."""
    nodes, number, triangles = [], {}, []

    def node(index):
        if index not in number:
            number[index] = len(nodes) + 1
            nodes.append([s * (i / n - 0.5) for s, i, n in zip(size, index, parts)])
        return number[index]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, parts[axis]):
            for i in range(parts[u]):
                for j in range(parts[v]):
                    corner = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        index = [0, 0, 0]
                        index[axis], index[u], index[v] = end, i + a, j + b
                        corner.append(node(tuple(index)))
                    if end == 0:
                        corner.reverse()
                    triangles += [(corner[0], corner[1], corner[2]), (corner[0], corner[2], corner[3])]
    return nodes, triangles


def write_obj(path, mesh):
    nodes, triangles = mesh
    lines = ["v %.17g %.17g %.17g" % tuple(x) for x in nodes]
    lines += ["f %d %d %d" % t for t in triangles]
    path.write_text("\n".join(lines) + "\n")


def region(name, normal, distance):
    plane = [float(x) for x in normal] + [distance]
    return f'[[region]]\nname = "{name}"\nhalf_spaces = [{plane}]\n'


def stress(program, mesh, conditions, elements):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_obj(folder / "body.obj", mesh)
        (folder / "scene.toml").write_text(
            '[body]\nmesh = "body.obj"\n[material]\n'
            f"youngs_modulus = {GLASS['E']}\npoisson_ratio = {GLASS['nu']}\n"
            "density = 2500\nstrength = 5e7\ntoughness = 7.5e5\n"
            f'{conditions}[run]\nelements = "{elements}"\n')
        out = subprocess.run([program, "stress", folder / "scene.toml", "--json"], capture_output=True, text=True)
    if out.returncode:
        raise SystemExit(out.stderr)
    return json.loads(out.stdout)


def unknowns(mesh, report):
    nodes, triangles = mesh
    return 3 * (len(nodes) + (len(triangles) * 3 // 2 if report["elements"] == "quadratic" else 0))


def cantilever(program, elements, edge, ratio):
    """1 m × 0.3 m, elements of `edge`, edge/thickness = ratio, 100 N at the end: stress in the middle half."""
    length, width, force, t = 1.0, 0.3, 100.0, edge / ratio
    parts = (round(length / edge), round(width / edge), max(1, round(t / edge)))
    mesh = box((length, width, t), parts)
    conditions = (region("held", (-1, 0, 0), length / 2 - 1e-4) + region("end", (1, 0, 0), length / 2 - 1e-4) +
                  '[[boundary]]\nregion = "held"\nfixed = true\n'
                  f'[[boundary]]\nregion = "end"\nforce = [0.0, 0.0, {-force}]\n')
    report = stress(program, mesh, conditions, elements)
    shown = theory = 0.0
    for triangle in report["triangles"]:
        x, y, z = triangle["centroid"]
        if abs(z - t / 2) < 1e-3 * t and abs(x) < length / 4 and abs(y) < 0.3 * width:
            shown += triangle["principal"][0]
            theory += force * (length / 2 - x) / (width * t * t / 6)
    deflection = 4 * force * length**3 / (GLASS["E"] * width * t**3)
    return shown / theory, report["max_displacement"] / deflection, mesh, report


def pane(program, elements, parts):
    """1 m × 1 m × 6 mm, pressure on one side, edges held along the normal: stress and deflection in the middle."""
    a, t, q = 1.0, 0.006, 1e3
    nu = GLASS["nu"]
    mesh = box((a, a, t), (parts, parts, 1))
    conditions, face = "", a / 2 - 1e-4
    for name, normal in (("x-", (-1, 0, 0)), ("x+", (1, 0, 0)), ("y-", (0, -1, 0)), ("y+", (0, 1, 0))):
        conditions += region(name, normal, face)
        conditions += f'[[boundary]]\nregion = "{name}"\ndisplacement = ["free", "free", 0.0]\n'
    conditions += region("top", (0, 0, 1), t / 2 - 1e-5) + f'[[boundary]]\nregion = "top"\npressure = {q}\n'
    report = stress(program, mesh, conditions, elements)
    below = [tr for tr in report["triangles"] if tr["centroid"][2] < -t / 2 + 1e-5]
    nearest = sorted(below, key=lambda tr: tr["centroid"][0]**2 + tr["centroid"][1]**2)[:4]
    true_stress = 6 * 0.03685 * (1 + nu) * q * a * a / t**2
    rigidity = GLASS["E"] * t**3 / (12 * (1 - nu * nu))
    return (sum(tr["principal"][0] for tr in nearest) / len(nearest) / true_stress,
            report["max_displacement"] / (0.004062 * q * a**4 / rigidity), mesh, report)


def row(name, case):
    shown, deflection, mesh, report = case
    print(f"| {name} | {report['elements']} | {len(mesh[1])} | {unknowns(mesh, report)} | {shown:.3f} | {deflection:.3f} | "
          f"{report['seconds']:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--cases", default="cantilever,pane")
    arguments = parser.parse_args()
    print("| body | elements | triangles | unknowns | stress | deflection | s |\n|---|---|---|---|---|---|---|")
    if "cantilever" in arguments.cases:
        for elements in ("linear", "quadratic"):
            for ratio in (0.5, 1, 2, 3, 5, 8):
                row(f"cantilever, h/t = {ratio}", cantilever(arguments.program, elements, 0.1, ratio))
    if "pane" in arguments.cases:
        for elements, some in (("linear", (16, 24)), ("quadratic", (6, 8, 12, 16, 20))):
            for parts in some:
                row(f"pane, {parts} × {parts}, h/t = {1 / parts / 0.006:.0f}",
                    pane(arguments.program, elements, parts))


if __name__ == "__main__":
    main()
