#!/usr/bin/env python3
"""Error against cost of --method hybrid, from prediction alone to boundary elements, on bodies of three sizes; writes the
table of docs/hybrid.md and data for its plot. Cost is instructions (callgrind, one thread) spent on finding the
opening, over those of boundary elements: it does not depend on what else the machine does.

  scripts/error_against_cost.py CONCHOID OUT [--database FOREST] [--tolerances 0.02,0.01,…] [--every 2,3] [--sizes 120,500]

Runs that OUT holds are not made again.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

OPENING = "conchoid::Fracture::State::compute_openings(conchoid::StepReport&)"
SCENE = """[body]
model = "cube"
{remesh}[material]
youngs_modulus = 3.1e9
poisson_ratio = 0.327
density = 1200.0
strength = 7.6e7
toughness = 1.0e6
[resolution]
crack = {crack}
surface = 0.025
[[boundary]]
region = "z+"
traction = [4.0e7, 2.0e7, 8.0e7]
[[boundary]]
region = "z-"
traction = [-4.0e7, -2.0e7, -8.0e7]
[run]
max_cracks = 1
inertia_relief = true
"""
CUBE_TRIANGLES = 120  # of the model as it is


def call(command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")
    return done


def run(program, folder, scene, extra):
    """Report of a run, and instructions in 10⁹ that its openings took."""
    result = folder.parent / f"{folder.name}.json"
    if result.exists():
        return json.loads(result.read_text())
    profile = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", f"--toggle-collect={OPENING}"]
    done = call([*profile, program, "run", scene, "--out", folder, "--format", "ply", "--threads", "1", "--quiet",
                 "--json", *extra])
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if not collected:
        sys.exit("callgrind has counted nothing: is the program stripped?")
    report = json.loads(done.stdout) | {"instructions": int(collected.group(1)) / 1e9}
    result.write_text(json.dumps(report))
    return report


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--database")
    parser.add_argument("--tolerances", default="inf,0.02,0.01,0.005,0.002,0.001,0")
    parser.add_argument("--every", default="", help="also the closed form kept, solved every Nth frame, for these N")
    parser.add_argument("--sizes", default="120,300,600", help="triangles of the body")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    print("| body | method | frames | solved | expected error | true error | instructions, 10⁹ | of BEM's |")
    print("|---|---|---|---|---|---|---|---|")
    for size in map(int, options.sizes.split(",")):
        text = SCENE.format(remesh="" if size == CUBE_TRIANGLES else f"remesh = {size}\n", crack=0.1)
        scene = options.out / f"{size}.toml"
        scene.write_text(text)
        bem_folder = options.out / f"{size}-bem"
        bem = run(options.program, bem_folder, scene, [])
        rows = [("bem", bem_folder, bem)]
        for every in filter(None, options.every.split(",")):
            part = options.out / f"{size}-every-{every}.toml"
            part.write_text(text + f"solve_every = {every}\n")
            folder = options.out / f"{size}-every-{every}"
            rows.append((f"kept, every {every}", folder, run(options.program, folder, part, ["--method", "kept"])))
        sources = [("kept", ["--database", "none"])] + ([("forest", ["--database", options.database])] if options.database else [])
        for name, database in sources:
            for tolerance in filter(None, options.tolerances.split(",")):
                folder = options.out / f"{size}-{name}-{tolerance}"
                extra = ["--method", "hybrid", "--tolerance", tolerance, *database]
                rows.append((f"hybrid {name}, X = {tolerance}", folder, run(options.program, folder, scene, extra)))
        for title, folder, report in rows:
            c = json.loads(call([options.program, "compare", bem_folder, folder, "--json", "--quiet"]).stdout)
            expected = report.get("expected_error")
            print(f"| {size} | {title} | {report['frames']} | {report.get('solved_frames', '')} | "
                  f"{'' if expected is None else f'{100 * expected:.2f} %'} | "
                  f"{100 * c['surface_mean'] / c['bbox_diagonal']:.2f} % | {report['instructions']:.3f} | "
                  f"{report['instructions'] / bem['instructions']:.3f} |", flush=True)


if __name__ == "__main__":
    main()
