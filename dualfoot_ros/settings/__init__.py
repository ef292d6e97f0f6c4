"""Parameters of the nodes, presets and parameter files."""
