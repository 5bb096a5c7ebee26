#!/usr/bin/env python3
"""Compares two result files of conchoid_bench, or prints one as a table (Markdown).

    bench/compare.py OLD.json NEW.json
    bench/compare.py --table RESULT.json

Two files: per benchmark the least time in OLD and NEW [ms], NEW / OLD, and its ratio (slow way / fast path,
both timed in turns in the same run) in OLD and NEW. Times of different machines, or of one that was busy, say
little; the ratios are what counts.
"""
import argparse
import json
import os
import sys

OWN = {"fast_ms", "slow_ms", "ratio"}  # counters with a column of their own
STANDARD = {  # keys that every Google Benchmark result has
    "name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
    "repetition_index", "threads", "iterations", "real_time", "cpu_time", "time_unit", "label",
    "error_occurred", "error_message",
}


def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        sys.exit(f"compare.py: {path}: {error}; give a file that scripts/bench.sh wrote")


def short(name):
    """A name without the settings that Google Benchmark appends: 'grown_crack/cube/iterations:3/manual_time'."""
    return "/".join(part for part in name.split("/") if ":" not in part and part != "manual_time")


def benchmarks(result):
    return {short(b["name"]): b for b in result["benchmarks"] if b.get("run_type") == "iteration"}


def number(value):
    return "–" if value is None else f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"


def row(*cells):
    print("| " + " | ".join(cells) + " |")


def table(path):
    result = read(path)
    context = result["context"]
    load = ", ".join(f"{x:.2f}" for x in context.get("load_avg", []))
    print("# Benchmark results\n")
    print(f"`{os.path.basename(path)}`: {context.get('cores', context['num_cpus'])} cores, "
          f"{context.get('processor', 'processor unknown')}, {context['date'][:10]}. "
          f"c (bench/calibrate.cpp) {context.get('calibration', 'unknown')} s, load average (1, 5, 15 minutes) {load}, at the start. The machine is shared and noisy: "
          "times may be off by half, the ratio — slow way over fast path, timed in turns in the same run — is what "
          "counts. What is measured: [docs/benchmarks.md](../../docs/benchmarks.md).\n")
    row("benchmark", "fast [ms]", "slow [ms]", "ratio", "also")
    row("---", "--:", "--:", "--:", "---")
    for name, b in benchmarks(result).items():
        if b.get("error_occurred"):
            row(name, "", "", "", b["error_message"])
            continue
        more = [f"{k} {number(v)}" for k, v in b.items()
                if k not in OWN and k not in STANDARD and isinstance(v, (int, float))]
        more += [b["label"]] if b.get("label") else []
        row(name, *(number(b.get(k)) for k in ("fast_ms", "slow_ms", "ratio")), ", ".join(more))


def compare(old_path, new_path):
    old, new = benchmarks(read(old_path)), benchmarks(read(new_path))
    row("benchmark", "old [ms]", "new [ms]", "new / old", "old ratio", "new ratio")
    row("---", "--:", "--:", "--:", "--:", "--:")
    for name in [*old, *(n for n in new if n not in old)]:
        a, b = old.get(name, {}), new.get(name, {})
        times = a.get("fast_ms"), b.get("fast_ms")
        change = times[1] / times[0] if all(times) else None
        row(name, *(number(x) for x in (*times, change, a.get("ratio"), b.get("ratio"))))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true", help="print one file as a table")
    parser.add_argument("files", nargs="+", metavar="RESULT.json")
    arguments = parser.parse_args()
    if len(arguments.files) != (1 if arguments.table else 2):
        parser.error("give two result files, or --table and one")
    (table if arguments.table else compare)(*arguments.files)


if __name__ == "__main__":
    main()
