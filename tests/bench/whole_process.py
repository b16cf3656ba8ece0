"""Times whole processes with and without a label; see whole_process.sh, which prepares what this needs.

As a program of its own, `whole_process.py pymeshlab INPUT OUTPUT [PLUGIN]` is the PyMeshLab side: load, label when a plugin is
given, save.
"""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import time


def pymeshlab_side(source, target, plugin=None):
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    if plugin:
        pymeshlab.load_plugin(plugin)
    meshes.load_new_mesh(source)
    if plugin:
        meshes.apply_filter(
            "apply_text_label", placement="Point and direction", position=[0, 0, 20], direction=[0, 0, 1],
            up=[0, 1, 0], size=10, depth=1, text="A43",
        )
    meshes.save_current_mesh(target)


def run(command, output):
    """Wall and processor seconds of a process; it must have written its output."""
    output.unlink(missing_ok=True)
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0 or not output.is_file():
        raise SystemExit(f"failed: {' '.join(map(str, command))}")
    return wall, usage.ru_utime + usage.ru_stime


def compare(host, name, plain, labelled, output, runs):
    pairs = []
    sizes = []
    for count in range(runs + 1):
        pair = []
        for command in (plain, labelled):
            pair.append(run(command, output))
            sizes.append(output.stat().st_size)
        if count > 0:  # the first warms up
            pairs.append(pair)
    if sizes[0] == sizes[1]:
        raise SystemExit(f"{host} made no label")
    cells = []
    for i in range(2):  # wall, processor
        before = statistics.median(p[0][i] for p in pairs)
        more = statistics.median(p[1][i] - p[0][i] for p in pairs)
        cells.append(f"{before * 1000:.0f} | {more * 1000:+.0f} | {100 * more / before:+.1f} %")
    print(f"| {host} | {name} | {' | '.join(cells)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--part", required=True)
    parser.add_argument("--server", required=True)
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--folder", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=int, default=11)
    parser.add_argument("--sizes", default="100000,1000000")
    options = parser.parse_args()
    print("| host | part | load and save, ms | with label | | processor time, ms | with label | |")
    print("|---|---|--:|--:|--:|--:|--:|--:|")
    for size in options.sizes.split(","):
        for ending in ("stl", "ply"):
            part = options.folder / f"part.{ending}"
            output = options.folder / f"out.{ending}"
            subprocess.run([options.part, size, part], check=True)
            name = f"{size} triangles, {ending.upper()}"
            server = [options.server, "-i", part, "-o", output]
            compare("meshlabserver", name, server, [*server, "-s", options.folder / "label.mlx"], output, options.runs)
            python = [sys.executable, __file__, "pymeshlab", part, output]
            compare("PyMeshLab", name, python, [*python, options.plugin], output, options.runs)


if sys.argv[1:2] == ["pymeshlab"]:
    pymeshlab_side(*sys.argv[2:])
else:
    main()
