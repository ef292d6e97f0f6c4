"""Functions of the kernel that have a text in C of their own, beside the one that is translated.

They move numbers and compute none.  gcc takes the numbers of a tile one by one, whatever the loops
over them are; with the vectors that gcc and clang know they move four at once.  A compiler without
them takes what is translated.
"""

from ..kernel.layout import ROW

HAS_VECTORS = "FOUR_AT_ONCE"

VECTORS = f"""\
#ifdef __has_builtin
#if __has_builtin(__builtin_shufflevector)
#define {HAS_VECTORS}
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));
#define PICK __builtin_shufflevector
#endif
#endif
"""

TEXTS = {
    "transpose_tile": f"""\
    Four a = *(Four *)(w + p), b = *(Four *)(w + p + {ROW}), c = *(Four *)(w + p + {2 * ROW});
    Four d = {{0.0, 0.0, 0.0, 0.0}};
    if (rows > 3) d = *(Four *)(w + p + {3 * ROW});
    Four e = PICK(a, b, 0, 4, 2, 6), f = PICK(a, b, 1, 5, 3, 7);
    Four g = PICK(c, d, 0, 4, 2, 6), h = PICK(c, d, 1, 5, 3, 7);
    *(Four *)(w + q) = PICK(e, g, 0, 1, 4, 5);
    *(Four *)(w + q + {ROW}) = PICK(f, h, 0, 1, 4, 5);
    *(Four *)(w + q + {2 * ROW}) = PICK(e, g, 2, 3, 6, 7);
    if (columns > 3) *(Four *)(w + q + {3 * ROW}) = PICK(f, h, 2, 3, 6, 7);
"""
}
