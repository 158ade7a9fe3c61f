#!/usr/bin/env python3
"""Every real graph through mesh, verify and check; then sizes against Triangle: corpus.py ORTHOBALL DATA_FOLDER [table|sizes|both] [SUBSTRING]

Table: one line a file (only those whose name holds SUBSTRING, if given), min-angle 25. Exit code 1 if a mesh is not verified or does not pass
`check`, if a run was stopped or took 60 s with its verification, or if a refused input came without findings.
Sizes: triangles over Triangle's on the inputs without an angle below 60 degrees between two segments at a vertex (on either side, Triangle through its
wheel), as geometric means by promise level; a run that ends in anything but `complete`, or a peer that fails, is counted and left out.
"""

import json
import math
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict
from pathlib import Path

import corpora

HERE = Path(__file__).parent


def run(command, **options):
    start = time.perf_counter()
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    return done, time.perf_counter() - start


def answer(done):
    """The JSON object of a command; empty if there is none."""
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError:
        return {}


def examine(program, path, folder):
    """One line of the table and what is wrong with it."""
    trace, mesh = folder / "run.obt", folder / "mesh.node"
    made, mesh_seconds = run([program, "mesh", path, "--min-angle", "25", "--trace", trace, "-o", mesh, "--json"])
    told = answer(made)
    line = {"file": path.stem, "code": made.returncode, "outcome": told.get("outcome", "?"), "mesh s": mesh_seconds, "wrong": []}
    if made.returncode == 2:
        findings = [f for f in told.get("findings", []) if f.get("severity") == "error"]
        line["outcome"] = "refused"
        line["why"] = ", ".join(f"{n} {kind}" for kind, n in Counter(f.get("kind", "?") for f in findings).items())
        line["wrong"] += [] if findings else ["refused without findings: " + made.stderr[-200:]]
        return line
    if made.returncode not in (0, 1) or not told:
        line["wrong"].append(f"mesh: exit code {made.returncode} {made.stderr[-200:]}")
        return line
    verified, verify_seconds = run([program, "verify", trace, "--json"])
    checked, _ = run([program, "check", mesh, "--input", path, "--json"])
    line |= {
        "vertices": told["counts"]["vertices"],
        "triangles": told["counts"]["triangles"],
        "angle": told["quality"]["min_angle"],
        "unexcused": told["quality"].get("min_angle_unexcused"),
        "unmet": len(told["unmet"]),
        "level": told["level"],
        "verify s": verify_seconds,
        "verified": verified.returncode == 0,
        "checked": checked.returncode == 0,
    }
    if verified.returncode != 0:
        line["wrong"].append("verify: " + (verified.stdout + verified.stderr)[:300])
    if checked.returncode != 0:
        line["wrong"].append("check: " + (checked.stdout + checked.stderr)[:300])
    if mesh_seconds + verify_seconds >= 60:
        line["wrong"].append("took too long")
    return line


def print_line(line):
    if "triangles" not in line:
        print(f"{line['file'][:52]:52} {'':42} {line['outcome']:9} {line['mesh s']:7.2f}  {line.get('why', '')}", flush=True)
    else:
        marks = ("verified" if line["verified"] else "REJECTED") + (" checked" if line["checked"] else " CHECK FAILED")
        print(
            f"{line['file'][:52]:52} {line['vertices']:8} {line['triangles']:8} {line['angle']:6.2f} {line['unmet']:6} {line['level']:10} "
            f"{line['outcome']:9} {line['mesh s']:7.2f} {line['verify s']:7.2f} {marks}",
            flush=True,
        )
    for wrong in line["wrong"]:
        print("    WRONG:", wrong, flush=True)


