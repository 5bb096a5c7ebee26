#!/usr/bin/env python3
"""What the program is to reach in speed, and what it reaches here: a table.

    bench/goals.py BUILD [--only WORD…] [--rounds N] [--scan FILE]

Times of runs are of whole processes with two threads and no output, the best of N, in units of c: the time of bench/calibrate.cpp,
taken right before each round. BUILD is a folder with conchoid, conchoid_bench and calibrate. Rows whose names contain none of the words are left out.
"""
import argparse
import json
import pathlib
import platform
import shutil
import statistics
import subprocess
import tempfile
import time

import curves

ROOT = pathlib.Path(__file__).resolve().parent.parent
THREE_POINT = """
[[boundary]]
region = "support-left"
displacement = ["free", "free", 0.0]
[[boundary]]
region = "support-right"
displacement = ["free", "free", 0.0]
[[boundary]]
region = "load"
force = [0.0, 0.0, -1.0e5]
"""


def example(name, **values):
    """An example with other values of some keys."""
    text = (ROOT / "examples" / f"{name}.toml").read_text()
    for key, value in values.items():
        lines = [f"{key} = {value}" if line.split("=")[0].strip() == key else line for line in text.splitlines()]
        text = "\n".join(lines) + "\n"
    return text


def armadillo(scan):
    return f"""[body]
mesh = "{scan}"
remesh = 1000
[material]
youngs_modulus = 3.1e9
poisson_ratio = 0.327
density = 1200
strength = 7.6e7
toughness = 1.0e6
[resolution]
crack = 3.0
surface = 0.2
[[region]]
name = "left"
half_spaces = [[0, 1, 0, 50], [1, 0, 0, 45]]
[[region]]
name = "right"
half_spaces = [[0, 1, 0, 50], [-1, 0, 0, 45]]
[[region]]
name = "feet"
half_spaces = [[0, -1, 0, 50]]
[[boundary]]
region = "left"
traction = [1.2e6, 0, 0]
[[boundary]]
region = "right"
traction = [-1.2e6, 0, 0]
[[boundary]]
region = "feet"
fixed = true
[run]
max_cracks = 1
after_separation = "stop"
"""


def seconds(command, folder):
    start = time.perf_counter()
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    taken = time.perf_counter() - start
    return (taken, done.stdout) if done.returncode == 0 else (None, done.stderr)


