"""Compares the exports of a recording with the output of `robosim replay --print --csv`, value by value.

usage: compare_exports.py REPLAYED.csv EXPORTED.csv EXPORTED.npz
Prints the number of values compared; exits with 1 and the difference if there is one.
"""
import csv
import sys

import numpy as np


def fail(text):
    sys.exit("compare_exports.py: " + text)


def replayed(file):
    """Yields (seconds, label, {column: field}) for each observation."""
    names = {}
    with open(file, newline="") as lines:
        header = None
        for fields in csv.reader(lines):
            if fields[:2] == ["seconds", "label"]:
                header = fields[2:]
                continue
            # A line of column names belongs to the label of the next observation.
            if header is not None:
                names[fields[1]] = header
                header = None
            yield fields[0], fields[1], dict(zip(names[fields[1]], fields[2:]))


def exported_csv(file):
    """The fields that are not empty: {(seconds, robot, column): [field, …]}, and the step of each time."""
    found, steps = {}, {}
    with open(file, newline="") as lines:
        for row in csv.DictReader(lines):
            steps.setdefault(row["time_s"], row["step"])
            if steps[row["time_s"]] != row["step"]:
                fail(f"{file}: two steps at {row['time_s']} s")
            for column, field in row.items():
                if field != "" and column not in ("step", "time_s", "robot"):
                    found.setdefault((row["time_s"], row["robot"], column), []).append(field)
    return found, steps


def main(replay_file, csv_file, npz_file):
    fields, steps = exported_csv(csv_file)
    arrays = dict(np.load(npz_file, allow_pickle=False))  # NumPy decompresses an array at each access
    rows, used, compared = {}, set(), 0
    for seconds, label, values in replayed(replay_file):
        row = rows[label] = rows.get(label, -1) + 1
        robot, _, sensor = label.partition("/") if "/" in label else ("", "", label)
        if f"{arrays[label + '/time_s'][row]:.7f}" != seconds:
            fail(f"{label}: row {row} is of {arrays[label + '/time_s'][row]} s, not {seconds} s")
        if str(arrays[label + "/step"][row]) != steps[seconds]:
            fail(f"{label}: row {row} is of step {arrays[label + '/step'][row]}, not {steps[seconds]}")
        used |= {label + "/time_s", label + "/step"}
        columns = arrays[label + "/columns"].tolist() if label + "/columns" in arrays else []
        if columns:
            used |= {label, label + "/columns"}
            if arrays[label].dtype != np.float64 or arrays[label].shape[1] != len(columns):
                fail(f"{label}: array of {arrays[label].dtype} {arrays[label].shape}")
        for name, field in values.items():
            if name in columns:
                value = arrays[label][row, columns.index(name)]
                # Sensors report in single or double precision, and the text is exact in that.
                same = np.isnan(value) if field == "" else float(field) == value or np.float32(field) == value
            else:
                same = arrays[f"{label}/{name}"][row] == field
                used.add(f"{label}/{name}")
            if not same:
                fail(f"{npz_file}: {label} {name} at {seconds} s is not {field}")
            if field != "" and fields[(seconds, robot, f"{sensor}/{name}")].pop(0) != field:
                fail(f"{csv_file}: {label} {name} at {seconds} s is not {field}")
            compared += 1
    for label, row in rows.items():
        if len(arrays[label + "/step"]) != row + 1:
            fail(f"{npz_file}: {label} has more rows than the recording")
    if unknown := set(arrays) - used:
        fail(f"{npz_file}: unknown arrays {sorted(unknown)}")
    if left := [key for key, values in fields.items() if values]:
        fail(f"{csv_file}: unknown values {left[:5]}")
    print(compared, "values are equal")


if __name__ == "__main__":
    main(*sys.argv[1:])
