"""Manifold as a peer of side_by_side: answers one line on stdout to each line on stdin.

    about                                     version and threads
    load PART PRISM                           read two meshes and make Manifolds of them
    alone union|difference RESULT|-           one operation on the Manifolds; seconds, negative when refused
    run union|difference                      the same from arrays to arrays

A mesh file: numbers of vertices and faces (int64), positions (float64), faces (int32), as the machine holds them.
"""

import importlib.metadata
import os
import sys
import time

import manifold3d
import numpy


def read(path):
    with open(path, "rb") as file:
        vertices, faces = numpy.fromfile(file, numpy.int64, 2)
        positions = numpy.fromfile(file, numpy.float64, 3 * vertices).reshape(-1, 3)
        corners = numpy.fromfile(file, numpy.int32, 3 * faces).reshape(-1, 3)
    return manifold3d.Mesh64(positions, corners.astype(numpy.uint64))


def write(path, mesh):
    positions = numpy.ascontiguousarray(mesh.vert_properties[:, :3], numpy.float64)
    corners = numpy.ascontiguousarray(mesh.tri_verts, numpy.int32)
    with open(path, "wb") as file:
        numpy.array([len(positions), len(corners)], numpy.int64).tofile(file)
        positions.tofile(file)
        corners.tofile(file)


def boolean(operation, part, prism):
    result = part + prism if operation == "union" else part - prism
    if result.status() != manifold3d.Error.NoError:  # also makes it run: a boolean is lazy
        raise ValueError(str(result.status()))
    return result


def main():
    meshes = solids = ()
    for line in sys.stdin:
        words = line.split()
        try:
            if words[0] == "about":
                sphere = manifold3d.Manifold.sphere(10, 200)
                boolean("union", sphere, sphere.translate((1, 2, 3)))
                threads = len(os.listdir("/proc/self/task")) if os.path.isdir("/proc/self/task") else "?"
                answer = f"Manifold {importlib.metadata.version('manifold3d')} (PyPI), {threads} threads"
            elif words[0] == "load":
                meshes = [read(path) for path in words[1:]]
                solids = [manifold3d.Manifold(mesh) for mesh in meshes]
                answer = " ".join(str(solid.status()) for solid in solids)
            else:
                start = time.perf_counter()
                if words[0] == "alone":
                    result = boolean(words[1], *solids)
                    answer = repr(time.perf_counter() - start)
                    if words[2] != "-":
                        write(words[2], result.to_mesh64())
                else:
                    boolean(words[1], *(manifold3d.Manifold(mesh) for mesh in meshes)).to_mesh64()
                    answer = repr(time.perf_counter() - start)
        except (ValueError, MemoryError) as error:
            answer = f"-1 {error}"
        print(answer, flush=True)


main()
