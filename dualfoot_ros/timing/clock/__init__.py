"""The clock of a device, followed on the host's clock from when its samples arrive."""
