"""Blocks of the covariance turned about their diagonal, in tiles of four rows and four columns.

All of a tile is read before any of it is written, so a compiler takes rows and columns several
numbers at once.  A block has 15 rows of 16 numbers, the last of which are zero.
"""

from .layout import PLACE, ROW, S_A

TILE = 4
LAST = 12  # row and column at which the last tile begins


def turn_over(w, block, first, end):
    """Write rows ``first``..``end - 1`` of the transpose of a block to S_A, in whole tiles.

    A sixteenth column is zero, and so is a sixteenth row.
    """
    block &= PLACE
    for j in range(first, end, TILE):
        for i in range(0, LAST, TILE):
            transpose_tile(w, block + ROW * i + j, S_A + ROW * j + i)
        transpose_last_rows(w, block + ROW * LAST + j, S_A + ROW * j + LAST)


def turn_back(w, block):
    """Write the transpose of what is at S_A to a block."""
    block &= PLACE
    for i in range(0, ROW, TILE):
        for j in range(0, LAST, TILE):
            transpose_tile(w, S_A + ROW * i + j, block + ROW * j + i)
        transpose_last_columns(w, S_A + ROW * i + LAST, block + ROW * LAST + i)


def mirror(w, block):
    """Write the upper triangle of what is at S_A to a block, and as the lower one too."""
    block &= PLACE
    for i in range(0, LAST, TILE):
        mirror_diagonal(w, S_A + (ROW + 1) * i, block + (ROW + 1) * i)
        for j in range(i + TILE, LAST, TILE):
            mirror_tile(w, S_A + ROW * i + j, block + ROW * i + j, block + ROW * j + i)
        mirror_last(w, S_A + ROW * i + LAST, block + ROW * i + LAST, block + ROW * LAST + i)
    mirror_last_diagonal(w, S_A + (ROW + 1) * LAST, block + (ROW + 1) * LAST)


def transpose_tile(w, p, q):
    """Write the transpose of the tile at ``p`` to ``q``."""
    a0, a1, a2, a3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    p += ROW
    b0, b1, b2, b3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    p += ROW
    c0, c1, c2, c3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    p += ROW
    d0, d1, d2, d3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    put_row(w, q, a0, b0, c0, d0)
    put_row(w, q + ROW, a1, b1, c1, d1)
    put_row(w, q + 2 * ROW, a2, b2, c2, d2)
    put_row(w, q + 3 * ROW, a3, b3, c3, d3)


def transpose_last_rows(w, p, q):
    """Do the same where the tile at ``p`` has three rows: zeros stand for the fourth."""
    a0, a1, a2, a3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    p += ROW
    b0, b1, b2, b3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    p += ROW
    c0, c1, c2, c3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    put_row(w, q, a0, b0, c0, 0.0)
    put_row(w, q + ROW, a1, b1, c1, 0.0)
    put_row(w, q + 2 * ROW, a2, b2, c2, 0.0)
    put_row(w, q + 3 * ROW, a3, b3, c3, 0.0)


def transpose_last_columns(w, p, q):
    """Do the same with the first three columns of the tile at ``p``."""
    a0, a1, a2 = w[p], w[p + 1], w[p + 2]
    p += ROW
    b0, b1, b2 = w[p], w[p + 1], w[p + 2]
    p += ROW
    c0, c1, c2 = w[p], w[p + 1], w[p + 2]
    p += ROW
    d0, d1, d2 = w[p], w[p + 1], w[p + 2]
    put_row(w, q, a0, b0, c0, d0)
    put_row(w, q + ROW, a1, b1, c1, d1)
    put_row(w, q + 2 * ROW, a2, b2, c2, d2)


def put_row(w, q, a, b, c, d):
    """Write four numbers that follow each other."""
    w[q] = a
    w[q + 1] = b
    w[q + 2] = c
    w[q + 3] = d


def copy_row(w, p, q):
    """Copy four numbers."""
    put_row(w, q, w[p], w[p + 1], w[p + 2], w[p + 3])


def mirror_tile(w, p, q, r):
    """Write the tile at ``p`` to ``q`` and its transpose to ``r``."""
    transpose_tile(w, p, r)
    for k in range(TILE):
        copy_row(w, p + ROW * k, q + ROW * k)


def mirror_last(w, p, q, r):
    """Do the same with a tile of three columns and the zeros beside them, which are copied."""
    transpose_last_columns(w, p, r)
    for k in range(TILE):
        copy_row(w, p + ROW * k, q + ROW * k)


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


def mirror_last_diagonal(w, p, q):
    """Do the same where there are three rows."""
    a0, a1, a2 = w[p], w[p + 1], w[p + 2]
    p += ROW
    b1, b2 = w[p + 1], w[p + 2]
    c2 = w[p + ROW + 2]
    put_row(w, q, a0, a1, a2, 0.0)
    put_row(w, q + ROW, a1, b1, b2, 0.0)
    put_row(w, q + 2 * ROW, a2, b2, c2, 0.0)
