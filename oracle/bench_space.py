#!/usr/bin/env python3
"""Speed in space against CGAL in one run: bench_space.py TARGET_FOLDER WORK_FOLDER [REPEATS] [N] [PARTS]

Prints medians of CPU seconds (the job alone) and our time over CGAL's: CGAL 5.5, EPICK, spatial sort, -O2. Programs are called in turn, so that
a busy machine slows both alike; each uses one core but in the part `threads`. PARTS: words out of build, memory, removal, growth, threads, valid, check,
trace (default: all).
"""

import statistics
import subprocess
import sys
from pathlib import Path

from bench import call, child_seconds

SETS = ["uniform", "sphere", "clustered", "weighted", "grid", "shuffled"]


class Bench:
    def __init__(self, target, work, repeats, n):
        self.work, self.repeats, self.n = work, repeats, n
        self.ours, self.cgal = target / "release/examples/bench_space", target / "oracle/cgal-space_bench"
        self.binary = target / "release/orthoball"

    def points(self, name):
        return self.work / f"{name}.f64"

    def medians(self, *commands):
        """Runs the commands in turn, several times; medians of the seconds, and the first rows."""
        samples = [[] for _ in commands]
        for _ in range(self.repeats):
            for command, rows in zip(commands, samples):
                numbers = call(command)
                if numbers:
                    rows.append(numbers)
        return [(statistics.median(r[0] for r in rows), rows[0]) if rows else None for rows in samples]

    def ratio(self, title, ours, peer, per):
        if not ours or not peer:
            print(f"{title:34} not measured", flush=True)
            return
        (a, row), (b, _) = ours, peer
        print(f"{title:34} {a:8.3f} s  CGAL {b:8.3f} s  ratio {a / b:5.2f}  ({a / per * 1e6:.2f} us each)  {row[1]:.0f} vertices, {row[2]:.0f} cells", flush=True)

    def build(self):
        for name in SETS:
            ours, peer = self.medians([self.ours, "build", self.points(name)], [self.cgal, "build", self.points(name)])
            self.ratio(f"build, {name}", ours, peer, self.n)

    def memory(self):
        for name in SETS[:5]:
            rows = [call([program, "build", self.points(name)]) for program in (self.ours, self.cgal)]
            if all(rows):
                a, b = (row[3] / row[1] for row in rows)
                print(f"memory, {name:26} {a:8.0f} bytes a vertex at the peak, CGAL {b:.0f}", flush=True)

    def removal(self):
        count = self.n // 20
        for name in SETS[:5]:
            path = self.points(f"small_{name}")
            ours, peer = self.medians([self.ours, "remove", path, count], [self.cgal, "remove", path, count])
            self.ratio(f"removal of half, {name}", ours, peer, count)

    def growth(self):
        n = 10_000
        while n <= 3 * self.n:
            arguments = ["build", self.points("growth"), 1, n]
            ours, peer = self.medians([self.ours, *arguments], [self.cgal, *arguments])
            self.ratio(f"growth, {n} uniform points", ours, peer, n)
            n = n * 3 if str(n)[0] == "1" else n // 3 * 10

    def threads(self):
        for name in ["uniform", "weighted"]:
            rows = self.medians(*([self.ours, "build-wall", self.points(name), t] for t in (1, 2, 4)))
            if all(rows):
                walls = [seconds for seconds, _ in rows]
                text = ", ".join(f"{t} threads {w:.3f} s ({walls[0] / w:.2f} x)" for t, w in zip((1, 2, 4), walls))
                print(f"wall, {name:28} {text}", flush=True)

    def valid(self):
        (peer,) = self.medians([self.cgal, "valid", self.points("small_uniform")])
        if peer:
            print(f"CGAL is_valid, {peer[1][1]:.0f} points           {peer[0]:8.3f} s, {peer[0] / peer[1][1] * 1e6:.2f} us a point", flush=True)

    def command(self, title, base, arguments):
        """CPU of a whole command, reading included, over a base."""
        used, memory, run = min((child_seconds([self.binary, *arguments]) for _ in range(self.repeats)), key=lambda r: r[0])
        end = "" if run.returncode == 0 else f", exit code {run.returncode}: {(run.stdout + run.stderr)[:200]}"
        print(f"{title:34} {used:8.3f} s, {used / base:.2f} x the build, peak {memory / 1024:.0f} MiB{end}", flush=True)

    def mesh_points(self):
        """Points of a mesh of about N cells, as .npy, which keeps every bit."""
        import numpy as np

        rows = np.fromfile(self.points("uniform"), dtype="<f8").reshape(-1, 4)[: self.n * 3 // 20]
        path = self.work / "mesh_points.npy"
        np.save(path, np.ascontiguousarray(rows[:, :3]))
        rows.tofile(self.points("mesh_points"))
        return path

    def check(self):
        path = self.mesh_points()
        base, row = self.medians([self.ours, "build", self.points("mesh_points")])[0]
        print(f"build of {row[2]:.0f} cells                {base:8.3f} s", flush=True)
        for ending in ["vtu", "mesh", "ele"]:
            mesh = self.work / f"mesh.{ending}"
            outputs = ["-o", mesh] + (["-o", mesh.with_suffix(".node")] if ending == "ele" else [])
            self.command(f"triangulate to .{ending}", base, ["triangulate", path, "--threads", 1, *outputs])
            self.command(f"check --claims delaunay, .{ending}", base, ["check", mesh, "--claims", "delaunay"])

    def trace(self):
        path, trace = self.mesh_points(), self.work / "run.obt"
        base, _ = self.medians([self.ours, "build", self.points("mesh_points")])[0]
        for steps in [[], ["--steps"]]:
            name = "insertion trace" if steps else "certificate"
            self.command(f"triangulate, {name}", base, ["triangulate", path, "--threads", 1, *steps, "--trace", trace])
            print(f"  {trace.stat().st_size / (self.n * 3 // 20):.1f} bytes a point", flush=True)
            for options in [[], ["--strict"]]:
                self.command(f"verify {' '.join(options) or 'plain'}, {name}", base, ["verify", trace, *options])


def main():
    target, work = Path(sys.argv[1]), Path(sys.argv[2])
    repeats = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    n = int(sys.argv[4]) if len(sys.argv) > 4 else 1_000_000
    parts = sys.argv[5].split(",") if len(sys.argv) > 5 else ["build", "memory", "removal", "growth", "threads", "valid", "check", "trace"]
    subprocess.run([sys.executable, Path(__file__).parent / "bench_inputs_space.py", work, str(n)], check=True)
    bench = Bench(target, work, repeats, n)
    for part in parts:
        getattr(bench, part)()


if __name__ == "__main__":
    main()
