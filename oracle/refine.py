#!/usr/bin/env python3
"""Refinement of every real graph by ours, CGAL's Mesh_2, spade and Triangle, side by side: refine.py TARGET_FOLDER DATA_FOLDER [DEGREES] [SUBSTRING]

For each: triangles and smallest angle in degrees; `cut` where a peer was stopped after 200,000 steps, `-` where it failed or found nothing to mesh. spade fills by parity
of constraints, the others all that constraints enclose, so its counts are of another region where a cycle lies within a cycle without a hole seed.
Beside dangling segments it finds no inside. The means are over the graphs that all programs finished with the angle asked for. Nothing is demanded of the peers; ours must give what it claims: no
angle below the one asked for, unless the triangle is listed as unmet. Exit code 1 otherwise.
"""

import math
import subprocess
import sys
import tempfile
from pathlib import Path

import corpora
from corpus import answer, run

HERE = Path(__file__).parent
STEPS = 200_000


def peer(command, stream):
    """Triangles, smallest angle and whether it came to its end."""
    try:
        done, _ = run(command, input=stream, timeout=60)
    except subprocess.TimeoutExpired:
        return None
    words = done.stdout.split()
    if done.returncode != 0 or len(words) < 6:
        return None
    triangles = int(words[3])
    return (triangles, float(words[4]), words[1] == "1") if triangles else None


def ours(program, path, degrees):
    """The same of ours by the counts of its report and the angles of the written mesh."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder, "mesh.node")
        told = answer(run([program, "mesh", path, "--min-angle", degrees, "-o", mesh, "--json"])[0])
        if not mesh.exists():
            return None, told.get("outcome", "refused") == "refused"
        points = corpora.read_points(str(mesh))
        first = int(next(iter(open(mesh).read().splitlines()[1:])).split()[0])
        smallest, low = 180.0, 0
        rows = list(corpora.rows(mesh.with_suffix(".ele")))[1:]
        for row in rows:
            corners = [[float(x) for x in points[int(v) - first]] for v in row[1:4]]
            angle = min(angle_at(*corners[i:], *corners[:i]) for i in range(3))
            smallest = min(smallest, angle)
            low += angle < degrees - 1e-9
        return (len(rows), smallest, True), low <= len(told["unmet"]) and len(rows) == told["counts"]["triangles"]


def angle_at(a, b, c):
    u, v = (b[0] - a[0], b[1] - a[1]), (c[0] - a[0], c[1] - a[1])
    return math.degrees(math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]))


def cell(result):
    if result is None:
        return f"{'-':>16}"
    triangles, angle, ended = result
    return f"{triangles:8} {angle:5.2f}" + ("  " if ended else "c ")


def main():
    target, data = Path(sys.argv[1]), sys.argv[2]
    degrees = float(sys.argv[3]) if len(sys.argv) > 3 else 20.7
    part = sys.argv[4] if len(sys.argv) > 4 else ""
    commands = {
        "CGAL": [target / "oracle/cgal-mesh", degrees, 0, STEPS],
        "spade": [target / "oracle/spade/release/spade-peer", "mesh", degrees, 0, STEPS],
        "Triangle": [sys.executable, HERE / "triangle_peer.py", "mesh", degrees, 0, STEPS],
    }
    print(f"{'at ' + str(degrees) + ' degrees':46} {'ours':>14}  " + " ".join(f"{name:>15}" for name in commands))
    ratios, good = {name: [] for name in commands}, True
    for path in sorted(Path(data, "pslg/as_poly").glob("*.poly")):
        if part not in path.stem:
            continue
        stream = run([sys.executable, HERE / "corpora.py", "poly-once", path])[0].stdout
        mine, honest = ours(target / "release/orthoball", path, degrees)
        theirs = {name: peer(command, stream) for name, command in commands.items()}
        print(f"{path.stem[:46]:46} {cell(mine)}" + " ".join(cell(r) for r in theirs.values()) + ("" if honest else " NOT AS REPORTED"), flush=True)
        good &= honest
        everyone = [mine, *theirs.values()]
        if all(r is not None and r[2] and r[1] >= degrees - 1e-6 for r in everyone):
            for name, r in theirs.items():
                ratios[name].append(math.log(mine[0] / r[0]))
    count = len(ratios["CGAL"])
    if count:
        means = ", ".join(f"{math.exp(sum(logs) / count):.3f} x {name}" for name, logs in ratios.items())
        print(f"our triangles over theirs, geometric mean of the {count} graphs that all finished with the angle: {means}")
    sys.exit(not good)


if __name__ == "__main__":
    main()
