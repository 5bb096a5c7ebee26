#!/usr/bin/env python3
"""Whole runs of bodies of classes that a regressor has seen in training, and of classes that it has not; writes the tables of docs/prediction.md.

  scripts/study_transfer.py CONCHOID WORK [--runs 30] [--only NAMES] [--studies NAMES] [--armadillo tests/data/armadillo.ply]

WORK holds world.h5, cube.h5, cylinder.h5, bar.h5, world-unseen.h5 (scripts/make_databases.sh) and keeps regressors and results. For every class: a specification with
another seed (fresh bodies, fresh loads), solved by boundary elements, by steady, kept and stress, by a forest, boosted trees and a network of all classes, by such trained
without the class (and without its like: box and cube, rod and bar), and for cube, cylinder and bar by their own database; solved under small changes
of the scene, and hybrid; and once more under 2.5 times the load. The study `own` is of bodies by databases of nothing else, under loads that these have not
seen, by networks and boosted trees; WORK then needs plate.network and plate.boosted, of databases/plate.toml and trained as scripts/make_databases.sh trains those
of one body. `worst` draws the runs of whole-runs that the network without the class is farthest off on, into WORK/worst. `ablation` trains on world.h5 alone, without three classes, boosted
trees that look at everything, at everything but one thing, at fewer runs, and other kinds of regressors, and compares their whole runs.
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
MODELS = {"forest": ["--trees", "12", "--depth", "18", "--leaf", "8"],
          "boosted": ["--model", "boosted", "--trees", "300", "--depth", "6", "--rate", "0.07"],
          "network": ["--model", "network"]}
# What boosted trees and others are trained without, or on (forest train's options), on the world alone.
BOOSTED = MODELS["boosted"]
WITHIN = "traction*,lateral*,stress_growth,S/(S+stress),pull*"
NET = "net*,taken*,force*,lever*,arms_growth,S/(S+arms)"
BESIDE = "across*,ahead_across*,behind_across*,along*"
AHEAD = "ahead,ahead_after,wall*,ligament_share"
AROUND = "nearby*,front_*,slope*"
TURN = "turn*,kinked*"
CRACK = "curvature*,r_bar/crack_radius"
ABLATION = {"everything": BOOSTED,
            "no stress of the uncracked body": [*BOOSTED, "--hide", WITHIN],
            "no net section": [*BOOSTED, "--hide", NET],
            "neither": [*BOOSTED, "--hide", f"{WITHIN},{NET}"],
            "no walls beside": [*BOOSTED, "--hide", BESIDE],
            "no distances ahead, no ligament": [*BOOSTED, "--hide", AHEAD],
            "no walls at all": [*BOOSTED, "--hide", f"{BESIDE},{AHEAD}"],
            "no neighbours on the front": [*BOOSTED, "--hide", AROUND],
            "no turn": [*BOOSTED, "--hide", TURN],
            "no size and curvature of the crack": [*BOOSTED, "--hide", CRACK],
            "K at the point alone": [*BOOSTED, "--hide", ",".join([WITHIN, NET, BESIDE, AHEAD, AROUND, TURN, CRACK])],
            "no end game": [*BOOSTED, "--no-end-game"],
            "half of the runs": [*BOOSTED, "--hold-out", "0.5"],
            "a quarter": [*BOOSTED, "--hold-out", "0.75"],
            "an eighth": [*BOOSTED, "--hold-out", "0.875"],
            "boosted, 150 of depth 4": ["--model", "boosted", "--trees", "150", "--depth", "4", "--rate", "0.14"],
            "forest, 12 of depth 18, leaves of 8": MODELS["forest"],
            "forest (50, 10)": ["--trees", "50", "--depth", "10"],
            "forest (25, 15)": ["--trees", "25", "--depth", "15"],
            "ridge, squares and products": ["--model", "ridge", "--degree", "2"],
            "network": MODELS["network"]}
ABLATION_LEFT_OUT = ["box", "cylinder", "cup"]  # of the classes of the world, all at once
STUDIES = ["whole-runs", "load", "noise", "own", "worst", "ablation"]
WORST = 10
# Bodies by their own databases: its name, what differs from its specification, the first run that it has not seen (of the plate the
# seed stays: another would be another plate).
OWN = {"cube": ("cube", {}, 0), "cylinder": ("cylinder", {}, 0), "bar": ("bar", {}, 0),
       "edge crack I": ("edge-crack", {"slope": "[0.0, 20.0]"}, 0),
       "edge crack II": ("edge-crack", {"direction": "[1.0, 0.0, 0.0]", "slope": "[0.0, 20.0]"}, 0),
       "edge crack III": ("edge-crack", {"direction": "[0.0, 1.0, 0.0]", "slope": "[0.0, 20.0]"}, 0),
       "plate": ("plate", {"seed": "8"}, 960), "armadillo": ("armadillo", {}, 0),
       "cube layers": ("cube-layers", {}, 0), "cube grains": ("cube-grains", {}, 0),
       "cylinder layers": ("cylinder-layers", {}, 0), "cylinder grains": ("cylinder-grains", {}, 0)}
OWN_KINDS = ["network", "boosted"]  # the first in full
CLOSED = ["steady", "kept", "stress"]
TOLERANCES = ["0.005", "0.01"]  # of hybrid runs
LOAD = 2.5


def shipped_specification(name, runs, changes):
    """A specification of databases/ with other values and loads; new keys come last, into [database]."""
    changes, lines = {"runs": str(runs), "seed": "2024", **changes}, []
    for line in (ROOT / "databases" / f"{name}.toml").read_text().splitlines():
        key = line.split(" = ")[0]
        if key in changes:
            line = f"{key} = {changes.pop(key)}"
        elif key == "mesh":  # from the folder of the specification
            line = f'mesh = "{(ROOT / "databases" / line.split(chr(34))[1]).resolve()}"'
        lines.append(line)
    return "\n".join(lines + [f"{k} = {v}" for k, v in changes.items()]) + "\n"


def call(program, *arguments):
    done = subprocess.run([program, *map(str, arguments), "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def specification(name, runs, armadillo):
    if name == "armadillo":
        return shipped_specification(name, runs, {"mesh": f'"{armadillo}"'})
    if name in ("cube", "cylinder model", "bar"):
        return shipped_specification(name.split()[0], runs, {})
    return f'[world]\nclasses = ["{name}"]\nruns_per_body = 1\nelements = 150\n[database]\nruns = {runs}\nseed = 2024\nframes = 31\n'


def regressors(program, work, title, kinds, without=()):
    """One file for each kind of model: TITLE.forest and so on; calibrated as those that ship, on the same classes."""
    files = []
    for kind in kinds:
        files.append(work / f"{title}.{kind}")
        if not files[-1].exists():
            databases = [work / f"{name}.h5" for name in ("world", "cube", "cylinder", "bar")]
            stated = work / f"{title}.{kind}-as-stated"
            leave_out = lambda classes: ["--without", ",".join(classes)] if classes else []
            call(program, "forest", "train", *[d for d in databases if d.exists()], "--features", "versatile", *MODELS[kind], *leave_out(without),
                 "--out", stated)
            call(program, "forest", "calibrate", stated, work / "world-unseen.h5", *leave_out([c for c in without if c in WORLD]),
                 "--out", files[-1])
    return files


def result_of(program, work, name, study, runs, armadillo, files, *options):
    return result_of_text(program, work, name, study, runs, specification(name, runs, armadillo), files, *options)


def own_result(program, work, name, runs):
    """As result_of(), by the database of the body alone."""
    database, changes, first = OWN[name]
    text = shipped_specification(database, first + runs, changes)
    body = database.removesuffix("-layers").removesuffix("-grains")
    folder = work if body == "plate" else ROOT / "databases"
    files = [folder / f"{body}.{kind}" for kind in OWN_KINDS]
    return result_of_text(program, work, name, "own", runs, text, files, "--first", first, "--tolerance", TOLERANCES[-1])


def specification_file(work, name, study, runs):
    return work / f"{study}-{name.replace(' ', '-')}-{runs}.toml"


def result_of_text(program, work, name, study, runs, text, files, *options):
    spec = specification_file(work, name, study, runs)
    result = spec.with_suffix(".json")
    if not (result.exists() and spec.exists() and spec.read_text() == text):  # another scan is another body
        spec.write_text(text)
        result.unlink(missing_ok=True)
        result.write_text(call(program, "forest", "evaluate", files[0], "--runs", spec, "--json", *options,
                               *(["--beside", ",".join(map(str, files[1:]))] if files[1:] else [])))
    return json.loads(result.read_text())


def files_for(program, work, name, kinds=tuple(MODELS)):
    files = regressors(program, work, "all", kinds)
    if name != "armadillo":
        like = LIKE.get(name, [name.split()[0]])
        files += regressors(program, work, "without-" + "-".join(like), kinds, like)
    if name in ("cube", "cylinder model", "bar"):
        files.append(ROOT / "databases" / f"{name.split()[0]}.{OWN_KINDS[0]}")
    return files


def role_of(method, name):
    """The column: steady, kept, stress; of regressors all, without, own, with their kind; hybrid runs and small changes. The Armadillo is
    in no training."""
    regressor, hybrid, tolerance = method.partition(", hybrid ")
    title, kind = regressor.rsplit(".", 1) if regressor.endswith(tuple("." + k for k in MODELS)) else (regressor, "")
    if title.startswith("without") or (name == "armadillo" and title == "all"):
        title = "left out"
    elif title in (name.split()[0], OWN.get(name, [""])[0]):
        title = "own"
    return title + (" " + kind if kind else "") + hybrid + tolerance


def quantile(ordered, share):
    return ordered[int(share * (len(ordered) - 1))]


def cell(score):
    if not score:
        return ""
    text = f"{100 * score['surface_median']:.2f}, {100 * score['surface_largest']:.1f}; {score['frames_ratio']:.2f}"
    return text + (f" ({score['lost']})" if score["lost"] else "")


def table(results, columns):
    print("| class | runs | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 2) + "|")
    pooled, seconds = {}, {}
    for name, result in results:
        scores = {role_of(s["method"], name): s for s in result["scores"] if s["class"]}
        for r in result["runs"]:
            role = role_of(r["method"], name)
            pooled.setdefault(role, {})[name, r["run"]] = r["surface_mean"]
            seconds.setdefault(role, []).append(r["opening_seconds"])
        print(f"| {name} | {max((s['runs'] for s in scores.values()), default=0)} | " + " | ".join(cell(scores.get(c)) for c in columns) + " |")
    against = next((f"left out {kind}" for kind in reversed(MODELS) if f"left out {kind}" in pooled), None)
    print("\n| all runs together | runs | median | 90 % | largest | openings over those solved | left out is nearer in |\n|---|---|---|---|---|---|---|")
    for role, runs in pooled.items():
        values, both = sorted(runs.values()), [k for k in runs if against and k in pooled[against]]
        solved, made = (sum(s) for s in zip(*seconds[role]))
        print(f"| {role} | {len(values)} | {100 * statistics.median(values):.2f} | {100 * quantile(values, 0.9):.1f} | "
              f"{100 * values[-1]:.1f} | {made / solved:.2f} | {sum(pooled[against][k] < runs[k] for k in both)} of {len(both)} |")
    print(flush=True)


def own_table(results):
    """Of each body: the closed forms' medians, then what its own database is off by, and hybrid runs with it."""
    first, hybrid = "own " + OWN_KINDS[0], f"own {OWN_KINDS[0]}, hybrid {TOLERANCES[-1]}"
    others = [f"own {kind}" for kind in OWN_KINDS[1:]]
    columns = ["body", "runs", "steady, kept, stress", *(f"{o[4:]}: median, 95 %, largest" for o in others), f"{OWN_KINDS[0]}: median", "95 %",
               "largest", "frames within one", "at the frame limit", "openings", f"hybrid {TOLERANCES[-1]}: median, 95 %, largest", "openings"]
    print("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")
    for name, result in results:
        runs = {}
        for r in result["runs"]:
            runs.setdefault(role_of(r["method"], name), []).append(r)
        if not runs:
            print(f"| {name} | 0 " + "|  " * (len(columns) - 2) + "|")
            continue

        def spread(role):
            off = sorted(100 * r["surface_mean"] for r in runs[role])
            solved, made = (sum(s) for s in zip(*(r["opening_seconds"] for r in runs[role])))
            return [f"{statistics.median(off):.2f}", f"{quantile(off, 0.95):.2f}", f"{off[-1]:.1f}"], f"{made / solved:.2f}"

        (own, openings), (with_hybrid, with_solved) = spread(first), spread(hybrid)
        near = sum(abs(r["frames"][0] - r["frames"][1]) <= 1 for r in runs[first])
        lost = sum(r["stop"] == "frame-limit" != r["solved_stop"] for r in runs[first])
        row = [name, len(runs[first]), ", ".join(f"{100 * statistics.median(r['surface_mean'] for r in runs[c]):.2f}" for c in CLOSED),
               *(", ".join(spread(o)[0]) for o in others), *own, f"{near} of {len(runs[first])}", lost, openings, ", ".join(with_hybrid), with_solved]
        print("| " + " | ".join(map(str, row)) + " |", flush=True)
    print(flush=True)


