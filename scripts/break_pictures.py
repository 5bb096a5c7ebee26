#!/usr/bin/env python3
"""Draws docs/images/broken-*.png: bodies with several cracks, broken to the end.

    scripts/break_pictures.py build/conchoid [NAME…]       all of them, or: cube vase glass pane beam disc armadillo

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
    lathe(file, [(0.025, 0.0)] + outer + inner + [(0.03, 0.017)], around, 0.0, 0.017)


def wine_glass(file, around=24, wall=0.0015, edge=0.01):
    """Turned about z: foot, stem and bowl, 0.15 m high, the bowl's wall 1.5 mm thick."""
    foot = [(0.012, 0.0), (0.024, 0.0), (0.034, 0.0), (0.034, 0.002), (0.022, 0.0035), (0.010, 0.006), (0.0045, 0.012)]
    bowl = [(0.0045, 0.066), (0.010, 0.070), (0.018, 0.0745), (0.026, 0.082), (0.032, 0.092), (0.0355, 0.105), (0.0362, 0.118),
            (0.0350, 0.134), (0.0325, 0.150)]
    inner = []
    for i, (r, z) in enumerate(bowl[:-1]):
        before, after = bowl[max(0, i - 1)], bowl[i + 1]
        length = math.dist(before, after)
        inner.append((r - wall * (after[1] - before[1]) / length, z + wall * (after[0] - before[0]) / length))
    inner = [p for p in inner if p[0] > 0.007] + [(bowl[-1][0] - wall, bowl[-1][1])]
    lathe(file, divided(foot + [(0.0045, 0.03), (0.0045, 0.048)] + bowl, edge) + divided(inner[::-1], edge), around, 0.0, 0.0705)


def divided(line, edge):
    """The same line with points no farther apart than `edge`."""
    out = [line[0]]
    for a, b in zip(line, line[1:]):
        n = max(1, math.ceil(math.dist(a, b) / edge - 1e-9))
        out += [tuple(p + (q - p) * i / n for p, q in zip(a, b)) for i in range(1, n + 1)]
    return out


def lathe(file, profile, around, low, high):
    """Writes what a profile (radius, height) off the axis makes, closed in two heights on the axis."""
    rings, points, faces = [], [(0.0, 0.0, low)], []
    for r, z in profile:
        rings.append(range(len(points), len(points) + around))
        points += [(r * math.cos(2 * math.pi * j / around), r * math.sin(2 * math.pi * j / around), z) for j in range(around)]
    points.append((0.0, 0.0, high))
    for j in range(around):
        k = (j + 1) % around
        faces.append((0, rings[0][k], rings[0][j]))
        for a, b in zip(rings, rings[1:]):
            faces += [(a[j], a[k], b[k]), (a[j], b[k], b[j])] if j % 2 else [(a[j], a[k], b[j]), (a[k], b[k], b[j])]
        faces.append((len(points) - 1, rings[-1][j], rings[-1][k]))
    with open(file, "w") as out:
        out.writelines(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points)
        out.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)


def squeezed(name, side, force):
    """Two patches of 24 mm across pressed together along x at the rim."""
    return (f'[[region]]\nname = "{name}"\nsphere = [{side * 0.0325}, 0.0, 0.150, 0.012]\n'
            f'[[boundary]]\nregion = "{name}"\nforce = [{-side * force}, 0.0, 0.0]\n')


def hit_pane(folder, side, force, patch=0.02, thickness=0.006):
    """Square, held along its normal at the edges, pressed on a patch in its middle."""
    corners = [(x * side / 2, y * side / 2, z * thickness / 2) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    with open(folder / "pane.obj", "w") as out:
        out.writelines(f"v {x} {y} {z}\n" for x, y, z in corners)
        out.writelines("f " + " ".join(str(i + 1) for i in f) + "\n" for f in faces)
    text = ('[body]\nmesh = "pane.obj"\nremesh = 2000\n' + GLASS + "[resolution]\ncrack = 0.003\nsurface = 0.0003\n"
            f'[[region]]\nname = "patch"\nsphere = [0.0, 0.0, {thickness / 2}, {patch / 2}]\nedge = {patch / 4}\n'
            f'[[boundary]]\nregion = "patch"\nforce = [0.0, 0.0, {-force}]\n')
    for name, normal in (("x+", "1, 0, 0"), ("x-", "-1, 0, 0"), ("y+", "0, 1, 0"), ("y-", "0, -1, 0")):
        text += (f'[[region]]\nname = "{name}"\nhalf_spaces = [[{normal}, {side / 2 - 1e-4}]]\n'
                 f'[[boundary]]\nregion = "{name}"\ndisplacement = ["free", "free", 0.0]\n')
    return text


def scene(name, folder, scan):
    example = lambda n: (ROOT / "examples" / f"{n}.toml").read_text()
    if name == "cube":
        return ends('[body]\nmodel = "cube"\n[resolution]\nsurface = 0.01\n', -0.499, 0.499, 6e7, "[run]\nmax_cracks = 6\n")
    if name == "vase":
        vase(folder / "vase.obj")
        return ends('[body]\nmesh = "vase.obj"\n[resolution]\ncrack = 0.006\nsurface = 0.0006\n', 0.0005, 0.2995, 2e7,
                    '[[crack]]\nkind = "disc"\ncenter = [0.044, 0.0, 0.22]\nnormal = [0.0, 0.0, 1.0]\nradius = 0.012\n'
                    "[run]\nmax_cracks = 2\n")
    if name == "glass":
        wine_glass(folder / "glass.obj")
        return ('[body]\nmesh = "glass.obj"\n' + GLASS + "[resolution]\ncrack = 0.00075\nsurface = 0.00006\n" +
                squeezed("right", 1, 75.0) + squeezed("left", -1, 75.0) + "[run]\nmax_cracks = 2\nframes = 60\n")
    if name == "pane":
        return hit_pane(folder, 0.3, 1200.0) + "[run]\nmax_cracks = 3\nframes = 20\n"
    if name == "beam":
        return example("beam") + "\n[run]\nmax_cracks = 3\n"
    if name == "disc":
        return example("disc").replace("disc.obj", str(ROOT / "examples" / "disc.obj"))
    return example("armadillo").replace("armadillo.ply", str(scan)).replace("max_cracks = 4", "max_cracks = 40\nframes = 100")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("conchoid", type=pathlib.Path)
    parser.add_argument("names", nargs="*", default=["cube", "vase", "glass", "pane", "beam", "disc", "armadillo"])
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
