"""What the nodes take in: stamps, calibrations, field and pressure topics."""
