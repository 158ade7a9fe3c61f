#!/usr/bin/env python3
"""Compares sets of triangles, exactly: compare.py OURS PEER BUDGET_SECONDS CASES [FILES...]

OURS, PEER: programs that read cases and print sets (README.md). CASES: the program that writes cases of the generators, called with a first
seed and a number of seeds until the budget is used. FILES: streams of further cases. Cases of one name are one graph in several orders, so
their sets must be equal too. Prints a table by family; exit code 1 on any difference, on a crash, or if nothing was compared.
"""

import subprocess
import sys
import time
from collections import defaultdict

BATCH = 20  # seeds a call


def answers(program, stream):
    """Name and text of each answer in order."""
    run = subprocess.run([program], input=stream, capture_output=True)
    if run.returncode != 0 or run.stderr:
        print(program, "exit code", run.returncode, run.stderr.decode()[:2000])
    blocks = run.stdout.decode().split("case ")[1:]
    return [tuple(block.split(maxsplit=1)) for block in blocks]


class Table:
    def __init__(self):
        self.rows = defaultdict(lambda: [0, 0, 0, 0, 0])  # cases, triangles, refused, peer differs, order differs
        self.failed = False

    def add(self, family_of, stream, ours, peer):
        expected = sum(line.startswith(b"case ") for line in stream.splitlines())
        ours, peer = answers(ours, stream), answers(peer, stream)
        if not expected == len(ours) == len(peer):
            print(f"{expected} cases, {len(ours)} answers of ours, {len(peer)} of the peer")
            self.failed = True
        first = {}
        for (name, a), (other, b) in zip(ours, peer):
            row = self.rows[family_of(name)]
            row[0] += 1
            row[1] += max(a.count("\n") - 1, 0)
            row[2] += a.strip() == "refused" or b.strip() == "refused"
            differs, disordered = (name, a) != (other, b), first.setdefault(name, a) != a
            row[3] += differs
            row[4] += disordered
            if differs or disordered:
                self.failed = True
                print("DIFFERENT", name, "from the peer" if differs else "in another order")

    def print(self):
        form = "{:32} {:>8} {:>10} {:>8} {:>8} {:>8}"
        print(form.format("family", "cases", "triangles", "refused", "differ", "by order"))
        for family, row in sorted(self.rows.items()):
            print(form.format(family, *row))
        print(form.format("all", *(sum(column) for column in zip(*self.rows.values()))))


def main():
    ours, peer, budget, cases, *files = sys.argv[1:]
    table, end = Table(), time.monotonic() + float(budget)
    for path in files:
        with open(path, "rb") as f:
            table.add(lambda _, p=path: "real: " + p.rsplit("/", 1)[-1].split(".")[0], f.read(), ours, peer)
    seed = 0
    while seed == 0 or time.monotonic() < end:
        stream = subprocess.run([cases, str(seed), str(BATCH)], capture_output=True, check=True).stdout
        table.add(lambda name: name.rsplit("-", 1)[0], stream, ours, peer)
        seed += BATCH
    table.print()
    sys.exit(table.failed or not table.rows)


if __name__ == "__main__":
    main()
