#!/usr/bin/env python3
"""Where a run's processor time goes: shares of all threads together, by stage, one column per scene.

    scripts/time_by_stage.py build/conchoid NAME=SCENE.toml… [-- OPTION…]

Options after -- go to `conchoid run`. Needs perf (Debian: linux-perf) and the right to sample (kernel.perf_event_paranoid ≤ 2). A sample
counts for the first stage of the list that one of the functions on its stack belongs to.
"""
import argparse
import collections
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

STAGES = (
    ("integrals of pairs", r"PairIntegrator|far_(single|double)_layer|panel_(single|double)_layer|sum_(single|double)_layers|far_degrees"),
    ("body: assembled and factored", r"BodyOperator|make_body_solver|BodyEntries|choose_elements|LoadColumns"),
    ("rows of the crack, the rest", r"RowAssembler|stored_rows|PairBlocks"),
    ("factors and solutions", r"CrackSystem|BorderedCholesky|HalfSolver|CrackedBody|gemm|trsm|syrk"),
    ("predictions", r"OpeningByPredictor|FrontSurroundings|UncrackedStress"),
    ("openings, the rest", r"compute_openings|stress_intensities"),
    ("search for ligaments", r"find_last_ligaments|find_same_ligament|minimal_cut|CellGrid|sets_of_cells|nearly_through"),
    ("sheets unfolded", r"unfolded|self_intersections|embedded_part"),
    ("slits opened", r"open_slits|open_all|open_fragments|slit"),
    ("cracks cut to elements", r"update_crack"),
    ("cutting and gluing", r"cut_pieces|cut_piece|corefine|Corefinement|Gluer|remove_slivers|LigamentSurfaces|cut_ligament|cut_body|cut_into|retriang"),
    ("fronts", r"advance_fronts|FineFront|SweptSheets"),
    ("body: read, checked, remeshed", r"scene_body|body_from|read_ply|remesh|decimate|[Rr]emesher|EditableMesh|weld|ClosestPointTree"),
    ("pieces dressed", r"corner_normals|attributes|contacts|cut_into_pieces|end_body|Breakup"),
)
REST = "the rest"


def stage_of(stack):
    return next((name for name, pattern in STAGES if re.search(pattern, stack)), REST)


def shares(program, scene, options, folder):
    data = folder / "perf.data"
    record = subprocess.run(["perf", "record", "-q", "-F", "2000", "--call-graph", "dwarf,16384", "-o", data, program, "run", scene, "--quiet",
                             "--threads", "2", *options], capture_output=True, text=True)
    if record.returncode:
        raise SystemExit(f"{scene}: {record.stderr.strip()}")
    script = subprocess.Popen(["perf", "script", "-i", data, "--no-inline", "-F", "tid,ip,sym"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True)
    counts, stack = collections.Counter(), []
    for line in script.stdout:
        if line.strip():
            stack.append(line)
        elif stack:
            counts[stage_of("".join(stack[1:]))] += 1
            stack = []
    script.wait()
    return counts


def main():
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1:] if "--" in arguments else []
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scenes", nargs="+", metavar="NAME=SCENE.toml")
    parsed = parser.parse_args(arguments[:len(arguments) - len(options) - ("--" in arguments)])
    if not shutil.which("perf"):
        raise SystemExit("perf is not there; install linux-perf")
    columns = {}
    with tempfile.TemporaryDirectory() as folder:
        for scene in parsed.scenes:
            name, _, file = scene.partition("=")
            columns[name] = shares(parsed.program.resolve(), pathlib.Path(file).resolve(), options, pathlib.Path(folder))
    print("| % of processor time | " + " | ".join(columns) + " |")
    print("|---|" + "--:|" * len(columns))
    for stage in [name for name, _ in STAGES] + [REST]:
        print(f"| {stage} | " + " | ".join(f"{100 * c[stage] / sum(c.values()):.0f}" for c in columns.values()) + " |")


if __name__ == "__main__":
    main()
