"""Blocks of the covariance turned about their diagonal, in tiles of four rows and four columns.

A block has 15 rows of 16 numbers, the last of which are zero.  What is turned over stands at S_A,
with a sixteenth row and a sixteenth column of zeros.
"""

from .layout import PLACE, ROW, S_A

TILE = 4
LAST = 12  # row and column at which the last tile begins, which has one less


def turn_over(w, block, first, end):
    """Write rows ``first``..``end - 1`` of the transpose of a block to S_A, in whole tiles."""
    block &= PLACE
    for j in range(first, end, TILE):
        for i in range(0, LAST, TILE):
            transpose_tile(w, block + ROW * i + j, S_A + ROW * j + i, TILE, TILE)
        transpose_tile(w, block + ROW * LAST + j, S_A + ROW * j + LAST, TILE - 1, TILE)


def turn_back(w, block):
    """Write the transpose of what is at S_A to a block."""
    block &= PLACE
    for i in range(0, ROW, TILE):
        for j in range(0, LAST, TILE):
            transpose_tile(w, S_A + ROW * i + j, block + ROW * j + i, TILE, TILE)
        transpose_tile(w, S_A + ROW * i + LAST, block + ROW * LAST + i, TILE, TILE - 1)


def transpose_tile(w, p, q, rows, columns):
    """Write the transpose of the tile at ``p`` to ``q``, with zeros for rows that it lacks.

    The compiler has a text of its own for it, in which four numbers move at once.
    """
    for j in range(columns):
        for i in range(TILE):
            w[q + ROW * j + i] = w[p + ROW * i + j] if i < rows else 0.0


def mirror(w, block):
    """Write the upper triangle of what is at S_A to a block, and as the lower one too."""
    block &= PLACE
    for i in range(0, LAST, TILE):
        mirror_diagonal(w, S_A + (ROW + 1) * i, block + (ROW + 1) * i)
        for j in range(i + TILE, LAST, TILE):
            transpose_tile(w, S_A + ROW * i + j, block + ROW * j + i, TILE, TILE)
            copy_tile(w, S_A + ROW * i + j, block + ROW * i + j)
        transpose_tile(w, S_A + ROW * i + LAST, block + ROW * LAST + i, TILE, TILE - 1)
        copy_tile(w, S_A + ROW * i + LAST, block + ROW * i + LAST)
    mirror_last(w, S_A + (ROW + 1) * LAST, block + (ROW + 1) * LAST)


def mirror_diagonal(w, p, q):
    """Write the symmetric tile, whose upper triangle is at ``p``, to ``q``."""
    a0, a1, a2, a3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    p += ROW
    b1, b2, b3 = w[p + 1], w[p + 2], w[p + 3]
    p += ROW
    c2, c3 = w[p + 2], w[p + 3]
    d3 = w[p + ROW + 3]
    put_row(w, q, a0, a1, a2, a3)
    put_row(w, q + ROW, a1, b1, b2, b3)
    put_row(w, q + 2 * ROW, a2, b2, c2, c3)
    put_row(w, q + 3 * ROW, a3, b3, c3, d3)


def mirror_last(w, p, q):
    """Do the same where there are three rows."""
    a0, a1, a2 = w[p], w[p + 1], w[p + 2]
    p += ROW
    b1, b2 = w[p + 1], w[p + 2]
    c2 = w[p + ROW + 2]
    put_row(w, q, a0, a1, a2, 0.0)
    put_row(w, q + ROW, a1, b1, b2, 0.0)
    put_row(w, q + 2 * ROW, a2, b2, c2, 0.0)


def copy_tile(w, p, q):
    """Copy the tile at ``p`` to ``q``."""
    for i in range(TILE):
        copy_row(w, p + ROW * i, q + ROW * i)


def copy_row(w, p, q):
    """Copy four numbers."""
    put_row(w, q, w[p], w[p + 1], w[p + 2], w[p + 3])


def put_row(w, q, a, b, c, d):
    """Write four numbers that follow each other."""
    w[q] = a
    w[q + 1] = b
    w[q + 2] = c
    w[q + 3] = d
