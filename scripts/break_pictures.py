#!/usr/bin/env python3
"""Draws docs/images/broken-*.png: bodies with several cracks, broken to the end.

    scripts/break_pictures.py build/conchoid [NAME…]       all of them, or: cube vase beam disc armadillo

The Armadillo is the scan named in examples/armadillo.toml; its place is given with --scan FILE.
"""
import argparse
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
GLASS = '[material]\nyoungs_modulus = 7.0e10\npoisson_ratio = 0.22\ndensity = 2500\nstrength = 4.5e7\ntoughness = 7.5e5\n'


def ends(body, low, high, stress, more=""):
    return (body + GLASS + f'[[region]]\nname = "low"\nhalf_spaces = [[0, 0, -1, {-low}]]\n'
            f'[[region]]\nname = "high"\nhalf_spaces = [[0, 0, 1, {high}]]\n'
            f'[[boundary]]\nregion = "high"\ntraction = [0.0, 0.0, {stress}]\n[[boundary]]\nregion = "low"\nfixed = true\n' + more)


def vase(file, around=28):
    """Turned about z: a foot, a belly, a neck and a lip, the wall 12 to 15 mm thick, 0.3 m high."""
    outer = [(0.05, 0.0), (0.055, 0.02), (0.075, 0.05), (0.09, 0.085), (0.092, 0.12), (0.08, 0.155), (0.06, 0.185),
             (0.045, 0.21), (0.04, 0.235), (0.042, 0.26), (0.05, 0.28), (0.056, 0.30)]
    inner = [(r - 0.015, z) for r, z in reversed(outer) if z > 0.015]
    inner[0] = (outer[-1][0] - 0.015, 0.30)
    profile = [(0.025, 0.0)] + outer + inner + [(0.03, 0.017)]
    rings, points, faces = [], [(0.0, 0.0, 0.0)], []
    for r, z in profile:
        rings.append(range(len(points), len(points) + around))
        points += [(r * math.cos(2 * math.pi * j / around), r * math.sin(2 * math.pi * j / around), z) for j in range(around)]
    points.append((0.0, 0.0, 0.017))
    for j in range(around):
        k = (j + 1) % around
        faces.append((0, rings[0][k], rings[0][j]))
        for a, b in zip(rings, rings[1:]):
            faces += [(a[j], a[k], b[k]), (a[j], b[k], b[j])] if j % 2 else [(a[j], a[k], b[j]), (a[k], b[k], b[j])]
        faces.append((len(points) - 1, rings[-1][j], rings[-1][k]))
    with open(file, "w") as out:
        out.writelines(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points)
        out.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)


def scene(name, folder, scan):
    example = lambda n: (ROOT / "examples" / f"{n}.toml").read_text()
    if name == "cube":
        return ends('[body]\nmodel = "cube"\n[resolution]\nsurface = 0.01\n', -0.499, 0.499, 6e7, "[run]\nmax_cracks = 6\n")
    if name == "vase":
        vase(folder / "vase.obj")
        return ends('[body]\nmesh = "vase.obj"\n[resolution]\ncrack = 0.006\nsurface = 0.0006\n', 0.0005, 0.2995, 2e7,
                    '[[crack]]\nkind = "disc"\ncenter = [0.044, 0.0, 0.22]\nnormal = [0.0, 0.0, 1.0]\nradius = 0.012\n'
                    "[run]\nmax_cracks = 2\n")
    if name == "beam":
        return example("beam") + "\n[run]\nmax_cracks = 3\n"
    if name == "disc":
        return example("disc").replace("disc.obj", str(ROOT / "examples" / "disc.obj"))
    return example("armadillo").replace("armadillo.ply", str(scan)).replace("max_cracks = 4", "max_cracks = 40\nframes = 100")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("conchoid", type=pathlib.Path)
    parser.add_argument("names", nargs="*", default=["cube", "vase", "beam", "disc", "armadillo"])
    parser.add_argument("--scan", type=pathlib.Path, default=ROOT.parent / "shared/models/armadillo.ply")
    options = parser.parse_args()
    for name in options.names:
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            (folder / "scene.toml").write_text(scene(name, folder, options.scan.resolve()))
            program = options.conchoid.resolve()
            subprocess.run([program, "run", "scene.toml", "--out", "run"], cwd=folder, check=True)
            picture = ROOT / "docs/images" / f"broken-{name}.png"
            subprocess.run([program, "picture", "run", "--plain", "--explode", "0.5", *(["--up", "y", "--from", "0.5,0.35,1"] if name == "armadillo" else []), "--width", "1000", "--height", "800",
                            "--out", picture], cwd=folder, check=True)


if __name__ == "__main__":
    main()
