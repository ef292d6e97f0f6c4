"""The offset between the clocks of two recordings, by arrivals, by steps or by a shake."""
