#!/usr/bin/env python3
"""A Scene of a million triangles from arrays, against the same in C++ by bench_arrays, in turns.

    PYTHONPATH=build/release/python python3 bench/arrays.py build/release/bench_arrays
"""

import os
import statistics
import subprocess
import sys


def status(key):
    """A value of this process in MB, as Linux tells it."""
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) / 1e3 for line in file if line.startswith(key))


def in_python():
    import numpy as np
    import sightline

    n = 708
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    V = np.stack([i * 0.01, j * 0.01, ((i * 7919 + j * 104729) % 1000) / 512.0], axis=-1).reshape(-1, 3)
    k = (i * n + j)[:-1, :-1].ravel()
    F = np.stack([k, k + n, k + n + 1, k, k + n + 1, k + 1], axis=1).reshape(-1, 3)
    with open("/proc/self/clear_refs", "w") as file:  # forgets the peak so far
        file.write("5")
    before, start = status("VmRSS"), os.times()
    scene = sightline.Scene(V, F)
    end = os.times()
    print(scene.face_count, end.user + end.system - start.user - start.system, status("VmHWM") - before)


def main():
    rows = {"C++": [], "Python": []}
    for _ in range(5):
        for name, command in (("C++", sys.argv[1:2]), ("Python", [sys.executable, __file__, "--once"])):
            said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            rows[name].append([float(x) for x in said.split()[1:]])
    for name, measured in rows.items():
        seconds, megabytes = (statistics.median(column) for column in zip(*measured))
        print(f"{name:<8} {seconds:.2f} s of a core, {megabytes:.0f} MB more at the most")


if "--once" in sys.argv:
    in_python()
else:
    main()
