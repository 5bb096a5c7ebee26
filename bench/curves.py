#!/usr/bin/env python3
"""Boundary elements and prediction over the size of a body: set-up, time per frame, memory. A table, and a picture.

    bench/curves.py BUILD [--sizes N…] [--table FILE] [--picture FILE] [--rounds N]

The unit cube remeshed to N triangles, r̄ = 0.1, pulled askew (inertia relief), with a crack in its side that divides it; two threads, least of
`--rounds`. Set-up is what a run needs before its first frame: the time of `conchoid stress` on the same scene without the crack. A frame is
what is left of a run over its frames, and the opening's part of it; predicted runs solve their first frame, so theirs are means without it. c is the time of bench/calibrate.cpp, taken before each size.
The picture needs python3-matplotlib.
"""
import argparse
import json
import os
import pathlib
import platform
import shutil
import subprocess
import tempfile
import time

SCENE = """[body]
model = "cube"
remesh = {size}
[material]
youngs_modulus = 3.1e9
poisson_ratio = 0.327
density = 1200.0
strength = 7.6e7
toughness = 1.0e6
[resolution]
crack = 0.1
surface = 0.01
[[boundary]]
region = "z+"
traction = [3.0e6, 1.0e6, 9.0e6]
[[boundary]]
region = "z-"
traction = [-3.0e6, -1.0e6, -9.0e6]
[run]
max_cracks = 0
inertia_relief = true
after_separation = "stop"
"""
CRACK = """[[crack]]
kind = "disc"
center = [0.5, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
radius = 0.25
"""
COLUMNS = ("triangles", "c [s]", "set-up [s]", "GB", "BEM frames", "a frame [s]", "of it opening", "predicted frames", "a frame [s]", "of it opening",
           "BEM over predicted")


def measured(command, folder):
    """(seconds, peak memory [GB]) of a process."""
    start = time.perf_counter()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"{' '.join(map(str, command))}: {said.strip()}")
    return time.perf_counter() - start, usage.ru_maxrss / 1e6


class Curves:
    def __init__(self, build, rounds, folder):
        self.conchoid, self.calibration = build / "conchoid", build / "calibrate"
        self.rounds, self.folder = rounds, folder

    def run(self, *arguments):
        return measured([self.conchoid, *arguments, "--quiet", "--threads", "2"], self.folder)

    def frames(self, method, *more):
        """(number of frames, seconds of a frame, of it its opening); of predicted runs without the first."""
        best = None
        for _ in range(self.rounds):
            shutil.rmtree(self.folder / "run", ignore_errors=True)
            self.run("run", "scene.toml", "--out", "run", "--method", method, *more)
            timings = json.loads((self.folder / "run/run.json").read_text())["timings"]
            shown = timings[0 if method == "bem" else 1:]
            if not shown:
                raise SystemExit(f"{method}: the run ends after {len(timings)} frames, so none is predicted; take another load or another size")
            opening = sum(f["seconds"]["opening"] for f in shown) / len(shown)
            rest = sum(f["seconds"]["fracture"] + f["seconds"]["other"] for f in shown) / len(shown)
            if best is None or opening + rest < best[1]:
                best = (len(timings), opening + rest, opening)
        return best

    def solved_and_predicted(self, size):
        """frames() of both."""
        (self.folder / "scene.toml").write_text(SCENE.format(size=size) + CRACK)
        return self.frames("bem"), self.frames("forest", "--database", "versatile")

    def row(self, size):
        (self.folder / "whole.toml").write_text(SCENE.format(size=size))
        c = float(subprocess.run([self.calibration], capture_output=True, text=True, check=True).stdout.split()[0])
        setup, memory = min(self.run("stress", "whole.toml") for _ in range(self.rounds))
        solved, predicted = self.solved_and_predicted(size)
        return {"triangles": size, "c": c, "setup": setup, "memory": memory, "solved": solved, "predicted": predicted}


def table(rows):
    lines = ["| " + " | ".join(COLUMNS) + " |", "|---" * len(COLUMNS) + "|"]
    for r in rows:
        s, p = r["solved"], r["predicted"]
        cells = [f"{r['triangles']:,}", f"{r['c']:.2f}", f"{r['setup']:.3g}", f"{r['memory']:.2f}", s[0], f"{s[1]:.3g}", f"{s[2]:.3g}", p[0],
                 f"{p[1]:.3g}", f"{p[2]:.2g}", f"{s[1] / p[1]:.1f} ({s[2] / p[2]:.0f})"]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines)


def picture(rows, path):
    import matplotlib
    matplotlib.use("svg" if path.suffix == ".svg" else "agg")
    from matplotlib import pyplot
    figure, (times, memory) = pyplot.subplots(1, 2, figsize=(10, 4))
    sizes = [r["triangles"] for r in rows]
    times.loglog(sizes, [r["setup"] for r in rows], "k-s", label="set-up")
    for method, name, colour in (("solved", "boundary elements", "C0"), ("predicted", "predicted", "C1")):
        times.loglog(sizes, [r[method][1] for r in rows], colour + "-o", label=f"a frame, {name}")
        times.loglog(sizes, [r[method][2] for r in rows], colour + "--o", label="of it opening")
    times.set(xlabel="triangles of the body", ylabel="s")
    times.legend()
    memory.loglog(sizes, [r["memory"] for r in rows], "k-s")
    memory.set(xlabel="triangles of the body", ylabel="peak memory of the set-up [GB]")
    for axes in (times, memory):
        axes.grid(True, which="both", alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--sizes", type=int, nargs="+", default=[250, 500, 1000, 2000, 5000, 10000])
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--picture", type=pathlib.Path)
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        curves = Curves(options.build.resolve(), options.rounds, pathlib.Path(folder))
        for size in options.sizes:
            rows.append(curves.row(size))
            print(json.dumps(rows[-1]), flush=True)
    text = table(rows)
    print(text)
    if options.table:
        options.table.write_text(f"# Over the size of a body\n\n`bench/curves.py` on {platform.processor() or platform.machine()}, "
                                 f"{os.cpu_count()} cores, least of {options.rounds}.\n\n{text}\n")
    if options.picture:
        picture(rows, options.picture)


if __name__ == "__main__":
    main()