class Goals:
    def __init__(self, build, only, rounds, folder):
        self.conchoid, self.bench = build / "conchoid", build / "conchoid_bench"
        self.only, self.rounds, self.folder = only, rounds, folder
        self.calibration = build / "calibrate"
        self.c = self.unit()
        print(f"c = {self.c:.3f} s at the start, on {platform.processor() or platform.machine()}\n")
        print(f"{'what':44} {'goal':>12} {'reached':>12} {'ratio':>7}   remarks")

    def unit(self):
        return float(subprocess.run([self.calibration], capture_output=True, text=True, check=True).stdout.split()[0])

    def wanted(self, name):
        return not self.only or any(word in name for word in self.only)

    def row(self, name, goal, reached, unit, remark="", at_least=False):
        """`ratio`: 1 or less where the goal is reached."""
        ratio = "" if reached is None else f"{goal / reached if at_least else reached / goal:.2f}"
        shown = "failed" if reached is None else f"{reached:.3g} {unit}"
        print(f"{name:44} {f'{goal:.3g} {unit}':>12} {shown:>12} {ratio:>7}   {remark}", flush=True)

    def timed(self, name, goal, command, remark=lambda out: "", share=1.0):
        """A command in units of c; `share` of what the goal asks for is done."""
        if not self.wanted(name):
            return
        best, said = None, ""
        for _ in range(self.rounds):
            c = self.unit()
            taken, out = seconds(command, self.folder)
            if taken is None:
                return self.row(name, goal, None, "c", out.strip().splitlines()[-1:])
            if best is None or taken / c / share < best:
                best, said = taken / c / share, f"c {c:.3f} s; {remark(out)}"
        self.row(name, goal, best, "c", said)

    def run(self, name, goal, text, *more):
        scene = self.folder / f"{name.replace(' ', '-').replace(',', '')}.toml"
        scene.write_text(text)

        def remark(out):
            report = json.loads(out)
            return f"{report['frames']} frames, {report['stop']}, {len(report['fragments'])} pieces"

        self.timed(name, goal, [self.conchoid, "run", scene, "--json", "--quiet", "--threads", "2", *more], remark)

    def pairs(self):
        for case, name, goal in (("near", "near-singular pair", 60), ("common_vertex", "common vertex", 10),
                                 ("common_edge", "common edge", 8), ("coincident", "coincident pair", 3), ("far", "far pair", 1 / 12)):
            if not self.wanted(name):
                continue
            for pairs, said in ((case, "single layer, one core, to 1e-6"), (case + "_of_cracks", "to 1e-4, as with cracks")):
                self.row(name, goal, 1e6 / self.benchmarks(f"single_layer/{pairs}/")[0]["pairs_per_s"], "µs", said)

    def benchmarks(self, name):
        """What conchoid_bench says of the benchmarks of that name."""
        _, out = seconds([self.bench, f"--benchmark_filter={name}", "--benchmark_format=json"], self.folder)
        return json.loads(out)["benchmarks"]

    def training(self):
        for trees, depth, goal in ((50, 10, 25), (25, 15, 80)):
            name = f"training three forests ({trees}, {depth})"
            if self.wanted(name):
                c = self.unit()
                taken = self.benchmarks(f"training_on_a_million/{trees}/{depth}/")[0]["fast_ms"] / 1e3
                self.row(name, goal, taken / c, "c", f"c {c:.3f} s; a million samples, {taken:.1f} s")

    def scaling(self):
        """What cutting, growing and fronts cost for each thing that comes out or is new, and how that grows."""
        if self.wanted("cutting"):
            cut = self.benchmarks("fragments/256/")[0]
            self.row("cutting, a triangle that comes out", 1.5, cut["processor_us"], "µs", "all threads together")
            self.row("cutting, exponent of triangles", 1, cut["exponent"], "", "8,192 to 131,072 of the sheet")
        if self.wanted("growth"):
            for of_body in self.benchmarks("growth/"):
                self.row("growth, exponent of new × (body + crack)", 1, of_body["exponent"], "",
                         f"body of {of_body['body_nodes']:.0f} nodes, {of_body['functions']:.0f} functions in the end")
        if self.wanted("fronts"):
            long = self.benchmarks("front_length/2400/")[0]
            self.row("fronts, exponent of their length", 1, long["exponent"], "", f"to {long['front_nodes']:.0f} nodes")
            late = self.benchmarks("cracked_before/")[0]
            self.row("fronts, a node behind 40 frames over one now", 1, 1 / late["ratio"], "",
                     f"{late['fine_triangles'] / 1e6:.1f} million triangles swept")

    def sizes(self):
        """Predicted frames over the size of a body, as bench/curves.py."""
        of = curves.Curves(self.conchoid.parent, self.rounds, self.folder)
        for size, goal in ((1000, 3), (5000, 10)):
            name = f"predicted frames, {size:,} triangles"
            if self.wanted(name):
                solved, predicted = (frame for _, frame, _ in of.solved_and_predicted(size))
                self.row(name, goal, solved / predicted, "×", f"{1e3 * solved:.0f} ms a frame solved, {1e3 * predicted:.1f} predicted",
                         at_least=True)
        if self.wanted("memory"):
            (self.folder / "huge.toml").write_text(curves.SCENE.format(size=10000))
            took, memory = of.run("stress", "huge.toml")
            self.row("10,000 triangles, memory", 12, memory, "GB", f"set up in {took:.0f} s")

    def armadillo_frames(self, scene):
        """Predicted frames of the scan, all but the first, which is solved; those before the end search for what is left to break."""
        name = "armadillo, predicted frames"
        if not self.wanted(name):
            return
        (self.folder / "scan.toml").write_text(scene)
        least = None
        for _ in range(self.rounds):
            shutil.rmtree(self.folder / "scan", ignore_errors=True)
            seconds([self.conchoid, "run", "scan.toml", "--out", "scan", "--cache", "cache", "--quiet", "--threads", "2",
                     "--method", "network", "--database", "armadillo"], self.folder)
            timings = json.loads((self.folder / "scan/run.json").read_text())["timings"][1:]
            taken = [1e3 * sum(frame["seconds"].values()) for frame in timings]
            if least is None or sum(taken) < sum(least):
                least = taken
        self.row(name, 16, statistics.mean(least), "ms", "mean; each " + ", ".join(f"{t:.0f}" for t in least))

    def front_points(self):
        name = "prediction of 1,000 front points"
        for of_kind in self.benchmarks("kinds/") if self.wanted(name) else []:
            self.row(name, 1, of_kind["fast_ms"], "ms", of_kind["label"] + ", without its features")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--scan", type=pathlib.Path, default=ROOT.parent / "shared/models/armadillo.ply")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        goals = Goals(options.build.resolve(), options.only, options.rounds, folder)
        cube = example("cube", surface=0.005)
        goals.run("cube", 0.15, cube)
        goals.run("cube, steady", 0.08, cube, "--method", "steady")
        goals.run("edge crack", 0.25, example("edge-crack", crack=0.15, surface=0.003))
        if options.scan.exists():
            scene = armadillo(options.scan.resolve())
            goals.run("armadillo, cold", 0.9, scene)
            goals.run("armadillo, from the cache", 0.35, scene, "--cache", "cache")
            goals.armadillo_frames(scene)
        bar = example("bar", crack=0.004, surface=0.0002)
        goals.run("notched bar", 2, bar[:bar.index("[[boundary]]")] + THREE_POINT + "[run]\nframes = 20\n")
        goals.scaling()
        goals.pairs()
        (folder / "large.toml").write_text(example("cube").replace('model = "cube"', 'model = "cube"\nremesh = 5000'))
        goals.timed("5,000 triangles set up", 12, [goals.conchoid, "stress", "large.toml", "--json", "--quiet", "--threads", "2"])
        goals.sizes()
        spec = (ROOT / "examples/cube-database.toml").read_text()
        (folder / "spec.toml").write_text(spec)
        runs = 75
        if goals.wanted("database"):
            command = ["bash", "-c", f"rm -rf part.h5*; '{goals.conchoid}' database generate spec.toml --runs {runs} --out part.h5 "
                       "--quiet --json --threads 2"]
            goals.timed("database of 7,502 runs", 200, command, lambda out: f"from {runs} runs", share=runs / 7502)
        goals.training()
        goals.front_points()
        if goals.wanted("help"):
            best = min(seconds([goals.conchoid, "help"], folder)[0] for _ in range(20))
            goals.row("help", 10, 1e3 * best, "ms")


if __name__ == "__main__":
    main()
