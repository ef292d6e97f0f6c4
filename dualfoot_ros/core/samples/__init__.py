"""What flows in: series and pairs of samples, axes, units, and which pairs are taken."""
