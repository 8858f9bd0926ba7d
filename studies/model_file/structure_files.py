"""Stiffness and mass of a structure as the files that a TOML file with format = "dovetail-structure" names."""
import pathlib

import numpy as np
import scipy.sparse


def symmetric(matrix):
    """Both triangles of a matrix of which one or both are given."""
    matrix = scipy.sparse.csr_matrix(matrix)
    lower, upper = scipy.sparse.tril(matrix, -1), scipy.sparse.triu(matrix, 1)
    if lower.nnz and upper.nnz:
        return matrix
    return matrix + (lower + upper).T


def write(folder, stiffness, mass, dofs):
    """stiffness.mtx, mass.mtx (Matrix Market) and dofs.txt; `dofs`: pairs of node and direction (from 1), one per row.

    Degrees of freedom without any stiffness, as rotations of solid elements, are left out.
    """
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    stiffness, mass = symmetric(stiffness), symmetric(mass)
    kept = np.flatnonzero(abs(stiffness).sum(axis=1).A1 > 0)
    for name, matrix in (("stiffness", stiffness), ("mass", mass)):
        lower = scipy.sparse.tril(matrix[kept][:, kept]).tocoo()
        with open(folder / f"{name}.mtx", "w") as file:
            file.write("%%MatrixMarket matrix coordinate real symmetric\n")
            file.write(f"{len(kept)} {len(kept)} {lower.nnz}\n")
            for row, column, value in zip(lower.row, lower.col, lower.data):
                file.write(f"{row + 1} {column + 1} {float(value)!r}\n")
    (folder / "dofs.txt").write_text("".join(f"{dofs[i][0]}.{dofs[i][1]}\n" for i in kept))
    print(f"{folder}: {len(kept)} degrees of freedom; name stiffness.mtx, mass.mtx and dofs.txt in your TOML file")
