"""The demo: the real nodes on a recorded walk, compared with its truth."""