def ablation_tables(program, work, runs, armadillo):
    """Of each variant: whole runs on fresh bodies of classes in training, and of those left out; and what one step says of it."""
    files = []
    for k, options in enumerate(ABLATION.values()):
        files.append(work / f"ablation-{k}.model")
        if not files[-1].exists():
            call(program, "forest", "train", work / "world.h5", "--features", "versatile", "--without", ",".join(ABLATION_LEFT_OUT), *options,
                 "--out", files[-1])
            print("trained:", list(ABLATION)[k], file=sys.stderr, flush=True)
    results = {name: result_of(program, work, name, "ablation", runs, armadillo, files) for name in WORLD}
    groups = [[n for n in WORLD if n not in ABLATION_LEFT_OUT], ABLATION_LEFT_OUT]
    columns = ["trained", "samples", "classes in training: median, 90 %", "frames", "left out: median, 90 %", "frames",
               *(f"{n} (left out)" for n in ABLATION_LEFT_OUT)]
    print("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")
    for title, method in [("`steady`", "steady"), ("`kept`", "kept"), ("`stress`", "stress"), *((t, f.name) for t, f in zip(ABLATION, files))]:
        row = [title]
        row.append(json.loads(call(program, "forest", "info", work / method, "--json"))["samples"] if method.endswith(".model") else "")
        for group in [*groups, *([n] for n in ABLATION_LEFT_OUT)]:
            of_group = [r for name in group for r in results[name]["runs"] if r["method"] == method]
            off = sorted(100 * r["surface_mean"] for r in of_group)
            row.append(f"{statistics.median(off):.2f}" + (f", {quantile(off, 0.9):.1f}" if len(group) > 1 else ""))
            if len(group) > 1:
                row.append(f"{statistics.median(r['frames'][1] / r['frames'][0] for r in of_group):.2f}")
        print("| " + " | ".join(map(str, row)) + " |", flush=True)
    counts = [len({(name, r["run"]) for name in group for r in results[name]["runs"]}) for group in groups]
    print(f"\n{counts[0]} and {counts[1]} runs.\n", flush=True)


