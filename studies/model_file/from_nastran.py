#!/usr/bin/env python3
"""Matrices of Nastran for `dovetail import`:  from_nastran.py DECK.bdf MATRICES.op4 FOLDER [--spc ID]

MATRICES is an .op4, or .op2, with KGG and MGG. Rows of the g set are six for each GRID and one for each SPOINT, by their
numbers. --spc leaves out what SPC and SPC1 of that number hold. Needs pyNastran (pip install pyNastran).
"""
import argparse

import scipy.sparse

from structure_files import write


def matrices_of(path):
    if path.endswith(".op4"):
        from pyNastran.op4.op4 import read_op4
        matrices = read_op4(path, matrix_names=["KGG", "MGG"], debug=False)
    else:
        from pyNastran.op2.op2 import read_op2
        matrices = read_op2(path, debug=False).matrices
    found = []
    for name in ("KGG", "MGG"):
        matrix = matrices[name]
        # Older releases give (form, matrix), newer ones an object.
        found.append(scipy.sparse.csr_matrix(matrix[1] if isinstance(matrix, (tuple, list)) else matrix.data))
    return found


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("deck")
    parser.add_argument("matrices")
    parser.add_argument("folder")
    parser.add_argument("--spc", type=int, help="number of the SPC case whose degrees of freedom are held")
    given = parser.parse_args()
    from pyNastran.bdf.bdf import read_bdf
    deck = read_bdf(given.deck, xref=False, debug=False)
    dofs = []
    for point in sorted([*deck.nodes, *deck.spoints]):
        dofs += [(point, direction) for direction in ((1,) if point in deck.spoints else range(1, 7))]
    stiffness, mass = matrices_of(given.matrices)
    held = set()
    for card in deck.spcs.get(given.spc, []):
        together = [card.components] * len(card.nodes) if card.type == "SPC1" else card.components
        held |= {(node, int(digit)) for node, digits in zip(card.nodes, together) for digit in str(digits)}
    kept = [place for place, dof in enumerate(dofs) if dof not in held]
    write(given.folder, stiffness[kept][:, kept], mass[kept][:, kept], [dofs[i] for i in kept])
