"""Cost of the package as ratios: to an epoch in C, an import of numpy, an empty node."""
