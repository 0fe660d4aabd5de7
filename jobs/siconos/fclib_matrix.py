"""Matrices as groups of FCLIB's files: by columns, which FCLIB marks with nz = -1."""
import numpy as np


def write_matrix(group, matrix):
    columns, rows = np.nonzero(matrix.T)
    for name, value in (("nzmax", len(rows)), ("m", matrix.shape[0]), ("n", matrix.shape[1]), ("nz", -1)):
        group.create_dataset(name, data=np.array([value], "i4"))
    starts = np.concatenate([[0], np.cumsum(np.bincount(columns, minlength=matrix.shape[1]))])
    group.create_dataset("p", data=starts.astype("i4"))
    group.create_dataset("i", data=rows.astype("i4"))
    group.create_dataset("x", data=matrix[rows, columns].astype("f8"))


def read_matrix(group):
    """Dense."""
    matrix, starts = np.zeros((group["m"][0], group["n"][0])), group["p"][:]
    matrix[group["i"][:], np.repeat(np.arange(len(starts) - 1), np.diff(starts))] = group["x"][:]
    return matrix
