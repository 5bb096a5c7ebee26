#!/usr/bin/env python3
"""What K loses with a looser run.quadrature_tolerance: six cases, a table.

    scripts/quadrature_tolerance.py build/conchoid

Largest difference of any of the three intensities at any node of the front from those at 1e-9, as a share of the largest intensity.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

TOLERANCES = ["1e-3", "3e-4", "1e-4", "1e-5", "1e-6"]
MATERIAL = '[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\ndensity = 1200\nstrength = 7.6e7\ntoughness = 1e6\n'


def pull(t, top="z+", bottom="z-"):
    minus = [-x for x in t]
    return (f'[[boundary]]\nregion = "{top}"\ntraction = {t}\n[[boundary]]\nregion = "{bottom}"\ntraction = {minus}\n')


def crack(kind, **keys):
    return f'[[crack]]\nkind = "{kind}"\n' + "".join(f"{k} = {v}\n" for k, v in keys.items())


def body(model, r, more, remesh=None):
    text = f'[body]\nmodel = "{model}"\n' + (f"remesh = {remesh}\n" if remesh else "") + MATERIAL
    return text + f"[resolution]\ncrack = {r}\n" + more


CASES = {
    "penny crack in an infinite body": '[body]\nmodel = "infinite"\n' + MATERIAL + "[resolution]\ncrack = 0.1\n"
    "[remote_stress]\ntensor = [0.0, 0.0, 1e6, 0.0, 5e5, 0.0]\n"
    + crack("disc", center=[0.0, 0.0, 0.0], normal=[0.0, 0.0, 1.0], radius=0.5),
    "edge-crack cube, pulled": body("edge-crack-cube", 0.1, pull([0.0, 0.0, 2e6])),
    "edge-crack cube, sheared": body("edge-crack-cube", 0.1, pull([2e6, 0.0, 0.0])),
    "edge-crack cube, torn, 600 elements": body("edge-crack-cube", 0.08, pull([0.0, 2e6, 0.0]), 600),
    "disc 0.6 crack edges below a face": body(
        "cube", 0.1, pull([0.0, 0.0, 2e6]) + crack("disc", center=[0.0, 0.0, 0.44], normal=[0.0, 0.0, 1.0], radius=0.25)),
    "oblique edge crack in a cylinder": body(
        "cylinder", 0.1, pull([0.0, 0.0, 2e6], "top", "bottom") + crack("disc", center=[0.5, 0.0, 0.03], normal=[0.3, 0.1, 1.0], radius=0.3)),
}


def intensities(program, text, tolerance):
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.toml"
        scene.write_text(text + f"[run]\ninertia_relief = true\nquadrature_tolerance = {tolerance}\n")
        done = subprocess.run([program, "sif", scene, "--json", "--quiet"], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        report = json.loads(done.stdout)
        return [node["K"] for front in report["fronts"] for node in front["nodes"]]


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    print("| | " + " | ".join(TOLERANCES) + " |\n|---" + "|---" * len(TOLERANCES) + "|")
    for name, text in CASES.items():
        exact = intensities(program, text, "1e-9")
        largest = max(abs(k) for row in exact for k in row)
        cells = []
        for tolerance in TOLERANCES:
            rows = intensities(program, text, tolerance)
            off = max(abs(a - b) for x, y in zip(rows, exact) for a, b in zip(x, y))
            cells.append(f"{100 * off / largest:.2g} %")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
