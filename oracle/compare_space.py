#!/usr/bin/env python3
"""Compares triangulations of space, exactly: compare_space.py OURS PEER CASES SECONDS [FILES...]

OURS, PEER: programs that answer cases (README.md, "Cases of space"); CASES: the program that writes those of the generators, called for bulk
builds, single insertions and edits in turn until SECONDS are used. FILES: streams of further cases. Prints a table by family. A difference is
shrunk to few points and printed. Exit code 1 on any difference, on a crash, if nothing was compared, or if the control fails: where the peer is given the
mirror image in x, grids must come out differently (another tie-break) and uniform points must not.
"""

import struct
import subprocess
import sys
import time
from collections import defaultdict

from space import Case, answers, case_bytes, cases_of, describe, ids, rows, tuples


def differ(case, ours, peer):
    a, _ = answers(ours, case_bytes(case), timeout=60)
    b, _ = answers(peer, case_bytes(case), timeout=60)
    return a != b


def without_point(case, i):
    """The case without its i-th point and the edits that name it."""
    points = case.points[: 32 * i] + case.points[32 * (i + 1) :]
    edits = [(k, id_ - (id_ > i), w) for k, id_, w in case.edits if id_ != i]
    return Case(case.name, points, edits)


def shrunk(case, ours, peer, budget=60):
    """Leaves out points, then edits, while the answers still differ."""
    end = time.monotonic() + budget

    def attempts(c):
        n = len(c.points) // 32
        step = max(n // 2, 1)
        while step and n > 1:
            for first in range(0, n, step):
                smaller = c
                for i in range(min(first + step, n) - 1, first - 1, -1):
                    smaller = without_point(smaller, i)
                yield smaller
            step //= 2
        for i, edit in enumerate(c.edits):
            if edit[0] != 0:
                yield Case(c.name, c.points, c.edits[:i] + c.edits[i + 1 :])

    progress = True
    while progress and time.monotonic() < end:
        progress = False
        for smaller in attempts(case):
            if time.monotonic() > end:
                break
            if differ(smaller, ours, peer):
                case, progress = smaller, True
                break
    return case


class Table:
    def __init__(self, ours, peer):
        self.ours, self.peer = ours, peer
        self.lines = defaultdict(lambda: [0, 0, 0, 0, 0, 0])
        self.failed = False
        self.shown = 0

    def add(self, family_of, stream):
        (a, well), (b, peer_well) = answers(self.ours, stream), answers(self.peer, stream)
        self.failed |= not (well and peer_well)
        for k, case in enumerate(cases_of(stream)):
            line = self.lines[family_of(case.name)]
            line[0] += 1
            line[1] += len(case.points) // 32
            if k < len(b):
                line[2] += len(b[k].simplices) // 4 // max(b[k].dimension + 1, 1)
                line[3] += len(b[k].hidden) // 4
                line[4] += len(b[k].duplicates) // 8
            if k >= len(a) or k >= len(b) or a[k] != b[k]:
                line[5] += 1
                self.failed = True
                self.show(case, a[k] if k < len(a) else None, b[k] if k < len(b) else None)

    def show(self, case, a, b):
        print("DIFFERENT", case.name, "no answer" if a is None else f"dimension {a.dimension}", flush=True)
        self.shown += 1
        if self.shown > 5:
            return
        if len(case.points) // 32 <= 20_000:
            case = shrunk(case, self.ours, self.peer)
            (a, *_), (b, *_) = (answers(p, case_bytes(case), timeout=60)[0] or [None] for p in (self.ours, self.peer))
        if len(rows(case)) <= 40:
            print(describe(case))
        if a and b:
            ours, peer = set(tuples(a)), set(tuples(b))
            print("  ours alone:", sorted(ours - peer)[:12], "hidden", ids(a.hidden)[:20], "duplicates", ids(a.duplicates)[:20])
            print("  peer alone:", sorted(peer - ours)[:12], "hidden", ids(b.hidden)[:20], "duplicates", ids(b.duplicates)[:20], flush=True)

    def print(self):
        form = "{:44} {:>7} {:>9} {:>10} {:>8} {:>10} {:>7}"
        print(form.format("family", "cases", "points", "simplices", "hidden", "duplicates", "differ"))
        for family, line in sorted(self.lines.items()):
            print(form.format(family, *line))
        print(form.format("all", *(sum(column) for column in zip(*self.lines.values()))))


def control(ours, peer, stream):
    """Whether the comparison can see a wrong tie-break, and sees none where there are no ties."""

    def mirrored(case):
        flat = b"".join(struct.pack("<4d", 0.0 - x, y, z, w) for x, y, z, w in rows(case))
        return case_bytes(Case(case.name, flat, case.edits))

    cases = [c for c in cases_of(stream) if c.name.split("+")[0] in ("Grid", "Random") and "Lifted" not in c.name]
    a, _ = answers(ours, b"".join(map(case_bytes, cases)))
    b, _ = answers(peer, b"".join(map(mirrored, cases)))
    differ = {family: sum(x != y for x, y in zip(a, b) if x.name.startswith(family)) for family in ("Grid", "Random")}
    print(f"control: of {len(cases) // 2} mirrored cases each, {differ['Grid']} grids and {differ['Random']} uniform sets differ")
    return len(a) == len(b) and differ["Grid"] > len(cases) // 8 and differ["Random"] == 0


def main():
    ours, peer, cases, seconds, *files = sys.argv[1:]
    table, end = Table(ours.split(), peer.split()), time.monotonic() + float(seconds)

    def made(*words):
        return subprocess.run([cases, *map(str, words)], capture_output=True, check=True).stdout

    for path in files:
        with open(path, "rb") as f:
            table.add(lambda name, p=path: f"{p.rsplit('/', 1)[-1].split('.')[0]}: {name}"[:44], f.read())
    seed = 0
    while seed == 0 or time.monotonic() < end:
        for mode in ["small", "single", "edits"]:
            table.add(lambda name, m=mode: f"{m}: {name.rsplit('-', 1)[0]}", made(mode, seed, 1))
        seed += 1
    table.print()
    sound = control(table.ours, table.peer, made("small", 0, 10))
    sys.exit(table.failed or not table.lines or not sound)


if __name__ == "__main__":
    main()
