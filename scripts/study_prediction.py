#!/usr/bin/env python3
"""Predicted against solved fracture on loads that no database has seen; writes the tables of docs/prediction.md.

  scripts/study_prediction.py CONCHOID DATABASE OUT [--scenes 30] [--slope 60] [--seed 2024]

Trains one forest (50, 10) per feature set and two ridge regressions on DATABASE, draws loads as the database does but with another seed, and reports
  one-step accuracy (R² of Δu/r̄) on a second database of these loads, beside the steady baseline, and
  whole runs: distance between the final crack surface of each method and the one solved by boundary elements.
"""
import argparse
import json
import math
import pathlib
import random
import statistics
import subprocess
import sys

# name of the row: model and feature set
MODELS = {name: ("forest", name) for name in ["paper-3", "paper-4", "paper-5", "dimensionless"]}
MODELS |= {f"ridge, {name}": ("ridge", name) for name in ["paper-4", "dimensionless"]}
SCENE = """[body]
model = "cube"
[material]
youngs_modulus = 3.1e9
poisson_ratio = 0.327
[resolution]
crack = 0.1
surface = 0.025
"""


def call(program, *arguments):
    done = subprocess.run([program, *map(str, arguments), "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def report(program, *arguments):
    return json.loads(call(program, *arguments, "--json"))


def trained_file(out, name):
    return out / f"{'-'.join(MODELS[name])}.model"


def draw_scene(generator, slope):
    alpha, beta = math.radians(generator.uniform(0, slope)), generator.uniform(0, 2 * math.pi)
    f = generator.uniform(0.8e8, 1.2e8)
    d = [f * math.sin(alpha) * math.cos(beta), f * math.sin(alpha) * math.sin(beta), f * math.cos(alpha)]
    loads = "".join(f'[[boundary]]\nregion = "{r}"\ntraction = {[s * x for x in d]}\n' for r, s in (("z+", 1), ("z-", -1)))
    return SCENE + loads + "[run]\ninertia_relief = true\n", math.degrees(alpha)


def whole_runs(program, out, scenes, slope, seed):
    generator = random.Random(seed)
    rows = {name: [] for name in ["steady", *MODELS]}
    for i in range(scenes):
        text, alpha = draw_scene(generator, slope)
        scene = out / f"scene_{i:02}.toml"
        scene.write_text(text)
        solved = report(program, "run", scene, "--out", out / f"{i:02}-bem")
        for name in rows:
            method = ["steady"] if name == "steady" else [MODELS[name][0], "--database", trained_file(out, name)]
            folder = out / f"{i:02}-{name.replace(', ', '-')}"
            predicted = report(program, "run", scene, "--method", *method, "--out", folder)
            c = report(program, "compare", out / f"{i:02}-bem", folder)
            rows[name].append((c["surface_mean"] / c["bbox_diagonal"], c["surface_p95"] / c["bbox_diagonal"],
                               c["largest_fragment_iou"] or 0, predicted["frames"], solved["frames"], alpha))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("database")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scenes", type=int, default=30)
    parser.add_argument("--slope", type=float, default=60)
    parser.add_argument("--seed", type=int, default=2024)
    a = parser.parse_args()
    a.out.mkdir(parents=True, exist_ok=True)

    spec = a.out / "held-out.toml"
    spec.write_text(SCENE + f'[database]\nruns = {a.scenes}\nseed = {a.seed}\nregions = ["z+", "z-"]\n'
                    f"magnitude = [0.8e8, 1.2e8]\nslope = [0, {a.slope:g}]\n")
    held_out = a.out / "held-out.h5"
    if not held_out.exists():
        call(a.program, "database", "generate", spec, "--out", held_out)

    print("| features | R² I | R² II | R² III | RMSE I | RMSE II | RMSE III |\n|---|---|---|---|---|---|---|")
    for position, (name, (model, features)) in enumerate(MODELS.items()):
        file = trained_file(a.out, name)
        call(a.program, "forest", "train", a.database, "--model", model, "--features", features, "--out", file)
        e = report(a.program, "forest", "evaluate", file, "--samples", held_out)
        line = lambda n, r2, rmse: print(f"| {n} | " + " | ".join(f"{r2[m]:.3f}" for m in ("I", "II", "III")) + " | " +
                                         " | ".join(f"{rmse[m]:.3g}" for m in ("I", "II", "III")) + " |", flush=True)
        if position == 0:
            line("steady (no training)", e["baseline_steady"]["r2"], e["baseline_steady"]["rmse"])
        line(name, e["r2"], e["rmse"])

    rows = whole_runs(a.program, a.out, a.scenes, a.slope, a.seed)
    print(f"\n{a.scenes} held-out scenes, α ≤ {a.slope:g}°\n")
    print("| method | surface_mean / diagonal, median | largest | surface_p95, median | IoU, median | frames, mean (solved) |")
    print("|---|---|---|---|---|---|")
    for name, r in rows.items():
        column = lambda k: [x[k] for x in r]
        print(f"| {name} | {100 * statistics.median(column(0)):.2f} % | {100 * max(column(0)):.2f} % | "
              f"{100 * statistics.median(column(1)):.2f} % | {statistics.median(column(2)):.3f} | "
              f"{statistics.mean(column(3)):.1f} ({statistics.mean(column(4)):.1f}) |")


if __name__ == "__main__":
    main()