def table(program, files):
    print(f"{'file':52} {'vertices':>8} {'triangl.':>8} {'angle':>6} {'unmet':>6} {'level':10} {'outcome':9} {'mesh s':>7} {'verify s':>7}")
    lines = []
    for path in files:
        with tempfile.TemporaryDirectory() as folder:
            lines.append(examine(program, path, Path(folder)))
        print_line(lines[-1])
    meshed = [line for line in lines if "triangles" in line]
    outcomes = ", ".join(f"{n} {outcome}" for outcome, n in sorted(Counter(line["outcome"] for line in lines).items()))
    print(f"total: {len(lines)} files, {len(meshed)} meshed, {outcomes}; {sum(line['verified'] for line in meshed)} verified, {sum(line['checked'] for line in meshed)} checked")
    if meshed:
        longest = max(meshed, key=lambda line: line["mesh s"] + line["verify s"])
        triangles = sum(line["triangles"] for line in meshed)
        seconds = [sum(line[key] for line in meshed) for key in ("mesh s", "verify s")]
        print(f"{triangles} triangles in {seconds[0]:.1f} s, verified in {seconds[1]:.1f} s; longest {longest['file']}: {longest['mesh s'] + longest['verify s']:.1f} s")
    return not any(line["wrong"] or line["outcome"] == "stopped" for line in lines)


def smallest_angle(points, segments):
    """Between two segments at a vertex, degrees."""
    directions = defaultdict(set)
    for u, v in segments:
        for a, b in ((u, v), (v, u)):
            directions[a].add(math.atan2(float(points[b][1]) - float(points[a][1]), float(points[b][0]) - float(points[a][0])))
    smallest = 360.0
    for angles in map(sorted, directions.values()):
        turns = [b - a for a, b in zip(angles, angles[1:] + [angles[0] + 2 * math.pi])]
        smallest = min([smallest] + [math.degrees(t) for t in turns if len(angles) > 1])
    return smallest


def triangle_count(path, degrees):
    """Triangles of Triangle's mesh; None if it failed."""
    stream, _ = run([sys.executable, HERE / "corpora.py", "poly-once", path])
    try:
        done, _ = run([sys.executable, HERE / "triangle_peer.py", "mesh", degrees, 0, 1000000], input=stream.stdout, timeout=60)
    except subprocess.TimeoutExpired:
        return None
    words = done.stdout.split()
    return int(words[3]) if len(words) > 4 and words[1] == "1" else None


def sizes(program, files):
    wide = []
    for path in files:
        points, segments, _ = corpora.read_poly(path)
        points, segments = corpora.merged(points, segments)
        if segments and smallest_angle(points, segments) >= 60 - 1e-9:
            wide.append(path)
    print(f"sizes: {len(wide)} inputs without angles below 60 degrees")
    for degrees in (20, 25, 30):
        theirs = {path: triangle_count(path, degrees) for path in wide}
        failed = ", ".join(path.stem for path in wide if theirs[path] is None)
        if failed:
            print(f"{degrees:3} degrees: Triangle failed on {failed}")
        for name, options in {"defaults": [], "admissible": ["--promise", "admissible"], "graded": ["--promise", "graded"]}.items():
            logs, left_out = [], Counter()
            for path in wide:
                done, _ = run([program, "mesh", path, "--min-angle", degrees, "--json", *options])
                told = answer(done)
                if theirs[path] is None:
                    left_out["Triangle failed"] += 1
                elif told.get("outcome") != "complete":
                    left_out[told.get("outcome", f"exit code {done.returncode}")] += 1
                else:
                    logs.append((math.log(told["counts"]["triangles"] / theirs[path]), path.stem))
            mean = f"{math.exp(sum(x for x, _ in logs) / len(logs)):.4f} x Triangle, largest {math.exp(max(logs)[0]):.2f} ({max(logs)[1]})" if logs else "none"
            print(f"{degrees:3} degrees {name:11} {len(logs):3} inputs: {mean}; left out: {dict(left_out)}", flush=True)


def main():
    program, data, *rest = sys.argv[1:]
    what, part = (rest + ["both", ""][len(rest) :])[:2]
    files = [p for p in sorted(Path(data, "pslg/as_poly").glob("*.poly")) if part in p.stem]
    good = True
    if what in ("table", "both"):
        good = table(program, files)
    if what in ("sizes", "both"):
        sizes(program, files)
    sys.exit(not good or not files)


if __name__ == "__main__":
    main()
