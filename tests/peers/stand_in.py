#!/usr/bin/python3
"""Stands in for argos3 in the tests of the driver: reads the experiment, prints readings, and uses processor time in proportion to its
steps. It simulates nothing."""
import os
import re
import sys
import time
from pathlib import Path

if "mvsim" in sys.argv[0]:
    Path("pid").write_text(str(os.getpid()))
    time.sleep(600)
text = Path(sys.argv[sys.argv.index("-c") + 1]).read_text()
robots = len(re.findall("<foot-bot ", text))
if "faulty" in sys.argv[0]:
    print("[FATAL] no such plugin", file=sys.stderr)
    sys.exit(3)
for i in range(robots if "silent" not in sys.argv[0] else robots - 1):
    print(f"READINGS r{i} " + " ".join(["0"] * 24))
steps = float(re.search('experiment length="([0-9.]+)"', text)[1]) * 10
while time.process_time() < 0.05 + 0.001 * steps:
    pass
