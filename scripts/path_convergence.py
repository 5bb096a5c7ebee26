#!/usr/bin/env python3
"""Final crack surfaces at r̄ and r̄/2: mean distance over r̄ in ten scenes of one crack in a body.

    scripts/path_convergence.py build/conchoid [--limit 0.15]     exit status 1 where a distance exceeds the limit

Bodies are the built-in cube and cylinder under pulls of ten directions and sizes, balanced by inertia relief. Takes some minutes.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

EDGE = 0.1  # r̄ [m]
SCENES = [("cube", (shear, twist, 9e7)) for shear, twist in ((0, 0), (1e7, 0), (2.7e7, 0), (4.5e7, 0), (1.8e7, 1.8e7), (3e7, -2e7))] + [
    ("cylinder", (shear, 0, 9e7)) for shear in (0, 1e7, 2e7, 3e7)]
TEXT = """[body]
model = "{model}"
[material]
youngs_modulus = 3.1e9
poisson_ratio = 0.327
strength = 7.6e7
toughness = 1e6
[resolution]
crack = {edge}
surface = 0.02
[[boundary]]
region = "{top}"
traction = [{x}, {y}, {z}]
[[boundary]]
region = "{bottom}"
traction = [-{x}, -{y}, -{z}]
[run]
inertia_relief = true
"""


def run(program, folder, name, model, pull, edge):
    top, bottom = ("z+", "z-") if model == "cube" else ("top", "bottom")
    scene = folder / f"{name}.toml"
    text = TEXT.format(model=model, edge=edge, top=top, bottom=bottom, x=pull[0], y=pull[1], z=pull[2])
    scene.write_text(text.replace("--", ""))
    out = subprocess.run([program, "run", scene, "--out", folder / name, "--json", "--quiet"], capture_output=True, text=True)
    if out.returncode:
        sys.exit(f"{scene}: {out.stderr}")
    return json.loads(out.stdout)["stop"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--limit", type=float, default=0.15)
    options = parser.parse_args()
    worst = 0
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        for i, (model, pull) in enumerate(SCENES):
            stops = [run(options.program, folder, f"{i}-{part}", model, pull, EDGE / part) for part in (1, 2)]
            report = subprocess.run([options.program, "compare", folder / f"{i}-1", folder / f"{i}-2"], capture_output=True, text=True).stdout
            mean = float(re.search(r"mean ([0-9.e+-]+) m", report)[1]) / EDGE
            worst = max(worst, mean)
            print(f"{model} {pull}: {mean:.3f} r̄, {stops[0]} and {stops[1]}", flush=True)
    return 1 if worst > options.limit else 0


if __name__ == "__main__":
    sys.exit(main())
