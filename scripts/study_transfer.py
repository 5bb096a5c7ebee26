#!/usr/bin/env python3
"""Whole runs of bodies of classes that a forest has seen in training, and of classes that it has not; writes the tables of docs/prediction.md.

  scripts/study_transfer.py CONCHOID WORK [--runs 10] [--only NAMES] [--armadillo tests/data/armadillo.ply]

WORK holds world.h5, cube.h5, cylinder.h5, bar.h5 (scripts/make_databases.sh) and keeps forests and results. For every class: a specification with
another seed (fresh bodies, fresh loads), solved by boundary elements, by steady, kept and stress, by the forest of all classes, by one trained
without the class (and without its like: box and cube, rod and bar), and for cube, cylinder and bar by their own database; solved under small changes
of the scene, and hybrid; all but these once more under 2.5 times the load.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORLD = ["box", "plate", "prism", "cylinder", "tube", "cup", "rod", "blob", "polyhedron"]
LIKE = {"box": ["box", "cube"], "cube": ["box", "cube"], "rod": ["rod", "bar"], "bar": ["rod", "bar"]}
TRAINING = ["--features", "versatile", "--trees", "12", "--depth", "18", "--leaf", "8"]
TOLERANCES = ["0.005", "0.01", "0.02"]  # of hybrid runs
LOADS = [1, 2.5]
ARMADILLO = """[body]
mesh = "{file}"
remesh = 1100
scale = 1.0
[material]
youngs_modulus = 3.1e9
poisson_ratio = 0.327
[resolution]
crack = 3.0
surface = 0.3
[[region]]
name = "left hand"
half_spaces = [[0.0, 1.0, 0.0, 50.0], [1.0, 0.0, 0.0, 45.0]]
[[region]]
name = "right hand"
half_spaces = [[0.0, 1.0, 0.0, 50.0], [-1.0, 0.0, 0.0, 45.0]]
[[region]]
name = "feet"
half_spaces = [[0.0, -1.0, 0.0, 50.0]]
[[boundary]]
region = "feet"
fixed = true
[database]
runs = {runs}
seed = 2024
regions = ["left hand", "right hand"]
direction = [1.0, 0.0, 0.0]
magnitude = [8.0e5, 1.2e6]
slope = [0.0, 40.0]
"""


def call(program, *arguments):
    done = subprocess.run([program, *map(str, arguments), "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def specification(name, runs, armadillo):
    if name == "armadillo":
        return ARMADILLO.format(file=armadillo, runs=runs)
    if name in ("cube", "cylinder model", "bar"):
        text = (ROOT / "databases" / f"{name.split()[0]}.toml").read_text()
        return "\n".join(f"seed = 2024" if line.startswith("seed") else f"runs = {runs}" if line.startswith("runs") else line
                         for line in text.splitlines()) + "\n"
    return f'[world]\nclasses = ["{name}"]\nruns_per_body = 1\nelements = 150\n[database]\nruns = {runs}\nseed = 2024\nframes = 31\n'


def forest(program, work, title, *options):
    file = work / f"{title}.forest"
    databases = [work / f"{name}.h5" for name in ("world", "cube", "cylinder", "bar")]
    if not file.exists():
        call(program, "forest", "train", *[d for d in databases if d.exists()], *TRAINING, *options, "--out", file)
    return file


def evaluate(program, work, name, runs, armadillo, load):
    result = work / f"whole-runs-{name.replace(' ', '-')}-{runs}-load-{load}.json"
    if not result.exists():
        spec = work / f"held-out-{name.replace(' ', '-')}.toml"
        spec.write_text(specification(name, runs, armadillo))
        like = LIKE.get(name, [name.split()[0]])
        beside = []
        if name != "armadillo":
            without = forest(program, work, "without-" + "-".join(like), "--without", ",".join(like))
            beside.append(without)
        own = name.split()[0]
        if name in ("cube", "cylinder model", "bar"):
            beside.append(ROOT / "databases" / f"{own}.forest")
        text = call(program, "forest", "evaluate", forest(program, work, "all"), "--runs", spec, "--load", load, "--json",
                    *(["--noise-floor", "--tolerance", ",".join(TOLERANCES)] if load == 1 else []),
                    *(["--beside", ",".join(map(str, beside))] if beside else []))
        result.write_text(text)
    return json.loads(result.read_text())


def column(score):
    return f"{100 * score['surface_median']:.2f}, {100 * score['surface_largest']:.1f}, {score['frames_ratio']:.2f}, {score['lost']}" if score else ""


def of_class(name, scores):
    """By role: steady, kept, stress, all, without, own, and those of hybrid runs; the Armadillo is in no training."""
    roles = {}
    for method, score in scores.items():
        forest_of, _, rest = method.partition(", hybrid ")
        role = "without" if forest_of.startswith("without") or (name == "armadillo" and forest_of == "all") else \
            "own" if forest_of == name.split()[0] else forest_of
        roles[f"{role}, hybrid {rest}" if rest else role] = score
    return roles


def tables(names, result_of, noise_floor):
    print(f"| class | runs |{' solved, changed |' if noise_floor else ''} steady | kept | stress | class in training | class left out | own database |")
    print("|---" * (9 if noise_floor else 8) + "|")
    pooled, seconds_of = {}, {}
    for name in names:
        result = result_of(name)
        scores = of_class(name, {s["method"]: s for s in result["scores"] if s["class"]})
        for r in result["runs"]:
            role = next(iter(of_class(name, {r["method"]: 0})))
            pooled.setdefault(role, {})[name, r["run"]] = r["surface_mean"]
            seconds_of.setdefault(role, []).append(r["opening_seconds"])
        if not scores:
            print(f"| {name} | 0 |", flush=True)
            continue
        cells = ["; ".join(f"{100 * s['surface_median']:.2f}" for m, s in scores.items() if m.startswith("solved, "))] if noise_floor else []
        cells += [column(scores.get(m)) for m in ("steady", "kept", "stress", "all", "without", "own")]
        print(f"| {name} | {scores['steady']['runs']} | " + " | ".join(cells) + " |", flush=True)
    print("\n| all runs together | runs | median | 90 % | largest | class left out is better in | openings over those solved |\n|---|---|---|---|---|---|---|")
    for role, runs in pooled.items():
        values, both = sorted(runs.values()), [k for k in runs if k in pooled["without"]]
        better = sum(pooled["without"][k] < runs[k] for k in both)
        seconds = [sum(s) for s in zip(*seconds_of[role])]
        print(f"| {role} | {len(values)} | {100 * statistics.median(values):.2f} | {100 * values[int(0.9 * (len(values) - 1))]:.1f} | {100 * values[-1]:.1f} | "
              f"{better} of {len(both)} | {seconds[1] / seconds[0]:.2f} |")
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--only", default="")
    parser.add_argument("--armadillo", default=str(ROOT / "tests/data/armadillo.ply"))
    a = parser.parse_args()
    names = a.only.split(",") if a.only else ["cube", "cylinder model", "bar", *WORLD, "armadillo"]
    for load in LOADS:
        print(f"Load x {load}\n")
        tables(names, lambda name: evaluate(a.program, a.work, name, a.runs, a.armadillo, load), load == 1)


if __name__ == "__main__":
    main()
