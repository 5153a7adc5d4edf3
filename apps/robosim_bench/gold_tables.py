#!/usr/bin/env python3
"""Prints the tables of doc/gold_benchmark.md from the runs.csv of a report of robosim bench gold.

Usage: gold_tables.py FOLDER/runs.csv
"""

import csv
import math
import sys
from collections import defaultdict


def median(times):
    """Kaplan-Meier median of runs that share one time limit; times without success are infinite."""
    times = sorted(times)
    return times[math.ceil(len(times) / 2) - 1]


def seconds(value):
    return "–" if math.isinf(value) else f"{value:.0f}"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    times = defaultdict(dict)  # by (world, team, strategy): time by seed
    worlds, teams, strategies = {}, {}, {}  # ordered
    conditions = set()
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            conditions.add(row["condition"])
            key = row["world"], int(row["robots"]), row["controller"]
            times[key][row["seed"]] = float(row["gold_time_s"]) if row["gold_found"] == "1" else math.inf
            worlds[key[0]], teams[key[1]], strategies[key[2]] = None, None, None
    if len(conditions) > 1:
        sys.exit(f"gold_tables.py: {sys.argv[1]} has several conditions; give runs of one")
    for team in teams:
        print(f"### {team} {'robot' if team == 1 else 'robots'}\n")
        print("| world | " + " | ".join(f"`{name}`" for name in strategies) + " |")
        print("| --- |" + " --- |" * len(strategies))
        for world in worlds:
            cells = []
            for strategy in strategies:
                of_case = list(times[world, team, strategy].values())
                found = sum(math.isfinite(t) for t in of_case)
                share = "" if found == len(of_case) else f" ({100 * found / len(of_case):.0f} %)"
                cells.append(seconds(median(of_case)) + share)
            print(f"| {world} | " + " | ".join(cells) + " |")
        print()
    print("### All worlds\n")
    print("| strategy | " + " | ".join(f"{team}: found, times oracle" for team in teams) + f" | speed-up with {max(teams)} |")
    print("| --- |" + " --- |" * (len(teams) + 1))
    for strategy in strategies:
        cells = []
        for team in teams:
            ratios, found, count = [], 0, 0
            for world in worlds:
                bound = times[world, team, "oracle"]
                for seed, t in times[world, team, strategy].items():
                    count += 1
                    found += math.isfinite(t)
                    if bound.get(seed, 0) > 0 and math.isfinite(bound[seed]):
                        ratios.append(t / bound[seed])
            ratio = median(ratios) if ratios else math.nan
            cells.append(f"{100 * found / count:.0f} %, " + ("–" if not math.isfinite(ratio) else f"{ratio:.1f}"))
        speed_ups = []
        for world in worlds:
            alone = median(list(times[world, min(teams), strategy].values()))
            largest = median(list(times[world, max(teams), strategy].values()))
            if math.isfinite(alone) and largest > 0:
                speed_ups.append(alone / largest)
        speed_ups.sort()
        middle = f"{speed_ups[len(speed_ups) // 2]:.1f} ({len(speed_ups)} worlds)" if speed_ups else "–"
        print(f"| `{strategy}` | " + " | ".join(cells) + f" | {middle} |")


if __name__ == "__main__":
    main()
