#!/usr/bin/env python3
"""Matrices of Ansys Mechanical APDL for `dovetail import`:  from_ansys.py FILE.full FOLDER

The .full file is what a modal analysis, or WRFULL, leaves. Needs pymapdl-reader (pip install ansys-mapdl-reader).
"""
import sys

from structure_files import write

if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    from ansys.mapdl.reader import read_binary
    dof_ref, stiffness, mass = read_binary(sys.argv[1]).load_km(sort=True)
    # UX, UY, UZ are 0, 1, 2 there.
    write(sys.argv[2], stiffness, mass, [(int(node), int(direction) + 1) for node, direction in dof_ref])