def draw_worst(program, work, runs, results, role, files):
    """Pictures of the runs of all classes together that a regressor is farthest off on, solved beside predicted, and a list of them."""
    rows = [(r, name) for name, result in results for r in result["runs"] if role_of(r["method"], name) == role]
    rows.sort(key=lambda row: -row[0]["surface_mean"])
    print(f"| class | run | off, % | {role}: frames, stop | solved: frames, stop |\n|---|---|---|---|---|")
    for r, name in rows[:WORST]:
        spec = specification_file(work, name, "whole-runs", runs)
        call(program, "forest", "evaluate", next(f for f in files(name) if f.name == r["method"]), "--runs", spec, "--first", r["run"],
             "--count", 1, "--pictures", work / "worst" / name.replace(" ", "-"))
        solved, made = r["frames"]
        print(f"| {name} | {r['run']} | {100 * r['surface_mean']:.1f} | {made}, {r['stop']} | {solved}, {r['solved_stop']} |", flush=True)
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=30)
    parser.add_argument("--only", default="")
    parser.add_argument("--studies", default=",".join(STUDIES), help="with commas between")
    parser.add_argument("--armadillo", default=str(ROOT / "tests/data/armadillo.ply"))
    a = parser.parse_args()
    names = a.only.split(",") if a.only else ["cube", "cylinder model", "bar", *WORLD, "armadillo"]
    run = lambda study, count, files, *options: [
        (name, result_of(a.program, a.work, name, study, count, a.armadillo, files(name), *options)) for name in names]
    files = lambda name: files_for(a.program, a.work, name)
    learned = [f"{where} {kind}" for where in ("all", "left out") for kind in MODELS] + ["own " + OWN_KINDS[0]]
    studies = a.studies.split(",")
    if unknown := set(studies) - set(STUDIES):
        sys.exit(f"--studies {', '.join(sorted(unknown))}: not known; use some of {', '.join(STUDIES)}")
    few = (a.runs + 1) // 2
    if "whole-runs" in studies:
        print("Whole runs\n")
        table(run("whole-runs", a.runs, files), CLOSED + learned)
    if "worst" in studies:
        print("The farthest off\n")
        draw_worst(a.program, a.work, a.runs, run("whole-runs", a.runs, files), "left out network", files)
    if "own" in studies:
        print("By their own databases, loads not seen\n")
        chosen = [n for n in a.only.split(",") if n in OWN] if a.only else OWN
        own_table([(n, own_result(a.program, a.work, n, 2 * a.runs)) for n in chosen])
    if "ablation" in studies:
        print("What each thing brings: trained on the world without " + ", ".join(ABLATION_LEFT_OUT) + "\n")
        ablation_tables(a.program, a.work, few, a.armadillo)
    if "load" in studies:
        print(f"Load x {LOAD}\n")
        table(run("load", few, files, "--load", LOAD), CLOSED + learned)
    if "noise" in studies:
        print("Small changes of what is solved, and hybrid runs with a network that the class is left out of\n")
        left_out = lambda name: [f for f in files_for(a.program, a.work, name, ["network"]) if f.parent == a.work][-1:]
        changes = ["load + 0.5 %", "load turned 0.5 deg", "edge + 10 %", "elements + 10 %"]
        table(run("noise", few, left_out, "--noise-floor", "--tolerance", ",".join(TOLERANCES)),
              [f"solved, {c}" for c in changes] + ["left out network"] + [f"left out network, hybrid {t}" for t in TOLERANCES])


if __name__ == "__main__":
    main()
