#!/usr/bin/env python3
"""Result hashes of a fixed list of runs: what a change must not move.

    scripts/run_hashes.py build/conchoid                      print the list: name, hash, frames, pieces, why it stopped
    scripts/run_hashes.py build/conchoid --keep DIR           and keep the run folders
    scripts/run_hashes.py build/conchoid --check FILE         compare with a list; exit status 1 on any difference
    scripts/run_hashes.py build/conchoid --close DIR          compare K, openings and positions with the runs kept in DIR

The same compiler and C library give the same bits on all processors with AVX2 and FMA (core/blas_kernels.hpp). Takes some minutes.
"""
import argparse
import csv
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = ["bar", "cube", "cube-30", "edge-crack", "grains", "layers", "noise", "penny"]
PULL = """
[[boundary]]
region = "{top}"
traction = [0.0, 0.0, {stress}]
[[boundary]]
region = "{bottom}"
{other}
"""


def body(model, material, stress, top="z+", bottom="z-", held=False, more="", resolution="crack = 0.1\nsurface = 0.02"):
    other = "fixed = true" if held else f"traction = [0.0, 0.0, -{stress}]"
    return (f'[body]\nmodel = "{model}"\n[material]\nname = "{material}"\n[resolution]\n{resolution}\n'
            + PULL.format(top=top, bottom=bottom, stress=stress, other=other) + more)


# Built-in bodies in named materials, beside the examples.
SCENES = {
    "cylinder-glass": body("cylinder", "glass", "8e7", "top", "bottom"),
    "cylinder-ceramic": body("cylinder", "ceramic", "4e8", "top", "bottom"),
    "cube-concrete": body("cube", "concrete", "6e6", held=True),
    "cube-marble": body("cube", "marble", "2e7", held=True),
    "cube-ice": body("cube", "ice", "3e6"),
    "cube-two-cracks": body("cube", "glass", "6e7", held=True, more="[run]\nmax_cracks = 2\nframes = 8\n"),
    "cube-one-point": body("cube", "glass", "6e7", held=True, more='[run]\nsif = "one-point"\n'),
    "cube-compression": body("cube", "plaster", "8e6", held=True, more='[run]\ncompression = "published"\ncontact = false\n'),
    "edge-crack-concrete": '[body]\nmodel = "edge-crack-cube"\n[material]\nname = "concrete"\n[resolution]\ncrack = 0.15\n'
                           'surface = 0.02\n' + PULL.format(top="z+", bottom="z-", stress="2e6", other="traction = [0.0, 0.0, -2e6]"),
}


class Runs:
    def __init__(self, program, work):
        self.program, self.work, self.rows = str(pathlib.Path(program).resolve()), pathlib.Path(work).resolve(), []

    def call(self, *arguments):
        command = [self.program, *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stderr}")
        return done.stdout

    def run(self, name, scene, *arguments):
        out = self.work / name
        report = json.loads(self.call("run", scene, "--json", "--quiet", "--out", out, *arguments))
        self.add(name, report["hash"], report["frames"], len(report["fragments"]), report["stop"])
        return report

    def add(self, name, *values):
        self.rows.append((name, *map(str, values)))
        print("%-28s %s" % (name, " ".join(map(str, values))), flush=True)

    def scene(self, name, text):
        path = self.work / f"{name}.toml"
        path.write_text(text)
        return path


def without_times(report):
    return {key: value for key, value in report.items() if key != "seconds"}


def all_runs(runs):
    examples = {name: ROOT / "examples" / f"{name}.toml" for name in EXAMPLES}
    for name, path in examples.items():
        runs.run(name, path)
    scan = ROOT.parent / "shared" / "models" / "armadillo.ply"
    if scan.exists():
        shutil.copy(scan, runs.work / "armadillo.ply")
        runs.run("armadillo", runs.scene("armadillo", (ROOT / "examples" / "armadillo.toml").read_text()))
    for name, text in SCENES.items():
        runs.run(name, runs.scene(name, text))
    for name in ["cube", "cube-30", "edge-crack", "layers", "penny"]:
        runs.run(f"{name}-steady", examples[name], "--method", "steady")
    database = runs.work / "cube.h5"
    runs.call("database", "generate", ROOT / "examples" / "cube-database.toml", "--runs", 60, "--out", database, "--quiet")
    info = json.loads(runs.call("database", "info", database, "--json"))
    runs.add("database-60", info.get("hash", info["samples"]), info["samples"])
    for features in ["paper-4", "dimensionless"]:
        forest = runs.work / f"{features}.forest"
        runs.call("forest", "train", database, "--out", forest, "--trees", 20, "--depth", 8, "--features", features, "--quiet")
        runs.add(f"forest-{features}", hashlib.sha256(forest.read_bytes()).hexdigest()[:16])
        for name in ["cube", "cube-30"]:
            runs.run(f"{name}-{features}", examples[name], "--method", "forest", "--database", forest)
    runs.run("cube-30-one-thread", examples["cube-30"], "--threads", 1)
    runs.run("layers-two-threads", examples["layers"], "--threads", 2)
    runs.call("run", examples["cube-30"], "--quiet", "--out", runs.work / "cube-30-resumed", "--frames", 5)
    runs.run("cube-30-resumed", examples["cube-30"], "--resume")
    for command in ["sif", "stress"]:
        for name in ["edge-crack", "penny", "bar"]:
            if (command, name) in [("stress", "penny"), ("sif", "bar")]:
                continue
            report = without_times(json.loads(runs.call(command, examples[name], "--json", "--quiet")))
            runs.add(f"{command}-{name}", hashlib.sha256(json.dumps(report).encode()).hexdigest()[:16])


def difference(left, right):
    """Largest difference of each column's numbers, over the largest number of its quantity."""
    groups = {"position": ["x", "y", "z"], "K": ["K_I", "K_II", "K_III"], "opening": ["opening_I", "opening_II", "opening_III"]}
    rows = [list(csv.DictReader(open(path))) for path in (left, right)]
    if len(rows[0]) != len(rows[1]):
        return {"rows": abs(len(rows[0]) - len(rows[1]))}
    out = {}
    for name, columns in groups.items():
        size = max((abs(float(r[c])) for r in rows[0] for c in columns), default=0) or 1
        out[name] = max((abs(float(a[c]) - float(b[c])) for a, b in zip(*rows) for c in columns), default=0) / size
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--check", type=pathlib.Path)
    parser.add_argument("--close", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        work = options.keep or pathlib.Path(folder)
        work.mkdir(parents=True, exist_ok=True)
        runs = Runs(options.program, work)
        all_runs(runs)
        status = 0
        if options.close:
            for kept in sorted(options.close.glob("*/front.csv")):
                ours = runs.work / kept.parent.name / "front.csv"
                gap = difference(kept, ours) if ours.exists() else {"missing": 1}
                if max(gap.values()) > 1e-9:
                    status = 1
                print(kept.parent.name, {key: f"{value:.1e}" for key, value in gap.items()})
        if options.check:
            known = dict(line.split(maxsplit=1) for line in options.check.read_text().splitlines() if line and line[0] != "#")
            for name, *values in runs.rows:
                if known.get(name, "").strip() != " ".join(values):
                    print(f"differs: {name}: {known.get(name)} → {' '.join(values)}")
                    status = 1
        sys.exit(status)


if __name__ == "__main__":
    main()
