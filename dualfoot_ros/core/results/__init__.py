"""What flows out: estimates of one epoch, trajectories and events."""
