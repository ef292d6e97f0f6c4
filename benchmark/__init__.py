"""What the tracker costs: ``python -m benchmark``.  Timings live here, never in a test."""
