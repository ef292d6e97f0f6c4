"""Wire formats: bytes to samples, without I/O."""
