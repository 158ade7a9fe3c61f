#!/usr/bin/env python3
"""Speed of this project against its peers in one run: bench.py TARGET_FOLDER WORK_FOLDER [REPEATS] [N]

Prints medians of CPU seconds (the build alone) and their ratios to ours, then what tracing, checking and the exact kernel cost. Programs are
called in turn, so that a busy machine slows all of them alike. Only one core is used by each.
"""

import statistics
import subprocess
import sys
from pathlib import Path


def call(command):
    """Numbers that a program printed; None if it failed or is not there."""
    try:
        run = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=300)
    except (OSError, subprocess.TimeoutExpired) as error:
        print("  failed:", error)
        return None
    if run.returncode != 0:
        print("  failed:", " ".join(map(str, command)), run.stderr.strip()[-300:])
        return None
    return [float(w) for w in run.stdout.split()]


def child_seconds(command):
    """CPU seconds (user and system), peak memory in KiB and output of a command, as the kernel counts them."""
    run = subprocess.run(["/usr/bin/time", "-f", "%U %S %M", *map(str, command)], capture_output=True, text=True)
    user, system, memory = map(float, run.stderr.strip().splitlines()[-1].split())
    return user + system, memory, run


def programs(target):
    here = Path(__file__).parent
    return {
        "ours": [target / "release/examples/bench"],
        "CGAL": [target / "oracle/cgal-bench"],
        "spade": [target / "oracle/spade/release/spade-peer"],
        "Triangle": [sys.executable, here / "triangle_peer.py"],
    }


def compare(peers, title, arguments, repeats):
    samples = {name: [] for name in peers}
    for _ in range(repeats):
        for name, program in peers.items():
            numbers = call(program + arguments)
            if numbers:
                samples[name].append(numbers)
    ours = statistics.median(s[0] for s in samples["ours"])
    for name, rows in samples.items():
        if rows:
            seconds = statistics.median(r[0] for r in rows)
            print(f"{title:34} {name:9} {seconds:8.3f} s  {rows[0][1]:9.0f} vertices {rows[0][2]:9.0f} triangles  {seconds / ours:6.2f} x ours", flush=True)
    return samples["ours"]


def certificate(target, work, shape, area, repeats):
    """What tracing and the exact kernel cost, and verifying with the command line."""
    bench, trace = target / "release/examples/bench", work / "run.obt"
    plain = statistics.median(call([bench, "refine", shape, area, 30])[0] for _ in range(repeats))
    traced = [call([bench, "trace", shape, area, 30, trace]) for _ in range(repeats)]
    seconds, (_, _, triangles, steps, size) = statistics.median(t[0] for t in traced), traced[0]
    print(f"{shape}: refine {plain:.3f} s, with trace {seconds:.3f} s ({seconds / plain - 1:+.1%}), {steps:.0f} steps, {size / steps:.1f} bytes a step")
    _, memory, _ = child_seconds([bench, "refine", shape, area, 30])
    print(f"{shape}: peak memory {memory * 1024 / triangles:.0f} bytes a triangle")
    for options in [[], ["--strict"]]:
        used, memory, run = child_seconds([target / "release/orthoball", "verify", trace, *options])
        verdict = "accepted" if run.returncode == 0 else f"exit code {run.returncode}: {(run.stdout + run.stderr)[:200]}"
        print(f"{shape}: verify {' '.join(options) or 'plain':8} {used:.3f} s, {used / plain:.2f} x the mesher, {memory * 1024 / triangles:.0f} bytes a triangle, {verdict}")


def exact(target):
    rows = call([target / "release/examples/bench", "refine", "quad", 1.5e-4, 30, "exact"])
    if rows:
        print(f"exact kernel: {rows[0] / rows[3] * 1e6:.1f} us a step, {rows[1]:.0f} vertices")


def main():
    target, work = Path(sys.argv[1]), Path(sys.argv[2])
    repeats = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    n = int(sys.argv[4]) if len(sys.argv) > 4 else 1_000_000
    subprocess.run([sys.executable, Path(__file__).parent / "bench_inputs.py", work, str(n)], check=True)
    peers = programs(target)
    compare(peers, "Delaunay, uniform", ["delaunay", work / "uniform.f64"], repeats)
    compare(peers, "Delaunay, clustered", ["delaunay", work / "clustered.f64"], repeats)
    compare(peers, "constrained, N / 2 segments", ["constrained", work / "matched.f64", work / "matched.u32"], repeats)
    area = 1.45 / n
    for shape in ["quad", "square"]:
        compare(peers, f"refinement of the {shape}, 30 degrees", ["refine", shape, area, 30], repeats)
    for shape in ["quad", "square"]:
        certificate(target, work, shape, area, repeats)
    exact(target)


if __name__ == "__main__":
    main()
