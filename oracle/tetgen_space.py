#!/usr/bin/env python3
"""Compares with TetGen where there are no ties: tetgen_space.py OURS CASES

The tie-free bulk cases of the generators (uniform places, clusters, offsets, wild scales; TetGen has neither our weights nor our tie-break): equal sets of
tetrahedra, exactly. TetGen breaks with the uniqueness of a Delaunay triangulation where its own sums round; each such case is
printed with how many tetrahedra differ. Exit code 1 on any difference in a family without wild scales.
"""

import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

from space import answers, case_bytes, cases_of, rows, tuples

FAMILIES = ["Random", "Clusters", "Offset", "WildScales", "RoundedSphere"]


def tetgen(case, folder):
    """TetGen's Delaunay tetrahedra as ascending tuples of positions; None where it refuses."""
    points = rows(case)
    node = folder / "points.node"
    lines = [f"{len(points)} 3 0 0"] + [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z, _) in enumerate(points)]
    node.write_text("\n".join(lines) + "\n")
    out = folder / "points.1.ele"
    out.unlink(missing_ok=True)
    # -z: ids from 0, -Q: quiet, -N, -F: neither nodes nor faces.
    run = subprocess.run(["tetgen", "-zQNF", node], capture_output=True, text=True, timeout=600)
    if run.returncode != 0 or not out.exists():
        return None
    body = [line.split()[1:5] for line in out.read_text().splitlines()[1:] if not line.startswith("#")]
    return {tuple(sorted(map(int, words))) for words in body}


def main():
    ours, cases = sys.argv[1:]
    stream = b"".join(
        subprocess.run([cases, *words.split()], capture_output=True, check=True).stdout for words in ["small 0 20", "tie-free"]
    )
    table, failed = defaultdict(lambda: [0, 0, 0, 0]), False
    with tempfile.TemporaryDirectory() as folder:
        for case in cases_of(stream):
            family = case.name.split("+")[0].split("-")[0]
            if family not in FAMILIES or any(w != 0 for *_, w in rows(case)) or len(case.points) < 5 * 32:
                continue
            (mine,), _ = answers([ours], case_bytes(case))
            theirs, line = tetgen(case, Path(folder)), table[family]
            line[0] += 1
            line[1] += len(mine.simplices) // 16
            if theirs is None:
                line[3] += 1
                print(f"TetGen refuses {case.name}")
            elif theirs != set(tuples(mine)):
                line[2] += 1
                failed |= family != "WildScales"
                print(f"DIFFERENT {case.name}: {len(set(tuples(mine)) - theirs)} tetrahedra of ours alone, {len(theirs - set(tuples(mine)))} of TetGen")
    form = "{:24} {:>7} {:>12} {:>7} {:>8}"
    print(form.format("against TetGen", "cases", "tetrahedra", "differ", "refused"))
    for family, line in sorted(table.items()):
        print(form.format(family, *line))
    sys.exit(failed or not table)


if __name__ == "__main__":
    main()
