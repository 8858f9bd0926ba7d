#!/usr/bin/env python3
"""Writes a reduced model for `dovetail response` and `dovetail wear` with h5py.

The model is a rod of unit stiffness and unit mass, fixed at its left end, with friction along its length and a
harmonic force at its free end:

    fixed |--o--o--o-- ... --o  <- 0.3 cos(w t)
             |  |  |         |
             Z  Z  Z         Z     springs 10/N
             x  x  x         x     massless contact nodes that slide at a force of 1/N

It is cut into N pieces, each a mass 1/N between springs N. Run it as

    python3 write_model.py rod.h5 [--nodes N]

The data sets are those of every model file; replace the matrices by the ones of your own superelement.
"""
import argparse
import sys

try:
    import h5py
except ImportError:
    sys.exit("write_model.py: this Python has no h5py; that of Debian, /usr/bin/python3, has it after `bash .setup/install studies`")
import numpy as np


def rod(nodes):
    """Matrices and contact data of the rod, by the names they have in the model file."""
    n = 3 * nodes  # degrees of freedom: rod u, then u_N and u_T of every contact node
    structure = np.arange(nodes)
    normal = nodes + 2 * np.arange(nodes)
    tangential = normal + 1

    stiffness = np.zeros((n, n))
    stiffness[structure, structure] = 2.0 * nodes
    stiffness[structure[:-1], structure[1:]] = stiffness[structure[1:], structure[:-1]] = -nodes
    stiffness[nodes - 1, nodes - 1] = nodes  # the right end is free

    # A spring between each rod node and the tangential displacement of its contact node.
    spring = 10.0 / nodes
    stiffness[structure, structure] += spring
    stiffness[tangential, tangential] += spring
    stiffness[structure, tangential] -= spring
    stiffness[tangential, structure] -= spring
    # The normal direction is apart: a spring that holds the pad, so that it is pressed by a constant force.
    stiffness[normal, normal] = spring

    mass = np.zeros((n, n))
    mass[structure, structure] = 1.0 / nodes  # none on contact degrees of freedom
    damping = 0.04 * mass

    # Friction coefficient times normal force is the limit force 1/N.
    friction = 0.5
    static = np.zeros(n)
    static[normal] = 1.0 / nodes / friction  # positive: closing

    cosine = np.zeros((1, n))  # row j-1 is harmonic j
    cosine[0, nodes - 1] = 0.3

    output = np.zeros((1, n))
    output[0, nodes - 1] = 1.0

    return {
        "/mass": mass,
        "/damping": damping,
        "/stiffness": stiffness,
        "/contact/normal": normal,
        "/contact/tangential": tangential.reshape(nodes, 1),
        "/contact/area": np.full(nodes, 1.0 / nodes),
        "/contact/gap": np.zeros(nodes),
        "/contact/friction": np.full(nodes, friction),
        "/contact/wear_coefficient": np.full(nodes, 1e-6),
        "/contact/position": np.column_stack([(structure + 1.0) / nodes, np.zeros(nodes), np.zeros(nodes)]),
        "/contact/group": np.zeros(nodes, dtype=np.int64),
        "/contact/slip_origin": np.zeros((nodes, 1)),
        "/force/static": static,
        "/force/cosine": cosine,
        "/force/sine": np.zeros((1, n)),
        "/output/vectors": output,
        "/output/names": ["tip"],
    }


def write_model(path, data):
    with h5py.File(path, "w") as file:
        file.attrs["format"] = "dovetail-reduced-model"
        file.attrs["version"] = 1
        for name, values in data.items():
            if name == "/output/names":
                file.create_dataset(name, data=values, dtype=h5py.string_dtype())
            else:
                file[name] = values


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Writes the reduced model of a rod with friction.")
    parser.add_argument("file", help="the model file to write, MODEL.h5")
    parser.add_argument("--nodes", type=int, default=10, help="masses and contact nodes (default: 10)")
    arguments = parser.parse_args()
    if arguments.nodes < 1:
        parser.error("--nodes must be at least 1")
    write_model(arguments.file, rod(arguments.nodes))
    print(f"{arguments.file}: {3 * arguments.nodes} degrees of freedom, {arguments.nodes} contact nodes")
